"""Bad input: one line that names the cure, exit code 2, no traceback, and nothing that existed is lost."""

import builtins
import errno
import os
import pathlib
import subprocess
import sys

import pytest
from tiny import DEVICE, WAVE, contents, line_of, refused, run, spmhd, write

import taichi_spmhd as spmhd_package
from taichi_spmhd import InputError, runtime, stored
from taichi_spmhd.outputs import files


@pytest.fixture
def wave(tmp_path):
    return write(tmp_path, WAVE)


SAID = {
    ("run", "no_such_scene"): "no scene 'no_such_scene'",
    ("run", "no_such_file.py"): "no scene file no_such_file.py",
    ("run", "WAVE", "--set", "nxx=3"): "did you mean 'nx'?",
    ("run", "WAVE", "--set", "nx=abc"): "nx=abc: expected a whole number",
    ("run", "WAVE", "--set", "nx=3.5"): "nx=3.5: expected a whole number",
    ("run", "WAVE", "--set", "beta="): "beta=: expected a number",
    ("run", "WAVE", "--set", "nx"): "--set nx: write NAME=VALUE",
    ("run", "WAVE", "--set", "nx=4", "nx=5"): "nx is given twice",
    ("run", "WAVE", "--variant", "xi = 2"): "did you mean 'xi = ",
    ("run", "WAVE", "--frames", "0"): "--frames 0: give at least 1",
    ("run", "WAVE", "--frames", "many"): "--frames",
    ("run", "WAVE", "--t-end", "0"): "--t-end 0: give a time after the start",
    ("run", "WAVE", "--t-end", "nan"): "--t-end nan",
    ("run", "WAVE", "--movie", "avi"): "--movie avi: choose one of gif, mp4, none",
    ("run", "WAVE", "--set", "nx=0"): f"wave.py, line {line_of(WAVE, 'positions=')}: nx = 0: give a whole number",
    ("run", "WAVE", "--set", "nx=4"): "narrower than two kernel supports",
    ("run", "WAVE", "--out", "WAVE"): "is a file; give a folder",
    ("run", "WAVE", "--out", "WAVE/deeper"): "is a file; give a folder",
    ("run", "WAVE", "--threads", "0"): "--threads 0: give a whole number from 1",
    ("run", "WAVE", "--threads", "two"): "--threads",
    ("run", "WAVE", "--arch", "abacus"): "unknown --arch 'abacus': choose one of auto, cpu",
    ("run", "WAVE", "--precision", "f16"): "choose one of f64, f32",
    ("run", "WAVE", "--resume"): "leave out --resume to start one",
    ("show", "WAVE", "--set", "nxx=3"): "did you mean 'nx'?",
    ("run",): "required: SCENE (see spmhd run --help)",
    ("rum",): "invalid choice: 'rum'",
    (): "required: COMMAND",
}


