"""Starting positions: lattices that tile a periodic box exactly, small disturbances of them, density jumps.

Positions have shape (N, d) and lie in lo <= x < hi, never on an edge. Rows and layers are stretched slightly so that
whole numbers of them fit, which keeps every copy of the box in step with its neighbours.
"""

from collections.abc import Callable
from math import ceil, sqrt
from numbers import Integral, Real
from typing import NamedTuple

import numpy as np

from .box import Box, as_box
from .errors import InputError

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)  # exact to round-off on 1/256 of a smooth profile
_PANELS = 256


class Step(NamedTuple):
    """Two uniform regions of equal-mass particles: positions (N, d), mass per particle, the box they tile exactly."""

    positions: np.ndarray
    mass: float
    box: Box


def _whole(name: str, number, least: int = 1) -> int:
    """`number` if it is a whole number, at least `least`."""
    if isinstance(number, bool) or not isinstance(number, Integral) or number < least:
        raise InputError(f"{name} = {number!r}: give a whole number of at least {least}")
    return int(number)


def _box(name: str, box, dim: int) -> Box:
    """`box` if it has the dimension that a lattice fills."""
    box = as_box(box)
    if box.dim != dim:
        fits = ("line", "hexagonal or square", "close_packed or cubic")[box.dim - 1]
        raise InputError(f"{name} fills {dim} dimension(s) and this box has {box.dim}: use {fits}")
    return box


def _even(count: float) -> int:
    """The nearest even number, at least 2: alternating rows and layers only close in pairs."""
    return 2 * max(1, round(count / 2))


def _grid(box: Box, nx: int) -> np.ndarray:
    """Cell centres of the most nearly cubic cells with nx along x."""
    dx = box.size[0] / nx
    counts = [nx, *(max(1, round(length / dx)) for length in box.size[1:])]
    axes = [lo + (np.arange(n) + 0.5) * length / n for lo, length, n in zip(box.lo, box.size, counts, strict=True)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, box.dim)


def line(box, nx: int) -> np.ndarray:
    """nx evenly spaced particles on a line, shape (nx, 1). Raises InputError for a box that is not 1-D."""
    return _grid(_box("line", box, 1), _whole("nx", nx))


def square(box, nx: int) -> np.ndarray:
    """A square lattice with nx particles along x, shape (N, 2). For shocks prefer `hexagonal`: squares buckle."""
    return _grid(_box("square", box, 2), _whole("nx", nx))


def cubic(box, nx: int) -> np.ndarray:
    """A cubic lattice with nx particles along x, shape (N, 3). For shocks prefer `close_packed`."""
    return _grid(_box("cubic", box, 3), _whole("nx", nx))


def hexagonal(box, nx: int) -> np.ndarray:
    """Rows of nx particles, dy = sqrt(3)/2 dx, odd rows shifted by dx/2; shape (N, 2). Raises InputError.

    The number of rows is even and dy stretched to fit; a box of height sqrt(3)/2 times a multiple of 2 dx needs none.
    """
    box, nx = _box("hexagonal", box, 2), _whole("nx", nx)
    rows = _even(box.size[1] / (sqrt(0.75) * box.size[0] / nx))
    return _rows(box, nx, rows)


def _rows(box: Box, columns: int, rows: int) -> np.ndarray:
    """A hexagonal lattice stretched to `columns` x `rows` (even) particles; the quarter keeps both edges free."""
    i, j = np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij")
    steps = np.stack([i + 0.25 + 0.5 * (j % 2), j + 0.5], axis=-1).reshape(-1, 2)
    return np.array(box.lo) + steps * (np.array(box.size) / (columns, rows))


def close_packed(box, nx: int) -> np.ndarray:
    """Hexagonal close packing: layers dz = sqrt(2/3) dx apart, stacked ABAB; shape (N, 3). Raises InputError.

    Even numbers of rows and of layers, stretched to fit; unstretched, each particle has 12 neighbours at dx.
    """
    box, nx = _box("close_packed", box, 3), _whole("nx", nx)
    dx = box.size[0] / nx
    rows, layers = _even(box.size[1] / (sqrt(3 / 4) * dx)), _even(box.size[2] / (sqrt(2 / 3) * dx))
    i, j, k = np.meshgrid(np.arange(nx), np.arange(rows), np.arange(layers), indexing="ij")
    # layer B sits above the gaps of layer A: dx/2 along x, a third of a row along y
    steps = np.stack([i + 0.25 + 0.5 * ((j + k) % 2), j + (1 + k % 2) / 3, k + 0.5], axis=-1).reshape(-1, 3)
    return np.array(box.lo) + steps * (np.array(box.size) / (nx, rows, layers))


