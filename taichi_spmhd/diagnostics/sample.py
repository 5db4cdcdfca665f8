"""Between the particles: normalised SPH interpolation, A(x) = sum_j (m/rho) A_j W(r, h_j) / sum_j (m/rho) W(r, h_j).

Points gather from particles sorted into cells, one grid for each octave of reach, so that the work does not depend on
how different the smoothing lengths are. Every sum runs in a fixed order: the same bits for any number of threads.
"""

from functools import cache

import numpy as np

from ..errors import InputError
from ..kernels import Kernel
from ..runtime import ti

OCTAVES = 16  # of reach that get a grid of their own; smaller particles share the last
MOST_CELLS = 2**22


@ti.kernel
def gather(kernel: ti.template(), points: ti.types.ndarray(ndim=2), grid: ti.types.ndarray(ndim=2),
           shape: ti.types.ndarray(dtype=ti.i32, ndim=2), first: ti.types.ndarray(dtype=ti.i32, ndim=1),
           at: ti.types.ndarray(ndim=2), shares: ti.types.ndarray(ndim=2), sums: ti.types.ndarray(ndim=2)):  # fmt: skip
    """sums[p] += shares[j] f(r h_inv) over particles j; at: x, y, z, 1/h. grid: corner, cells per length, period (3).

    shape: number of cells, cells to look at on each side, whether periodic. Images are cells beyond the edge.
    """
    for p in range(points.shape[0]):
        c = ti.Vector.zero(ti.i32, 3)
        for a in ti.static(range(3)):
            far = ti.floor((points[p, a] - grid[0, a]) * grid[1, a])
            c[a] = ti.cast(ti.min(ti.max(far, -1.0 - shape[1, a]), 1.0 * shape[0, a] + shape[1, a]), ti.i32)
        for kz, ky, kx in ti.ndrange((-shape[1, 2], shape[1, 2] + 1), (-shape[1, 1], shape[1, 1] + 1),
                                     (-shape[1, 0], shape[1, 0] + 1)):  # fmt: skip
            cell, turns = wrapped(c + ti.Vector([kx, ky, kz]), shape)
            if cell >= 0:
                for j in range(first[cell], first[cell + 1]):
                    r2 = ti.cast(0.0, float)
                    for a in ti.static(range(3)):
                        r2 += (points[p, a] - at[j, a] - turns[a] * grid[2, a]) ** 2
                    f = kernel.f(ti.sqrt(r2) * at[j, 3])
                    for column in range(shares.shape[1]):
                        sums[p, column] += shares[j, column] * f


@ti.func
def wrapped(c, shape: ti.template()):
    """The cell behind c in an endless row of boxes, and how many boxes away it lies; -1 where there is none."""
    turns, there = ti.Vector.zero(ti.i32, 3), True
    for a in ti.static(range(3)):
        if shape[2, a] == 1:
            turns[a] = ti.cast(ti.floor(c[a] / ti.cast(shape[0, a], float)), ti.i32)
            c[a] -= turns[a] * shape[0, a]
        there = there and c[a] >= 0 and c[a] < shape[0, a]
    return ti.select(there, (c[2] * shape[0, 1] + c[1]) * shape[0, 0] + c[0], -1), turns


@cache
def placed(kernel: Kernel, dim: int) -> Kernel:
    """One object for equal kernels: Taichi compiles anew for every object it has not seen."""
    return kernel.at(dim)


def interpolate(sim, name: str, points: np.ndarray, kernel: Kernel | None = None) -> np.ndarray:
    """Member `name` at points (M, d), (M,) or (M, 3); NaN where no particle reaches. kernel: default the scene's.

    Periodic axes wrap; at walls and open edges the normalisation makes up for the missing side. Raises KeyError for an
    unknown member and InputError for points of another dimension.
    """
    columns = sim.columns()
    if name not in columns:
        raise KeyError(f"no member {name!r}; there are {', '.join(sorted(columns))}")
    points = np.asarray(points, float)
    if points.ndim != 2 or points.shape[1] != sim.dim:
        raise InputError(f"sample: points of shape {points.shape} do not fit {sim.dim} dimensions: give (M, {sim.dim})")
    kernel, word = placed(kernel or sim.scene.kernel, sim.dim), sim.particles.word
    weight = columns["m"] / columns["rho"] / columns["h"] ** sim.dim  # the norm of W cancels in the ratio
    values = columns[name].reshape(len(sim), -1)
    shares = np.column_stack([weight[:, None] * values, weight]).astype(word)
    sums = np.zeros((len(points), shares.shape[1]), word)
    x, points = solid(folded(sim, columns["x"]), word), solid(folded(sim, points), word)
    for mine in octaves(columns["h"]):
        grid, shape, first, order = cells(sim, x[mine], kernel.support * columns["h"][mine].max())
        at = np.column_stack([x[mine], 1 / columns["h"][mine]])[order].astype(word)
        gather(kernel, points, grid.astype(word), shape, first, at, np.ascontiguousarray(shares[mine][order]), sums)
    norm = np.where(sums[:, -1:] > 0, sums[:, -1:], np.nan)
    return (sums[:, :-1] / norm).reshape((len(points), *columns[name].shape[1:]))


def folded(sim, x: np.ndarray) -> np.ndarray:
    """Positions inside the box along periodic axes."""
    lo, size = np.array(sim.scene.box.lo), np.array(sim.scene.box.size)
    return np.where(sim.scene.boundary.periodic[: sim.dim], lo + np.mod(x - lo, size), x)


def solid(x: np.ndarray, word) -> np.ndarray:
    """Three coordinates, the missing ones zero: one kernel serves all dimensions."""
    return np.ascontiguousarray(np.pad(x, ((0, 0), (0, 3 - x.shape[1]))), dtype=word)


def octaves(h: np.ndarray):
    """Indices of the particles of each octave of h, largest first."""
    octave = np.clip(np.floor(np.log2(h.max() / h)), 0, OCTAVES - 1).astype(int)
    return [np.flatnonzero(octave == k) for k in np.unique(octave)]


def cells(sim, x: np.ndarray, reach: float):
    """A grid for particles x (n, 3): corner, cells per length, period; counts, range, periodicity; starts; order."""
    lo, size, wraps = np.zeros(3), np.ones(3), np.zeros(3, bool)
    for a in range(sim.dim):
        wraps[a] = sim.scene.boundary.periodic[a]
        edge = (sim.scene.box.lo[a], sim.scene.box.size[a]) if wraps[a] else (x[:, a].min(), np.ptp(x[:, a]))
        lo[a], size[a] = edge[0], max(edge[1], 1e-9 * reach)
    counts = np.maximum(1, size / reach)
    counts = np.maximum(1, counts / max(1.0, counts.prod() / min(MOST_CELLS, 4 * len(x) + 64)) ** (1 / sim.dim)).astype(
        int
    )
    counts[sim.dim :] = 1
    around = np.where(np.arange(3) < sim.dim, np.ceil(reach * counts / size * (1 + 1e-6)), 0).astype(int)
    c = np.clip(np.floor((x - lo) * (counts / size)).astype(int), 0, counts - 1)
    number = (c[:, 2] * counts[1] + c[:, 1]) * counts[0] + c[:, 0]
    first = np.concatenate([[0], np.cumsum(np.bincount(number, minlength=counts.prod()))]).astype(np.int32)
    shape = np.array([counts, around, wraps], np.int32)
    return np.array([lo, counts / size, size]), shape, first, np.argsort(number, kind="stable")
