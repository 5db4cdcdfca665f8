"""Errors against stored maps: known by hand on a small one, and the maps that ship belong to what they ship with."""

import numpy as np
import pytest

from taichi_spmhd import InputError, load_scene
from taichi_spmhd.diagnostics import errors
from taichi_spmhd.diagnostics.reference import block_of, centres, loaded, means
from taichi_spmhd.lattice import hexagonal, line, square
from taichi_spmhd.scene import Scene
from taichi_spmhd.terms import Pressure

BOX = ((-0.5, 0.5), (0.0, 2.0))


def gas(x=None, box=BOX, **changes):
    """P = 2, v = (1/2, -1/4, 0), at rest in itself."""
    start = {"rho": 1.0, "P": 2.0, "v": [0.5, -0.25, 0.0]}
    x = square(box, 8) if x is None else x
    return Scene(**{"box": box, "positions": x, "start": lambda x: start, "terms": (Pressure(),), **changes})


def written(path, **changes):
    """A map of 64 x 32 cells, so that 4 x 4 of them are one cell of the 8 x 16 particles."""
    flat = np.ones((64, 32))
    checks = 2 + np.indices(flat.shape).sum(axis=0) % 2 * 2 - 1  # 1 and 3 in turn: 2 in the mean over any block
    maps = {"p": checks, "vx": 2 * flat, "vy": -0.2 * flat, "Bx": flat, "t": 0.0, "meta": "by hand"}
    np.savez(path, **{**maps, **changes})
    return path


def test_blocks_are_averaged_and_components_count_alike(simulate, tmp_path):
    found = errors(simulate(gas(reference=written(tmp_path / "map.npz"))))
    assert found["P"] == pytest.approx(0, abs=1e-3)  # the summed density makes u and so P, to 1e-4
    assert found["v"] == pytest.approx((1.5 / 2 + 0.05 / 0.2) / 2)
    assert set(found) == {"P", "v"}, "no map of rho, no field in the gas"


def test_a_run_at_another_time_is_not_compared(simulate, tmp_path):
    sim = simulate(gas(reference=written(tmp_path / "map.npz", t=0.5)))
    assert errors(sim) == {}
    sim.time = 0.496  # within a hundredth
    assert set(errors(sim)) == {"P", "v"}


def test_the_cells_are_those_of_the_box_and_the_map_runs_along_x_first():
    points = centres(gas().box, (2, 4))
    assert points[0] == pytest.approx([-0.375, 0.5]) and points[1] == pytest.approx([-0.125, 0.5])
    assert points[-1] == pytest.approx([0.375, 1.5])
    values = np.arange(8.0).reshape(2, 4)
    assert means(values, 2).tolist() == [[2.5, 4.5]]


@pytest.mark.parametrize(
    ("x", "cells"),
    [(square((1.0, 1.0), 128), 128), (hexagonal((1.0, 1.0), 128), 128), (hexagonal((1.0, 1.0), 64), 64),
     (square((1.0, 1.0), 96), 64), (square((1.0, 1.0), 200), 128), (square((1.0, 1.0), 30), 16)],
)  # fmt: skip
def test_no_more_cells_than_particles_across_and_no_more_than_there_are(x, cells):
    class Sim:
        scene = gas(x, (1.0, 1.0))

        def __len__(self):
            return len(x)

    assert 128 // block_of(Sim(), (128, 128)) == cells


def test_what_is_no_map_is_refused(tmp_path):
    with pytest.raises(InputError, match="is no file"):
        gas(reference=tmp_path / "none.npz")
    with pytest.raises(InputError, match="maps are of two"):
        gas(line((1.0,), 20), (1.0,), reference=written(tmp_path / "map.npz"))
    (tmp_path / "text.npz").write_text("no map")
    np.savez(tmp_path / "timeless.npz", rho=np.ones((2, 2)))
    for name in ("text", "timeless"):
        with pytest.raises(InputError, match="is no map"):
            loaded(tmp_path / f"{name}.npz", 0)
    with pytest.raises(InputError, match="2-D arrays of one shape"):
        loaded(written(tmp_path / "odd.npz", vx=np.ones((3, 3))), 0)


def test_scenes_ship_the_map_of_what_they_show_and_of_nothing_else():
    for name, time in (("orszag_tang", 0.5), ("mhd_blast", 0.15)):
        for scene in load_scene(name, nx=16).values():
            maps = loaded(scene.reference, 0)
            assert maps["t"] == pytest.approx(time, rel=1e-3) and maps["t"] == pytest.approx(scene.t_end, rel=1e-2)
            assert set(maps) == {"rho", "p", "vx", "vy", "Bx", "By", "t"} and maps["rho"].shape == (128, 128)
    for other in ({"B0": 0.5}, {"angle": 30.0}):
        assert all(scene.reference is None for scene in load_scene("mhd_blast", nx=16, **other).values())
