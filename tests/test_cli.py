"""The commands: files, exit codes, interruption and resuming to the same bits."""

import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from tiny import DEVICE, EXPLODES, WAVE, Killed, contents, kill_at, line_of, run, spmhd, write

from taichi_spmhd import Simulation, library, load_scene
from taichi_spmhd.outputs import history
from taichi_spmhd.outputs.film import Film


@pytest.fixture
def wave(tmp_path):
    return write(tmp_path, WAVE)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The files of a run that nobody disturbed."""
    folder = tmp_path_factory.mktemp("whole")
    assert run(write(folder, WAVE), folder / "out", "--movie", "gif") == 0
    return contents(folder / "out")


def test_run_writes_all_files(wave, tmp_path, capsys):
    assert run(wave, tmp_path / "out", "--movie", "gif") == 0
    names = set(contents(tmp_path / "out"))
    frames = {os.path.join("frames", f"{k:04d}.png") for k in range(5)}
    each = {f"{kind}_{label}" for label in ("xi_0", "xi_1-2") for kind in ("history", "state")}
    files = {name + (".csv" if name.startswith("history") else ".npz") for name in each}
    assert names == frames | files | {"summary.json", "table.md", "run.json", "wave.gif"}
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["scene"] == "wave" and summary["parameters"]["nx"] == 16 and summary["frames"] == 5
    assert summary["precision"] == "f64" and summary["threads"] == 2 and summary["movie"] == "gif"
    assert summary["variants"]["xi = 1/2"]["t"] == 0.1 and summary["variants"]["xi = 0"]["particles"] == 256
    rows = (tmp_path / "out" / "history_xi_0.csv").read_text().splitlines()
    assert rows[0].startswith("t,step,dt,E_kin") and len(rows) == 6
    table = [line.split(" | ") for line in (tmp_path / "out" / "table.md").read_text().splitlines() if " | " in line]
    assert [line[0] for line in table] == ["| variant", "| ---", "| xi = 0", "| xi = 1/2"]
    assert float(table[3][table[0].index("mean gap")]) == pytest.approx(
        summary["variants"]["xi = 1/2"]["mean_gap"], abs=5e-4
    )
    assert "xi = 1/2" in capsys.readouterr().out


def test_quiet_says_nothing(wave, tmp_path, capfd):
    capfd.readouterr()
    assert run(wave, tmp_path / "out", "--quiet", "--frames", 1, "--variant", "xi = 0") == 0
    said = capfd.readouterr()
    assert said.out == "" and said.err == ""
    assert [p.name for p in (tmp_path / "out" / "frames").iterdir()] == ["0000.png"]


def test_variant_parameters_and_end_can_be_chosen(wave, tmp_path):
    words = ("--variant", "xi = 1/2", "--set", "nx=20", "beta=1/2", "--t-end", "0.02", "--frames", 2)
    assert run(wave, tmp_path / "out", *words) == 0
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert list(summary["variants"]) == ["xi = 1/2"] and summary["t_end"] == 0.02
    assert summary["parameters"]["nx"] == 20 and summary["parameters"]["beta"] == 0.5


def test_a_second_run_replaces_the_first_and_nothing_else(wave, tmp_path):
    out = tmp_path / "out"
    assert run(wave, out, "--frames", 6) == 0
    (out / "frames" / "mine.png").write_text("mine")
    (out / "frames" / "0099.png").write_text("mine too")
    assert run(wave, out, "--frames", 3, "--variant", "xi = 0") == 0
    assert sorted(p.name for p in (out / "frames").iterdir()) == [
        "0000.png",
        "0001.png",
        "0002.png",
        "0099.png",
        "mine.png",
    ]
    assert not (out / "state_xi_1-2.npz").exists() and not (out / "table.md").exists()
    (out / "table.md").write_text("mine: one variant writes none")
    assert run(wave, out, "--frames", 3, "--variant", "xi = 0") == 0
    assert (out / "table.md").read_text() == "mine: one variant writes none"


def test_a_finished_run_is_not_run_again(wave, tmp_path, capsys):
    assert run(wave, tmp_path / "out") == 0
    before = contents(tmp_path / "out")
    assert run(wave, tmp_path / "out", "--resume") == 0
    assert "is finished" in capsys.readouterr().out
    assert contents(tmp_path / "out") == before


POINTS = [
    pytest.param(Simulation, "save", 4, id="state"),
    pytest.param(history, "add", 6, id="row", marks=pytest.mark.slow),
    pytest.param(Film, "draw", 3, id="frame", marks=pytest.mark.slow),
    pytest.param(Film, "write", 1, id="film", marks=pytest.mark.slow),
    pytest.param(Simulation, "step", 9, id="step", marks=pytest.mark.slow),
]


@pytest.mark.parametrize(("owner", "name", "count"), POINTS)
def test_a_run_killed_anywhere_resumes_to_the_same_bits(wave, whole, tmp_path, owner, name, count):
    with pytest.MonkeyPatch.context() as patch, pytest.raises(Killed):
        kill_at(patch, owner, name, count)
        run(wave, tmp_path / "out", "--movie", "gif")
    (tmp_path / "out" / ".state_xi_0.npz.1.part").write_text("half")  # what a kill in the middle of a write leaves
    assert run(wave, tmp_path / "out", "--resume") == 0
    assert contents(tmp_path / "out") == whole


SIGNALS = [
    pytest.param(signal.SIGINT, 5, id="ctrl-c"),
    pytest.param(signal.SIGINT, 1, id="at once", marks=pytest.mark.slow),
    pytest.param(signal.SIGINT, 8, id="at a frame", marks=pytest.mark.slow),
    pytest.param(signal.SIGTERM, 9, id="terminate", marks=pytest.mark.slow),
]


@pytest.mark.parametrize(("number", "steps"), SIGNALS)
def test_an_interrupted_run_exits_130_and_resumes_to_the_same_bits(wave, whole, tmp_path, capsys, number, steps):
    before = signal.getsignal(number)
    done, own = [], Simulation.step

    def step(sim, dt=None):
        done.append(own(sim, dt))
        if len(done) == steps:
            signal.raise_signal(number)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Simulation, "step", step)
        assert run(wave, tmp_path / "out", "--movie", "gif") == 130
    assert signal.getsignal(number) == before
    assert len(done) == steps  # the step in progress is finished, no other begun
    assert "go on with --resume" in capsys.readouterr().err
    assert run(wave, tmp_path / "out", "--resume") == 0
    assert contents(tmp_path / "out") == whole


def test_resume_says_what_differs(wave, tmp_path, capsys):
    with pytest.MonkeyPatch.context() as patch, pytest.raises(Killed):
        kill_at(patch, Simulation, "step", 5)
        run(wave, tmp_path / "out")
    before = contents(tmp_path / "out")
    for words, told in {
        ("--set", "nx=20"): "the started run had nx = 16, now it is 20",
        ("--frames", "7"): "the started run had frames = 5, now it is 7",
        ("--t-end", "0.2"): "t_end = 0.1, now it is 0.2",
        ("--variant", "xi = 0"): "variants",
    }.items():
        assert run(wave, tmp_path / "out", "--resume", *words) == 2
        assert told in capsys.readouterr().err
    write(tmp_path, WAVE.replace("0.1 * wave", "0.2 * wave"))
    assert run(wave, tmp_path / "out", "--resume") == 2
    assert "the scene file has changed" in capsys.readouterr().err
    assert contents(tmp_path / "out") == before


def test_nothing_to_resume_is_said(wave, tmp_path, capsys):
    assert run(wave, tmp_path / "out", "--resume") == 2
    assert "there is no run in" in capsys.readouterr().err


def test_a_variant_that_explodes_exits_3_and_leaves_its_last_good_state(tmp_path, capsys):
    scene, out = write(tmp_path, EXPLODES), tmp_path / "out"
    assert run(scene, out, "--movie", "gif") == 3
    said = capsys.readouterr().err.strip().splitlines()
    assert len(said) == 1 and "bang: not finite" in said[0] and "state_bang.npz" in said[0]
    with Simulation.load(out / "state_bang.npz", load_scene(scene)["bang"]) as sim:
        assert 0.025 <= sim.time <= 0.05 and np.isfinite(sim["v"]).all()
    summary = json.loads((out / "summary.json").read_text())["variants"]
    assert "not finite" in summary["bang"]["error"] and "error" not in summary["calm"]
    assert summary["calm"]["t"] == 0.1
    assert len(list((out / "frames").iterdir())) == 5 and (out / "wave.gif").exists()
    assert run(scene, out, "--resume") == 3  # it has ended, and how


def test_a_run_that_explodes_before_the_first_frame_has_a_state(tmp_path):
    scene = write(tmp_path, EXPLODES)
    assert run(scene, tmp_path / "out", "--frames", 1, "--variant", "bang") == 3
    with Simulation.load(tmp_path / "out" / "state_bang.npz", load_scene(scene)["bang"]) as sim:
        assert sim.time == 0


DRAG = (
    WAVE
    + '''

@dataclass(frozen=True)
class Drag(Term):
    """dv/dt = - k v"""

    k: float = 1.0
    reads, evolves = {"v": vec3}, {"v": vec3}

    @ti.func
    def local(self, i, now):
        return ti.Struct(v=-self.k * i.v)


def scenes():
    still = Scene(box=BOX, positions=hexagonal(BOX, 16), start=lambda x: {"rho": 1.0, "P": 1.0, "v": [1.0, 0.0, 0.0]},
                  terms=(Pressure(), Drag(k=4.0)), t_end=0.5)
    return {"drag": still}
'''
)


def test_a_term_written_in_a_scene_file_acts(tmp_path, capsys):
    scene = write(tmp_path, DRAG)
    assert run(scene, tmp_path / "out", "--frames", 2) == 0
    with Simulation.load(tmp_path / "out" / "state_drag.npz", load_scene(scene)["drag"]) as sim:
        assert np.allclose(sim["v"][:, 0], np.exp(-2.0), rtol=1e-2)  # (k dt)^2 / 12 a step
    assert spmhd("show", scene, *DEVICE) == 0
    said = capsys.readouterr().out
    assert "Drag(k=4.0)" in said and "dv/dt = - k v" in said


def test_a_mistake_in_such_a_term_is_named_with_its_line(tmp_path, capsys):
    scene = write(tmp_path, DRAG.replace("-self.k * i.v", "-self.k * i.w"))
    assert run(scene, tmp_path / "out") == 2
    assert f"wave.py, line {line_of(DRAG, '-self.k * i.v')}" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_show_tells_terms_members_cost_and_warns(wave, capsys):
    assert spmhd("show", wave, *DEVICE) == 0
    said = capsys.readouterr().out
    assert "Stress()" in said and "d(B/rho)_i/dt" in said and "bytes a particle" in said and "steps" in said
    assert (
        "will clump: the lowest beta is 0.198" in said and said.count("will clump") == 1
    )  # B^2 = 1 + 0.1^2 at the most


def test_show_says_that_a_hydro_scene_has_no_field(tmp_path, capsys):
    assert spmhd("show", write(tmp_path, DRAG), *DEVICE) == 0
    line = next(line for line in capsys.readouterr().out.splitlines() if "not allocated" in line)
    assert line.split("not allocated")[1].strip() == "B, b, psi"


def test_list_and_version(capsys):
    assert spmhd("list") == 0
    assert all(entry.name in capsys.readouterr().out for entry in library.listing()[:1])
    assert spmhd("--version") == 0
    assert capsys.readouterr().out.startswith("spmhd ")
    assert spmhd("--help") == 0 and "run" in capsys.readouterr().out


def command(*words, **more):
    return subprocess.Popen([sys.executable, "-m", "taichi_spmhd", *map(str, words)], **more)


def test_a_reader_that_goes_away_is_no_error(wave, tmp_path):
    reader, writer = os.pipe()
    os.close(reader)
    words = ("run", wave, "--out", tmp_path / "out", *DEVICE, "--frames", 2, "--movie", "none")
    made = command(*words, stdout=writer, stderr=subprocess.PIPE)
    os.close(writer)
    assert made.communicate()[1] == b"" and made.returncode == 0
    assert (tmp_path / "out" / "summary.json").exists()


@pytest.mark.slow
def test_a_run_killed_by_the_system_resumes_to_the_same_bits(wave, tmp_path):
    words = ("run", wave, *DEVICE, "--quiet", "--set", "t_end=0.5", "--frames", 60, "--movie", "none", "--out")
    assert command(*words, tmp_path / "whole").wait() == 0
    for name in ("0005.png", "0031.png"):
        made = command(*words, tmp_path / "out", *(["--resume"] if (tmp_path / "out").exists() else []))
        while not (tmp_path / "out" / "frames" / name).exists() and made.poll() is None:
            time.sleep(0.001)
        made.kill()
        assert made.wait() != 0
    assert command(*words, tmp_path / "out", "--resume").wait() == 0
    assert contents(tmp_path / "out") == contents(tmp_path / "whole")
