"""Errors against a stored map of another code: normalised L1 of the particles' fields, interpolated to its cells.

A map is a .npz file with 2-D arrays a[j, i] = a(y_j, x_i), means over equal cells of the whole box, under the names
rho, p, vx, vy, vz, Bx, By, Bz (those there are), the time `t`, and `meta`, a sentence that says where it comes from.
"""

from functools import lru_cache
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..kernels import QuinticSpline
from .sample import interpolate

MAPS = {"rho": ("rho",), "P": ("p",), "v": ("vx", "vy", "vz"), "B": ("Bx", "By", "Bz")}
WITHIN = 0.01  # of the map's time: a run that is further from it is not compared


def reference_errors(sim) -> dict[str, float]:
    """mean |a - b| / mean |b| over the cells by member, of v and B the mean over the components the map has.

    a: the particles' field at the cell's centre, normalised interpolation with the quintic spline at each particle's
    own h; b: the map. Where there are fewer particles than cells, blocks of cells are averaged. {} where the scene has
    no map, and at any other time than the map's. Raises InputError for a file that is no such map.
    """
    path = sim.scene.reference
    if path is None:
        return {}
    maps = loaded(path, path.stat().st_mtime_ns)
    if abs(sim.time - maps["t"]) > WITHIN * maps["t"]:
        return {}
    shape = next(values.shape for name, values in maps.items() if name != "t")
    block, there, out = block_of(sim, shape), sim.columns(), {}
    points = centres(sim.scene.box, (shape[0] // block, shape[1] // block))
    for member, names in MAPS.items():
        axes = [axis for axis, name in enumerate(names) if name in maps]
        if axes and member in there:
            ours = interpolate(sim, member, points, kernel=QuinticSpline()).reshape(len(points), -1)
            theirs = (means(maps[names[axis]], block).ravel() for axis in axes)
            out[member] = float(np.mean([error(ours[:, a], b) for a, b in zip(axes, theirs, strict=True)]))
    return out


def error(ours: np.ndarray, theirs: np.ndarray) -> float:
    """mean |a - b| / mean |b|"""
    return float(np.abs(ours - theirs).mean() / np.abs(theirs).mean())


@lru_cache(maxsize=8)
def loaded(path: Path, stamp: int) -> dict:
    """The maps of a file by name, and its time t; stamp: when the file was last changed."""
    try:
        with np.load(path, allow_pickle=False) as file:
            maps = {name: file[name].astype(float) for names in MAPS.values() for name in names if name in file.files}
            time = float(file["t"])
    except Exception as problem:  # a wrong byte can come up in any layer: archive, compression, header, array
        raise InputError(
            f"reference {path} is no map: {problem}; give a .npz with 2-D arrays and the time t"
        ) from problem
    if len({values.shape for values in maps.values()}) != 1 or next(iter(maps.values())).ndim != 2:
        raise InputError(f"reference {path}: give 2-D arrays of one shape under the names rho, p, vx, vy, Bx, By")
    if not all(values.size and np.isfinite(values).all() for values in maps.values()) or not np.isfinite(time):
        raise InputError(f"reference {path}: its arrays and its time t must be finite numbers")
    return {**maps, "t": time}


def block_of(sim, shape: tuple[int, int]) -> int:
    """Cells to average along each axis: the fewest that leave no more cells than particles along every side."""
    spacing = (sim.scene.box.volume / len(sim)) ** 0.5
    most = [max(1, round(size / spacing)) for size in reversed(sim.scene.box.size)]
    common = int(np.gcd(*shape))
    blocks = [k for k in range(1, common + 1) if common % k == 0]
    return next((k for k in blocks if all(n // k <= m for n, m in zip(shape, most, strict=True))), common)


def means(values: np.ndarray, block: int) -> np.ndarray:
    """Means over blocks of cells."""
    rows, columns = (n // block for n in values.shape)
    return values.reshape(rows, block, columns, block).mean(axis=(1, 3))


def centres(box, shape: tuple[int, int]) -> np.ndarray:
    """Centres (rows * columns, 2) of equal cells of the box, in the order of a map's elements."""
    y, x = (box.lo[a] + (np.arange(n) + 0.5) * box.size[a] / n for a, n in zip((1, 0), shape, strict=True))
    return np.stack([axis.ravel() for axis in np.meshgrid(x, y)], axis=1)
