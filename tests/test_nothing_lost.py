"""Nothing lost: a run ended at any moment goes on to the same bits, from the state before where the last is damaged."""

import builtins
import os
import shutil

import numpy as np
import pytest
from tiny import DEVICE, EXPLODES, WAVE, Killed, contents, kill_at, refused, run, write

from taichi_spmhd.outputs import run as running
from taichi_spmhd.outputs.files import read_json
from taichi_spmhd.outputs.film import Film
from taichi_spmhd.stored import read

T_END = 0.1  # of the wave
ONE = ("--variant", "xi = 1/2", "--frames", 3, "--movie", "gif")
STATE, PREVIOUS, HISTORY = "state_xi_1-2.npz", "state_xi_1-2.previous.npz", "history_xi_1-2.csv"


@pytest.fixture(scope="module")
def wave(tmp_path_factory):
    return write(tmp_path_factory.mktemp("scene"), WAVE)


@pytest.fixture(scope="module")
def moments(wave, tmp_path_factory):
    """The finished run, and what a kill would have left in its folder before every call that changes the disk."""
    root = tmp_path_factory.mktemp("moments")
    left = [root / "000"]
    left[0].mkdir()

    def watched(own):
        def call(*given, **more):
            left.append(root / f"{len(left):03d}")
            shutil.copytree(root / "out", left[-1])
            return own(*given, **more)

        return call

    def opened(file, mode="r", *given, **more):
        return (watched(own_open) if set(mode) & set("wax+") and here(file) else own_open)(file, mode, *given, **more)

    def here(file) -> bool:
        return (root / "out").exists() and str(file).startswith(str(root / "out"))

    own_open = builtins.open
    (root / "out").mkdir()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(running, "SAVE_EVERY", 0.0)  # a state after every step
        for name in ("fsync", "replace", "link", "unlink"):
            patch.setattr(os, name, watched(getattr(os, name)))
        patch.setattr(builtins, "open", opened)
        assert run(wave, root / "out", *ONE) == 0
    return contents(root / "out"), distinct(left)


def distinct(folders) -> list:
    """Folders of which no two hold the same files; those in which a run has begun."""
    found = {}
    for folder in folders:
        if (folder / "run.json").exists():
            files = [path for path in sorted(folder.rglob("*")) if path.is_file()]
            found.setdefault(tuple((str(path.relative_to(folder)), path.read_bytes()) for path in files), folder)
    return list(found.values())


def resumed(wave, folder, tmp_path) -> dict:
    """The files of a run that went on in a copy of the folder."""
    shutil.copytree(folder, tmp_path / folder.name)
    assert run(wave, tmp_path / folder.name, "--resume") == 0
    return contents(tmp_path / folder.name)


def test_by_wall_time_states_are_saved_between_frames_and_resume_to_the_same_bits(wave, moments, tmp_path):
    whole, left = moments
    states = [(one, float(read(one / STATE)["time"])) for one in left if (one / STATE).exists()]
    between = [one for one, time in states if time not in T_END * np.linspace(0, 1, 3)]
    assert len({time for _, time in states}) > 5, "more than the three of the frames and their neighbours"
    assert resumed(wave, between[-1], tmp_path) == whole


def test_a_run_that_ended_before_any_call_resumes_to_the_same_bits(wave, moments, tmp_path):
    whole, left = moments
    for folder in left[3::25]:
        assert resumed(wave, folder, tmp_path) == whole, folder.name


@pytest.mark.slow
def test_a_run_that_ended_before_every_call_resumes_to_the_same_bits(wave, moments, tmp_path):
    whole, left = moments
    assert len(left) > 35, "seven states, of the start and six steps, with five moments each, and all other files"
    for folder in left:
        assert resumed(wave, folder, tmp_path) == whole, folder.name


def test_there_is_a_whole_state_of_the_last_frame_or_later_at_every_moment(moments):
    _, left = moments
    times = T_END * np.linspace(0, 1, 3)
    for folder in left:
        reached = max((read(path)["time"] for path in folder.glob("state_*.npz")), default=-1.0)
        frames = len(list((folder / "frames").glob("[0-9]*.png")))
        assert frames == 0 or reached >= times[frames - 1], folder.name
        rows = max(0, len((folder / HISTORY).read_text().splitlines()) - 1) if (folder / HISTORY).exists() else 0
        assert rows < 2 or reached >= times[rows - 2], "a row is written before its state"


@pytest.fixture
def two_states(moments, tmp_path):
    """The last folder of a run that had not ended: with a state and the one before it."""
    last = [one for one in moments[1] if (one / PREVIOUS).exists() and not (one / "summary.json").exists()][-1]
    shutil.copytree(last, tmp_path / "out", ignore=shutil.ignore_patterns(".*"))
    return tmp_path / "out"


DAMAGE = {
    "cut short": lambda path: os.truncate(path, path.stat().st_size // 2),
    "empty": lambda path: os.truncate(path, 0),
    "gone": os.unlink,
    "one bit": lambda path: path.write_bytes(flipped(path.read_bytes())),
}


def flipped(content: bytes) -> bytes:
    k = len(content) // 2
    return content[:k] + bytes([content[k] ^ 1]) + content[k + 1 :]


SLOW = {"empty", "one bit"}


@pytest.mark.parametrize("damage", [pytest.param(one, marks=[pytest.mark.slow] * (one in SLOW)) for one in DAMAGE])
def test_a_lost_state_is_told_and_the_one_before_it_gives_the_same_bits(wave, moments, two_states, capsys, damage):
    DAMAGE[damage](two_states / STATE)
    assert run(wave, two_states, "--resume") == 0
    said = [line for line in capsys.readouterr().out.splitlines() if STATE in line]
    assert len(said) == 1 and "going on from the state before it, t = " in said[0]
    assert contents(two_states) == moments[0]


def test_two_damaged_states_are_both_named(wave, two_states, capsys):
    for name in (STATE, PREVIOUS):
        DAMAGE["cut short"](two_states / name)
    before = bytes_of(two_states)
    said = refused(capsys, "run", wave, "--out", two_states, "--resume", *DEVICE)
    assert STATE in said and PREVIOUS in said and "start anew without --resume" in said
    assert bytes_of(two_states) == before


def bytes_of(folder) -> dict:
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_a_variant_that_went_wrong_and_lost_its_state_goes_wrong_again(tmp_path):
    scene = write(tmp_path, EXPLODES)
    bang = ("--variant", "bang", "--frames", 3)
    assert run(scene, tmp_path / "whole", *bang) == 3
    with pytest.MonkeyPatch.context() as patch, pytest.raises(Killed):
        kill_at(patch, Film, "write", 1)
        run(scene, tmp_path / "out", *bang)
    assert "bang" in read_json(tmp_path / "out" / "run.json")["errors"]
    DAMAGE["cut short"](tmp_path / "out" / "state_bang.npz")
    assert run(scene, tmp_path / "out", "--resume") == 3
    assert contents(tmp_path / "out") == contents(tmp_path / "whole")


def test_a_history_that_lost_a_row_is_refused(wave, two_states, capsys):
    path = two_states / HISTORY
    path.write_text("".join(path.read_text().splitlines(keepends=True)[:-1]))
    assert "rows are left of" in refused(capsys, "run", wave, "--out", two_states, "--resume", *DEVICE)
