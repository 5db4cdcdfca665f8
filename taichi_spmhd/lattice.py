"""Starting positions: lattices that tile a periodic box exactly, small disturbances of them, density jumps.

Positions have shape (N, d) and lie in lo <= x < hi, never on an edge. Rows and layers are stretched slightly so that
whole numbers of them fit, which keeps every copy of the box in step with its neighbours.
"""

from math import sqrt
from numbers import Integral, Real

import numpy as np

from .box import Box, as_box
from .errors import InputError


def whole(name: str, number, least: int = 1) -> int:
    """`number` if it is a whole number, at least `least`."""
    if isinstance(number, bool) or not isinstance(number, Integral) or number < least:
        raise InputError(f"{name} = {number!r}: give a whole number of at least {least}")
    return int(number)


def fitting(name: str, box, dim: int) -> Box:
    """`box` if it has the dimension that a lattice fills."""
    box = as_box(box)
    if box.dim != dim:
        fits = ("line", "hexagonal or square", "close_packed or cubic")[box.dim - 1]
        raise InputError(f"{name} fills {dim} dimension(s) and this box has {box.dim}: use {fits}")
    return box


def even(count: float) -> int:
    """The nearest even number, at least 2: alternating rows and layers only close in pairs."""
    return 2 * max(1, round(count / 2))


def centres(box: Box, nx: int) -> np.ndarray:
    """Cell centres of the most nearly cubic cells with nx along x."""
    dx = box.size[0] / nx
    counts = [nx, *(max(1, round(length / dx)) for length in box.size[1:])]
    axes = [lo + (np.arange(n) + 0.5) * length / n for lo, length, n in zip(box.lo, box.size, counts, strict=True)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, box.dim)


def line(box, nx: int) -> np.ndarray:
    """nx evenly spaced particles on a line, shape (nx, 1). Raises InputError for a box that is not 1-D."""
    return centres(fitting("line", box, 1), whole("nx", nx))


def square(box, nx: int) -> np.ndarray:
    """A square lattice with nx particles along x, shape (N, 2). For shocks prefer `hexagonal`: squares buckle."""
    return centres(fitting("square", box, 2), whole("nx", nx))


def cubic(box, nx: int) -> np.ndarray:
    """A cubic lattice with nx particles along x, shape (N, 3). For shocks prefer `close_packed`."""
    return centres(fitting("cubic", box, 3), whole("nx", nx))


def hexagonal(box, nx: int) -> np.ndarray:
    """Rows of nx particles, dy = sqrt(3)/2 dx, odd rows shifted by dx/2; shape (N, 2). Raises InputError.

    The number of rows is even and dy stretched to fit; a box of height sqrt(3)/2 times a multiple of 2 dx needs none.
    """
    box, nx = fitting("hexagonal", box, 2), whole("nx", nx)
    rows = even(box.size[1] / (sqrt(0.75) * box.size[0] / nx))
    return staggered(box, nx, rows)


def staggered(box: Box, columns: int, rows: int) -> np.ndarray:
    """A hexagonal lattice stretched to `columns` x `rows` (even) particles; the quarter keeps both edges free."""
    i, j = np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij")
    steps = np.stack([i + 0.25 + 0.5 * (j % 2), j + 0.5], axis=-1).reshape(-1, 2)
    return np.array(box.lo) + steps * (np.array(box.size) / (columns, rows))


def close_packed(box, nx: int) -> np.ndarray:
    """Hexagonal close packing: layers dz = sqrt(2/3) dx apart, stacked ABAB; shape (N, 3). Raises InputError.

    Even numbers of rows and of layers, stretched to fit; unstretched, each particle has 12 neighbours at dx.
    """
    box, nx = fitting("close_packed", box, 3), whole("nx", nx)
    dx = box.size[0] / nx
    rows, layers = even(box.size[1] / (sqrt(3 / 4) * dx)), even(box.size[2] / (sqrt(2 / 3) * dx))
    i, j, k = np.meshgrid(np.arange(nx), np.arange(rows), np.arange(layers), indexing="ij")
    # layer B sits above the gaps of layer A: dx/2 along x, a third of a row along y
    steps = np.stack([i + 0.25 + 0.5 * ((j + k) % 2), j + (1 + k % 2) / 3, k + 0.5], axis=-1).reshape(-1, 3)
    return np.array(box.lo) + steps * (np.array(box.size) / (nx, rows, layers))


def spacing(box, n: int) -> float:
    """The mean spacing (volume / n)^(1/d) of n particles."""
    box = as_box(box)
    return (box.volume / whole("number of particles", n)) ** (1 / box.dim)


def jitter(positions: np.ndarray, box, amplitude: float, seed: int = 0) -> np.ndarray:
    """Positions moved by Gaussian noise of s.d. `amplitude` mean spacings along each axis, wrapped into the box.

    The same seed gives the same bits. Raises InputError for a negative amplitude or positions of another dimension.
    """
    box, positions = matching(positions, box)
    if not (isinstance(amplitude, Real) and 0 <= amplitude < np.inf):
        raise InputError(f"jitter amplitude = {amplitude!r}: give a number >= 0 in mean spacings, for instance 0.1")
    noise = np.random.default_rng(whole("seed", seed, 0)).standard_normal(positions.shape)
    return wrapped(positions + amplitude * spacing(box, len(positions)) * noise, box)


def matching(positions, box) -> tuple[Box, np.ndarray]:
    """Box and positions (N, d) of one dimension."""
    box, positions = as_box(box), np.asarray(positions, dtype=float)
    if positions.ndim != 2 or positions.shape[1] != box.dim or len(positions) == 0:
        raise InputError(f"positions of shape {positions.shape} in a {box.dim}-D box: give an array (N, {box.dim})")
    return box, positions


def wrapped(positions: np.ndarray, box: Box) -> np.ndarray:
    """Periodic copies inside lo <= x < hi; rounding may land exactly on hi, which is lo."""
    lo, hi = np.array(box.lo), np.array(box.hi)
    wrapped = lo + np.mod(positions - lo, hi - lo)
    return np.where(wrapped < hi, wrapped, lo)
