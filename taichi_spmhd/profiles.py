"""Starting positions whose spacing carries a density: smooth profiles along an axis, and the step of a shock tube."""

from collections.abc import Callable
from math import ceil, sqrt
from typing import NamedTuple

import numpy as np

from .box import Box
from .errors import InputError
from .lattice import centres, even, fitting, matching, staggered, whole, wrapped

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)  # exact to round-off on 1/256 of a smooth profile
_PANELS = 256


class Step(NamedTuple):
    """Two uniform regions of equal-mass particles: positions (N, d), mass per particle, the box they tile exactly."""

    positions: np.ndarray
    mass: float
    box: Box


def displaced(positions: np.ndarray, box, density: Callable, axis: int = 0) -> np.ndarray:
    """A uniform lattice moved along `axis` so that equal masses carry rho(x): M(x')/M(hi) = (x - lo)/(hi - lo).

    density: function of the coordinate, array -> array, positive, in any unit (only its shape counts).
    M is its integral from lo, solved to round-off for smooth profiles. Raises InputError where density <= 0.
    """
    box, positions = matching(positions, box)
    if axis not in range(box.dim):
        raise InputError(f"axis = {axis!r}: give one of {', '.join(map(str, range(box.dim)))}")
    lo, hi = box.lo[axis], box.hi[axis]
    old, column = np.unique(positions[:, axis], return_inverse=True)  # a column of particles moves as one
    moved = positions.copy()
    moved[:, axis] = _at_share(density, np.linspace(lo, hi, _PANELS + 1), (old - lo) / (hi - lo))[column.reshape(-1)]
    return wrapped(moved, box)


def _at_share(density: Callable, edges: np.ndarray, share: np.ndarray) -> np.ndarray:
    """x with M(x) = share M(hi): Newton, held inside the panel in which the solution lies."""
    mass = np.concatenate([[0.0], np.cumsum(_integral(density, edges[:-1], edges[1:]))])
    target = share * mass[-1]
    panel = np.clip(np.searchsorted(mass, target, side="right") - 1, 0, _PANELS - 1)
    low, high = edges[panel], edges[panel + 1]
    x = 0.5 * (low + high)
    for _ in range(12):  # a smooth profile is nearly constant in a panel: 3 to 4 reach round-off
        x = np.clip(x + (target - mass[panel] - _integral(density, low, x)) / density(x), low, high)
    return x


def _integral(density: Callable, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The integrals of density over many intervals [a, b], by Gauss-Legendre; arrays of one shape (n,)."""
    half = 0.5 * (b - a)
    rho = np.broadcast_to(density((a + half)[:, None] + half[:, None] * _NODES), (len(half), len(_NODES)))
    if not (np.all(rho > 0) and np.all(np.isfinite(rho))):
        raise InputError("displaced: the density must be positive and finite everywhere in the box; add a floor to it")
    return half * (rho @ _WEIGHTS)


def step_lattice(x_range, nx: int, rho: tuple[float, float], rows: int | None = None, at: float = 0.0) -> Step:
    """Equal masses at density rho[0] left and rho[1] right of x = at, the start of a shock tube.

    x_range: (lower, upper); nx: particles along x, both sides together. rows None: 1-D, dx_R = dx_L rho_L/rho_R.
    rows even: hexagonal strip, periodic in y, with `rows` rows in the dense part; the areas a particle are exactly in
    the ratio of the densities. Step.box is what they tile: it covers x_range, the thin side's end moved out by less
    than a spacing, and as high as the rows are. Choose it wider than two supports of the thin side. Raises InputError.
    """
    lengths, dense = _sides(x_range, nx, rho, rows, at)
    dim = 1 if rows is None else 2
    fineness = [(side / rho[dense]) ** (1 / dim) for side in rho]  # 1 in the dense part
    dx = lengths[dense] / max(1, round(nx * lengths[dense] / np.dot(lengths, fineness)))
    height = () if rows is None else (sqrt(0.75) * dx * rows,)
    counts = [1 if rows is None else even(rows * fine) for fine in fineness]
    widths = [dx * rho[dense] / side * n / counts[dense] for side, n in zip(rho, counts, strict=True)]
    columns = [ceil(length / width - 1e-9) for length, width in zip(lengths, widths, strict=True)]
    bottom = (0.0,) * (dim - 1)
    left = Box((at - columns[0] * widths[0], *bottom), (at, *height))
    right = Box((at, *bottom), (at + columns[1] * widths[1], *height))
    sides = [
        centres(half, n) if rows is None else staggered(half, n, count)
        for half, n, count in zip((left, right), columns, counts, strict=True)
    ]
    return Step(np.concatenate(sides), rho[0] * left.volume / len(sides[0]), Box(left.lo, right.hi))


def _sides(x_range, nx: int, rho, rows: int | None, at: float) -> tuple[tuple[float, float], int]:
    """Lengths left and right of the step, and which side is denser; everything checked."""
    box = fitting("step_lattice (x axis)", [tuple(x_range)], 1)
    whole("nx", nx, 2)
    if rows is not None and whole("rows", rows, 2) % 2:
        raise InputError(f"rows = {rows}: give an even number, or the hexagonal strip does not close; for instance 24")
    if len(rho) != 2 or not all(0 < side < np.inf for side in rho):
        raise InputError(f"rho = {rho!r}: give the two positive densities (left, right)")
    if not box.lo[0] < at < box.hi[0]:
        raise InputError(f"the step at x = {at} is not inside x_range = {x_range!r}: move it inside")
    return (at - box.lo[0], box.hi[0] - at), 0 if rho[0] >= rho[1] else 1
