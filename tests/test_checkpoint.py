"""The state on disk: the same bits after an interruption and for any number of threads; bad files and full disks."""

import errno
import hashlib
import io
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from taichi_spmhd import runtime  # noqa: F401  (child processes import * from here)
from taichi_spmhd.errors import InputError
from taichi_spmhd.kernels import CubicSpline
from taichi_spmhd.lattice import jitter, square
from taichi_spmhd.runtime import ti
from taichi_spmhd.scene import Scene
from taichi_spmhd.search import LANES
from taichi_spmhd.simulation import Simulation
from taichi_spmhd.terms import (
    Cleaning,
    Conductivity,
    CullenDehnen,
    DivBSource,
    Induction,
    Pressure,
    Resistivity,
    Stress,
)

ROOT = Path(__file__).parents[1]
BOX = (1.0, 1.0)
EVERYTHING = (Stress(), Induction(), DivBSource(0.5), CullenDehnen(), Conductivity(), Resistivity(), Cleaning())


def swirl(x):
    """A vortex that shears the lattice, so that lists are built anew and grow."""
    v = np.stack([-np.sin(2 * np.pi * x[:, 1]), np.sin(2 * np.pi * x[:, 0]), 0 * x[:, 0]], axis=1)
    return {"rho": 1.0, "P": 0.3, "v": v, "B": 0.3 * v[:, [1, 0, 2]] + [0.1, 0, 0.2]}


def turbulence(nx, **changes) -> Scene:
    x = jitter(square(BOX, nx), BOX, 0.02, seed=1)
    return Scene(**{"box": BOX, "positions": x, "start": swirl, "terms": EVERYTHING, "t_end": 10.0, **changes})


