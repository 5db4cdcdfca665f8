"""What a run that went wrong leaves on the disk: the last good state and a picture of the place."""

import errno

import numpy as np
import pytest
from PIL import Image
from tiny import EXPLODES, run, write

from taichi_spmhd import Boundary, Open, RunError, Scene, Simulation, cubic, cures, line, render, square
from taichi_spmhd.failure import explained
from taichi_spmhd.render.place import RED, place
from taichi_spmhd.terms import Pressure

INK = tuple(int(RED[k : k + 2], 16) for k in (1, 3, 5))


def test_a_run_that_explodes_leaves_a_picture_that_the_error_names(tmp_path, capsys):
    scene, out = write(tmp_path, EXPLODES), tmp_path / "out"
    assert run(scene, out, "--variant", "bang") == 3
    said = capsys.readouterr().err
    assert f"the place: {out / 'failure_bang.png'}" in said and "no picture" not in said
    with Image.open(out / "failure_bang.png") as picture:
        pixels = np.asarray(picture.convert("RGB"))
    assert (pixels == INK).all(axis=2).sum() > 50  # the ring around the ill particle
    assert [path.name for path in out.glob("failure_*")] == ["failure_bang.png"]
    assert run(scene, out, "--resume") == 3  # it has ended; the line is the same
    assert capsys.readouterr().err == said
    assert run(scene, out, "--frames", 2, "--variant", "calm") == 0
    assert not list(out.glob("failure_*"))  # a new start takes it away


def test_a_disk_that_takes_no_picture_does_not_hide_what_went_wrong(tmp_path, capsys):
    def full(path, rgb):
        if "failure" in str(path):
            raise OSError(errno.ENOSPC, "No space left on device")
        own(path, rgb)

    own = render.write_png
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(render, "write_png", full)
        assert run(write(tmp_path, EXPLODES), tmp_path / "out", "--variant", "bang") == 3
    said = capsys.readouterr().err.strip().splitlines()
    assert len(said) == 1 and "bang: not finite at t = 0.05" in said[0]
    assert "no picture of the place: No space left on device" in said[0] and "the place: " in said[0]
    assert not (tmp_path / "out" / "failure_bang.png").exists()
    assert (tmp_path / "out" / "state_bang.npz").exists() and (tmp_path / "out" / "summary.json").exists()


LATTICES = {1: line((1.0,), 24), 2: square((1.0, 1.0), 12), 3: cubic((1.0,) * 3, 10)}


def gas(dim: int, **changes) -> Scene:
    """A uniform gas at rest in a box of length 1."""
    given = {"box": (1.0,) * dim, "positions": LATTICES[dim], "start": lambda x: {"rho": 1.0, "P": 0.6}}
    return Scene(**{**given, **changes}, terms=(Pressure(),))


@pytest.mark.parametrize("dim", LATTICES)
def test_the_place_is_drawn_in_one_two_and_three_dimensions(simulate, dim):
    sim = simulate(gas(dim))
    sim.step()
    for member in ("u", "v", "x"):
        error = explained(sim, "a test", cures.NOT_FINITE, (3, member), "Pressure")
        assert error.particle == sim.particles.table()[1][3] and len(error.position) == dim
        pixels = place(sim, error)
        assert pixels.shape == (560, 640, 3) and pixels.dtype == np.uint8
        assert (pixels == INK).all(axis=2).sum() > 50
        assert len(np.unique(pixels.reshape(-1, 3), axis=0)) > 20  # dots and words beside it


def test_the_place_is_drawn_when_numbers_are_not_finite(simulate):
    sim = simulate(gas(2, boundary=Boundary(x=Open(), y=Open())))
    sim.step()
    table, ids = sim.particles.table()
    first = sim.particles.first
    for broken in ("u", "x", "h"):
        wrong = table.copy()
        wrong[5, first[broken]] = np.nan
        sim.particles.admit(wrong, ids)
        error = RunError("a test", cures.NOT_FINITE, particle=int(ids[5]), member=broken, time=sim.time, step=1)
        # a position that is lost is ringed where it was at the last build, a support by the middle one of all
        assert (place(sim, error) == INK).all(axis=2).sum() > 50


def test_a_script_is_told_without_reading_words():
    sim = Simulation(gas(2, start=lambda x: {"rho": 1.0, "P": 0.6}))
    with sim, pytest.raises(RunError) as caught:
        sim.step()
        sim.step(0.0)
    error = caught.value
    assert (error.cause, error.step, error.time) == (cures.COLLAPSED, 2, sim.time)
    assert error.particle in range(len(LATTICES[2])) and error.term == "Pressure"