def spacing(box, n: int) -> float:
    """The mean spacing (volume / n)^(1/d) of n particles."""
    box = as_box(box)
    return (box.volume / _whole("number of particles", n)) ** (1 / box.dim)


def jitter(positions: np.ndarray, box, amplitude: float, seed: int = 0) -> np.ndarray:
    """Positions moved by Gaussian noise of s.d. `amplitude` mean spacings along each axis, wrapped into the box.

    The same seed gives the same bits. Raises InputError for a negative amplitude or positions of another dimension.
    """
    box, positions = _matching(positions, box)
    if not (isinstance(amplitude, Real) and 0 <= amplitude < np.inf):
        raise InputError(f"jitter amplitude = {amplitude!r}: give a number >= 0 in mean spacings, for instance 0.1")
    noise = np.random.default_rng(_whole("seed", seed, 0)).standard_normal(positions.shape)
    return _wrap(positions + amplitude * spacing(box, len(positions)) * noise, box)


def _matching(positions, box) -> tuple[Box, np.ndarray]:
    """Box and positions (N, d) of one dimension."""
    box, positions = as_box(box), np.asarray(positions, dtype=float)
    if positions.ndim != 2 or positions.shape[1] != box.dim or len(positions) == 0:
        raise InputError(f"positions of shape {positions.shape} in a {box.dim}-D box: give an array (N, {box.dim})")
    return box, positions


def _wrap(positions: np.ndarray, box: Box) -> np.ndarray:
    """Periodic copies inside lo <= x < hi; rounding may land exactly on hi, which is lo."""
    lo, hi = np.array(box.lo), np.array(box.hi)
    wrapped = lo + np.mod(positions - lo, hi - lo)
    return np.where(wrapped < hi, wrapped, lo)


def displaced(positions: np.ndarray, box, density: Callable, axis: int = 0) -> np.ndarray:
    """A uniform lattice moved along `axis` so that equal masses carry rho(x): M(x')/M(hi) = (x - lo)/(hi - lo).

    density: function of the coordinate, array -> array, positive, in any unit (only its shape counts).
    M is its integral from lo, solved to round-off for smooth profiles. Raises InputError where density <= 0.
    """
    box, positions = _matching(positions, box)
    if axis not in range(box.dim):
        raise InputError(f"axis = {axis!r}: give one of {', '.join(map(str, range(box.dim)))}")
    lo, hi = box.lo[axis], box.hi[axis]
    old, column = np.unique(positions[:, axis], return_inverse=True)  # a column of particles moves as one
    moved = positions.copy()
    moved[:, axis] = _at_share(density, np.linspace(lo, hi, _PANELS + 1), (old - lo) / (hi - lo))[column.reshape(-1)]
    return _wrap(moved, box)


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
    counts = [1 if rows is None else _even(rows * fine) for fine in fineness]
    widths = [dx * rho[dense] / side * n / counts[dense] for side, n in zip(rho, counts, strict=True)]
    columns = [ceil(length / width - 1e-9) for length, width in zip(lengths, widths, strict=True)]
    bottom = (0.0,) * (dim - 1)
    left = Box((at - columns[0] * widths[0], *bottom), (at, *height))
    right = Box((at, *bottom), (at + columns[1] * widths[1], *height))
    sides = [
        _grid(half, n) if rows is None else _rows(half, n, count)
        for half, n, count in zip((left, right), columns, counts, strict=True)
    ]
    return Step(np.concatenate(sides), rho[0] * left.volume / len(sides[0]), Box(left.lo, right.hi))


def _sides(x_range, nx: int, rho, rows: int | None, at: float) -> tuple[tuple[float, float], int]:
    """Lengths left and right of the step, and which side is denser; everything checked."""
    box = _box("step_lattice (x axis)", [tuple(x_range)], 1)
    _whole("nx", nx, 2)
    if rows is not None and _whole("rows", rows, 2) % 2:
        raise InputError(f"rows = {rows}: give an even number, or the hexagonal strip does not close; for instance 24")
    if len(rho) != 2 or not all(0 < side < np.inf for side in rho):
        raise InputError(f"rho = {rho!r}: give the two positive densities (left, right)")
    if not box.lo[0] < at < box.hi[0]:
        raise InputError(f"the step at x = {at} is not inside x_range = {x_range!r}: move it inside")
    return (at - box.lo[0], box.hi[0] - at), 0 if rho[0] >= rho[1] else 1