def tighten(sim) -> int:
    """Leave the list no room beyond its longest row, so that the next longer one overflows; returns the width."""
    sim.begin()
    neighbours = sim.neighbours
    neighbours.width = LANES * -(-int(neighbours.count.to_numpy().max()) // LANES)
    neighbours.near = ti.ndarray(ti.i32, (len(sim), neighbours.width))
    neighbours.rebuild()
    return neighbours.width


def digest(sim) -> str:
    """A hash of every bit of the members, in the caller's order, and of the rates and the time."""
    columns, rates = sim.columns(), sim.rates()
    bits = [np.ascontiguousarray(group[name]).tobytes() for group in (columns, rates) for name in sorted(group)]
    return hashlib.sha256(b"".join(bits) + repr((sim.time, sim.longest)).encode()).hexdigest()


def steps(sim, n):
    for _ in range(n):
        sim.step()
    return sim


def child(code: str, *arguments) -> subprocess.Popen:
    """A Python process of its own that sees this module: threads and precision are fixed once in a process."""
    paths = [str(ROOT / "tests"), str(ROOT), os.environ.get("PYTHONPATH", "")]
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(reversed(paths))}
    command = [sys.executable, "-c", f"from test_checkpoint import *\n{code}", *map(str, arguments)]
    return subprocess.Popen(command, env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


RUN = """
nx, n, threads = map(int, sys.argv[1:])
runtime.init(arch="cpu", precision="f64", threads=threads)
sim = Simulation(turbulence(nx))
width = tighten(sim)
steps(sim, n)
print(digest(sim), sim.neighbours.builds, sim.neighbours.width > width)
"""


def by_threads(nx, n) -> list[list[str]]:
    """[digest, builds, overflowed] of the same run on one and on two threads."""
    running = [child(RUN, nx, n, threads) for threads in (1, 2)]
    answers = [process.communicate() for process in running]
    assert all(process.returncode == 0 for process in running), answers
    return [out.split() for out, _ in answers]


def test_one_and_two_threads_give_the_same_bits():
    one, two = by_threads(32, 40)
    assert one == two
    assert int(one[1]) > 1, "a list was built within the run"


@pytest.mark.slow
def test_one_and_two_threads_give_the_same_bits_for_20000_particles_and_200_steps():
    one, two = by_threads(144, 200)
    assert one == two
    assert int(one[1]) > 1 and one[2] == "True", "a rebuild and an overflow of the list within the run"


def interrupted(nx, n, path, simulate):
    """The same run in one go, and with a save and a load half-way; both with a list that overflows."""
    scene = turbulence(nx)
    whole = simulate(scene)
    width = tighten(whole)
    steps(whole, n)
    first = steps(simulate(scene), n // 2)
    first.save(path)
    second = Simulation.load(path, scene)
    begun = second.neighbours.builds
    tighten(second)
    steps(second, n - n // 2)
    assert second.neighbours.builds > begun, "a rebuild within the resumed leg"
    assert whole.neighbours.width > width, "an overflow within the run"
    assert digest(second) == digest(whole)
    assert (second.steps, second.floors, second.time) == (whole.steps, whole.floors, whole.time)
    assert second.ledger.E0 == whole.ledger.E0 and (second.ledger.p0 == whole.ledger.p0).all()
    second.close()


def test_a_resumed_run_gives_the_same_bits(tmp_path, simulate):
    interrupted(32, 120, tmp_path / "state.npz", simulate)


@pytest.mark.slow
def test_a_resumed_run_gives_the_same_bits_for_20000_particles_and_200_steps(tmp_path, simulate):
    interrupted(144, 200, tmp_path / "state.npz", simulate)


def test_reading_and_saving_change_no_bit(tmp_path, simulate):
    quiet, busy = simulate(turbulence(16)), simulate(turbulence(16))
    for k in range(30):
        quiet.step()
        busy.step()
        if k % 3 == 0:
            busy["B"], busy.rates(), busy.summary(), busy.sample("rho", np.array([[0.5, 0.5]]))
            busy.save(tmp_path / "state.npz")
    assert digest(busy) == digest(quiet)


def test_hydro_states_are_saved_too(tmp_path, simulate):
    """No field, no ledger of leaks: the file has what the scene has."""
    start = lambda x: {k: v for k, v in swirl(x).items() if k != "B"}  # noqa: E731
    scene = turbulence(12, terms=(Pressure(),), start=start)
    sim = steps(simulate(scene), 3)
    sim.save(tmp_path / "state.npz")
    again = Simulation.load(tmp_path / "state.npz", scene)
    assert digest(steps(again, 3)) == digest(steps(sim, 3))
    again.close()


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    """A scene, and the bytes of a state of it."""
    scene, path = turbulence(12), tmp_path_factory.mktemp("saved") / "state.npz"
    with Simulation(scene) as sim:
        sim.step()
        sim.save(path)
    return scene, path.read_bytes()


def altered(content: bytes, **changes) -> bytes:
    """The same file with other arrays; None leaves one out."""
    with np.load(io.BytesIO(content)) as file:
        arrays = {**file, **changes}
    out = io.BytesIO()
    np.savez(out, **{name: values for name, values in arrays.items() if values is not None})
    return out.getvalue()


def spoiled(content: bytes) -> bytes:
    """One number in the middle of the table is not finite."""
    with np.load(io.BytesIO(content)) as file:
        table = file["table"].copy()
    table[5, 5] = np.nan
    return altered(content, table=table)


def flipped(content: bytes) -> bytes:
    """One byte of the table differs: the checksum of the archive tells."""
    k = len(content) // 2
    return content[:k] + bytes([content[k] ^ 255]) + content[k + 1 :]


def pickled(content: bytes) -> bytes:
    out = io.BytesIO()
    np.savez(out, table=np.array([{"a": 1}], dtype=object))
    return out.getvalue()


BAD = {
    "truncated": (lambda c: c[: len(c) // 2], "damaged"),
    "empty": (lambda c: b"", "damaged"),
    "text": (lambda c: b"t,step,dt\n", "damaged"),
    "flipped bit": (flipped, "damaged"),
    "pickled": (pickled, "damaged"),
    "foreign": (lambda c: altered(c, format=None, table=None), "damaged"),
    "other format": (lambda c: altered(c, format=99), "format 99"),
    "not finite": (spoiled, "not finite"),
    "double particle": (lambda c: altered(c, ids=np.zeros(144, np.int32)), "missing or double"),
    "single precision": (lambda c: altered(c, precision="f32"), "--precision f32"),
    "no rates": (lambda c: altered(c, rate_v=None), "rate_v"),
}


@pytest.mark.parametrize("spoil, says", BAD.values(), ids=BAD)
def test_a_bad_file_is_one_line_with_the_cure(tmp_path, saved, spoil, says):
    scene, content = saved
    path = tmp_path / "state.npz"
    path.write_bytes(spoil(content))
    with pytest.raises(InputError, match=says) as error:
        Simulation.load(path, scene)
    assert str(path) in str(error.value) and "\n" not in str(error.value)


def test_a_missing_file_and_another_scene_are_told(tmp_path, saved):
    scene, content = saved
    with pytest.raises(InputError, match="no such state"):
        Simulation.load(tmp_path / "none.npz", scene)
    path = tmp_path / "state.npz"
    path.write_bytes(content)
    with pytest.raises(InputError, match="144 particles, the scene has 256"):
        Simulation.load(path, turbulence(16))
    with pytest.raises(InputError, match="saved by another scene"):
        Simulation.load(path, scene.without(Cleaning))
    with pytest.raises(InputError, match="saved by another scene"):
        Simulation.load(path, scene.but(kernel=CubicSpline(1.3)))


def test_a_folder_that_is_a_file_is_told(tmp_path, simulate):
    (tmp_path / "out").write_text("mine")
    with pytest.raises(InputError, match="choose another folder"):
        simulate(turbulence(12)).save(tmp_path / "out" / "state.npz")


@pytest.mark.parametrize("call", ["fsync", "replace"])
def test_a_full_disk_leaves_the_last_state_as_it_was(tmp_path, simulate, monkeypatch, call):
    path, sim = tmp_path / "state.npz", simulate(turbulence(12))
    sim.save(path)
    before = path.read_bytes()

    def full(*_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, call, full)
    with pytest.raises(InputError, match="No space left on device; free space"):
        sim.save(path)
    assert path.read_bytes() == before
    assert [file.name for file in tmp_path.iterdir()] == ["state.npz"], "the incomplete file is gone"


KILLED = """
runtime.init(arch="cpu", precision="f64", threads=2)
sim = Simulation(turbulence(64))
while True:
    sim.step()
    sim.save(sys.argv[1])
"""


@pytest.mark.slow
def test_a_killed_run_leaves_a_whole_state_that_goes_on_with_the_same_bits(tmp_path, simulate):
    path, running = tmp_path / "state.npz", child(KILLED, tmp_path / "state.npz")
    until = time.monotonic() + 120
    while not path.exists() and running.poll() is None and time.monotonic() < until:
        time.sleep(0.05)
    time.sleep(1.0)  # in the midst of saving, which takes most of its time
    running.kill()
    running.communicate()
    resumed = Simulation.load(path, turbulence(64))
    whole = steps(simulate(turbulence(64)), resumed.steps)
    assert resumed.steps > 1 and digest(steps(resumed, 5)) == digest(steps(whole, 5))
    resumed.close()