@pytest.mark.parametrize("words", SAID, ids=" ".join)
def test_one_line_names_the_cure(wave, tmp_path, capsys, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    device = () if len(words) < 2 or {"--arch", "--threads", "--precision"} & set(words) else (*DEVICE, "--quiet")
    given = [word.replace("WAVE", str(wave)) for word in words]
    assert SAID[words] in refused(capsys, *given, *device)
    assert [path.name for path in tmp_path.iterdir()] == ["wave.py"]


STARTS = {
    '"P": -0.1': "start: P of particle 0 is -0.1; it must be positive",
    '"P": np.where(x[:, 0] > 0.5, np.nan, 0.1)': "start: P of particle",
    '"P": np.zeros(3)': "start: P has shape (3,)",
    '"P": 0.1, "psi": np.inf': "start: psi of particle 0 is not finite",
    '"P": 0.1, "pressure": 1': "unknown quantity 'pressure'",
    '"P": 1 / 0': f"wave.py, line {line_of(WAVE, ': 0.1, ')}: ZeroDivisionError",
}


@pytest.mark.parametrize("start", STARTS)
def test_an_ill_start_is_named(tmp_path, capsys, start):
    scene = write(tmp_path, WAVE.replace('"P": 0.1', start))
    assert STARTS[start] in refused(capsys, "run", scene, "--out", tmp_path / "out", *DEVICE)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("member", ["rho", "B", "v", "x"])
def test_a_number_that_is_none_is_named(tmp_path, capsys, member):
    ill = "    out = {'rho': np.ones(len(x)), 'P': 0.1, 'B': np.ones((len(x), 3)), 'v': np.ones((len(x), 3)), 'x': x}\n"
    ill += f"    out['{member}'][7] = np.nan\n    del out['x']\n    return out\n"
    text = WAVE.replace("    still = np.zeros_like(wave)\n", ill)
    if member == "x":
        text = WAVE.replace("positions=hexagonal(BOX, nx)", "positions=hexagonal(BOX, nx) * np.where(1, np.nan, 1)")
    said = refused(capsys, "run", write(tmp_path, text), "--out", tmp_path / "out", *DEVICE)
    name = "positions" if member == "x" else member
    assert f"start: {name} of particle {0 if member == 'x' else 7} is not finite" in said


def test_two_particles_on_one_spot_are_named(tmp_path, capsys):
    text = WAVE.replace("positions=hexagonal(BOX, nx)", "positions=np.repeat(hexagonal(BOX, nx), 2, axis=0)")
    assert "are on one spot" in refused(capsys, "run", write(tmp_path, text), "--out", tmp_path / "out", *DEVICE)


def test_cuda_without_a_gpu_says_what_is_there(wave, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(runtime, "_available", lambda arch: arch == "cpu")
    said = refused(capsys, "run", wave, "--arch", "cuda", "--out", tmp_path / "out")
    assert "there is cpu (use --arch cpu)" in said


def test_a_second_start_with_other_values_is_refused(wave, tmp_path, capsys):
    said = refused(capsys, "run", wave, "--arch", "cpu", "--threads", "1", "--out", tmp_path / "out")
    assert "Taichi already runs" in said
    with pytest.raises(InputError, match="already runs"):
        spmhd_package.init(arch="cpu", precision="f32", threads=2)


def test_a_picture_that_cannot_be_drawn_is_refused_before_the_run(tmp_path, capsys):
    scene = write(tmp_path, WAVE.replace('Picture("B", axis=1', 'Picture("psi"'))
    assert "psi" in refused(capsys, "run", scene, "--out", tmp_path / "out", *DEVICE)
    assert not (tmp_path / "out").exists()


def test_mp4_without_ffmpeg_is_refused_before_the_run(wave, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    said = refused(capsys, "run", wave, "--movie", "mp4", "--out", tmp_path / "out", *DEVICE)
    assert "taichi-spmhd[movie]" in said


def test_a_foreign_folder_is_left_alone(wave, tmp_path, capsys):
    out = tmp_path / "out"
    out.mkdir()
    (out / "summary.json").write_text("mine")
    assert "choose another folder" in refused(capsys, "run", wave, "--out", out, *DEVICE)
    (out / "summary.json").unlink()
    (out / "run.json").write_text('{"name": "of another program"}')
    assert "no run of ours" in refused(capsys, "run", wave, "--out", out, *DEVICE)
    (out / "run.json").write_text('{"scene": "blast", "variants": ["blast"], "frames": 3, "movie": "gif"}')
    assert "holds a run of blast" in refused(capsys, "run", wave, "--out", out, *DEVICE)


def disk(monkeypatch, number: int, ending: str, after: int = 0):
    """A disk that refuses to open files of this ending for writing, once `after` have been written."""
    real, seen = builtins.open, []

    def opened(file, mode="r", *given, **more):
        if set(mode) & set("wax+") and ending in os.path.basename(str(file)):
            seen.append(file)
            if len(seen) > after:
                raise OSError(number, os.strerror(number), str(file))
        return real(file, mode, *given, **more)

    monkeypatch.setattr(builtins, "open", opened)


REFUSALS = {errno.ENOSPC: "full", errno.EROFS: "not writable", errno.EACCES: "not writable"}


@pytest.mark.parametrize("number", REFUSALS)
def test_a_disk_that_refuses_leaves_the_earlier_run_as_it_was(wave, tmp_path, capsys, number):
    out = tmp_path / "out"
    assert run(wave, out, "--variant", "xi = 0", "--frames", 2) == 0
    before = contents(out)
    with pytest.MonkeyPatch.context() as patch:
        disk(patch, number, "run.json")
        assert REFUSALS[number] in refused(capsys, "run", wave, "--out", out, *DEVICE, "--variant", "xi = 0")
    assert contents(out) == before


WORDS = (*DEVICE, "--variant", "xi = 0", "--frames", "3", "--movie", "gif")


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """The files of a run on a disk with room."""
    folder = tmp_path_factory.mktemp("undisturbed")
    assert spmhd("run", write(folder, WAVE), "--out", folder / "out", *WORDS) == 0
    return contents(folder / "out")


@pytest.mark.parametrize("ending", [".npz", ".csv", ".png", ".gif", "summary.json"])
def test_a_disk_that_fills_up_on_the_way_can_be_mended(wave, undisturbed, tmp_path, capsys, ending):
    words = ("run", wave, "--out", tmp_path / "out", *WORDS)
    with pytest.MonkeyPatch.context() as patch:
        disk(patch, errno.ENOSPC, ending, after=0 if ending in (".gif", "summary.json") else 1)
        said = refused(capsys, *words)
    assert "cannot write" in said and ("free" in said)
    left = {path.name for path in (tmp_path / "out").rglob("*") if ".part" in path.name}
    assert not left
    if ending != ".csv":  # that is the first frame's; else the state of an earlier one is whole
        assert stored.read(tmp_path / "out" / "state_xi_0.npz")["time"] >= 0
    assert spmhd(*words, "--resume") == 0
    assert contents(tmp_path / "out") == undisturbed


def test_a_folder_that_cannot_be_made_is_refused(wave, tmp_path, capsys, monkeypatch):
    def mkdir(path, *given, **more):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))

    monkeypatch.setattr(pathlib.Path, "mkdir", mkdir)
    assert "not writable" in refused(capsys, "run", wave, "--out", tmp_path / "closed" / "out", *DEVICE)


def test_a_damaged_state_is_named(wave, tmp_path, capsys):
    words = ("run", wave, "--out", tmp_path / "out", *DEVICE, "--variant", "xi = 0", "--frames", "2", "--movie", "none")
    assert spmhd(*words) == 0
    record = files.read_json(tmp_path / "out" / "run.json")
    del record["finished"]
    (tmp_path / "out" / "run.json").write_text(files.as_json(record))
    (tmp_path / "out" / "state_xi_0.npz").write_bytes(b"PK half a file")
    assert "damaged" in refused(capsys, *words, "--resume")


def test_taichi_that_cannot_be_imported_is_one_line(capfd):
    code = """
import sys
class Without:
    def find_spec(self, name, path=None, target=None):
        if name == "taichi":
            raise ImportError("libX11.so.6: cannot open shared object file: No such file or directory")
sys.meta_path.insert(0, Without())
import taichi_spmhd.__main__
sys.exit(taichi_spmhd.__main__.main(["list"]))
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 2 and done.stderr.count("\n") == 1
    assert "libx11-6" in done.stderr
