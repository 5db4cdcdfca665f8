"""Patches: pieces of a periodic arrangement, wide enough that what one particle does to the others does not come round.

A lattice repeats a cell of a few particles. The response to one particle of each kind in the cell says everything, for
every wave vector: a wave is a sum over the copies of the cell.
"""

from dataclasses import dataclass
from math import sqrt

import numpy as np

from ..box import Box
from ..errors import InputError
from ..glass import glass
from ..lattice import close_packed, cubic, hexagonal, line, square

LATTICES = {1: ("line",), 2: ("hexagonal", "square", "glass"), 3: ("cubic", "close_packed", "glass")}
FILLED = {"line": 1.0, "square": 1.0, "cubic": 1.0, "glass": 1.0, "hexagonal": sqrt(3 / 4), "close_packed": sqrt(0.5)}
GLASS = {2: 6, 3: 5}  # particles along the cell of a glass; more cost the cube of their number


@dataclass(frozen=True, eq=False)
class Patch:
    """positions (N, d) in box; cell: indices of the particles of one cell; dx: spacing along a row of the lattice (of a
    glass: the mean spacing); steps (d, d): rows that lead from a cell to its neighbours, in dx."""

    name: str
    box: Box
    positions: np.ndarray
    cell: np.ndarray
    dx: float
    steps: np.ndarray

    @property
    def back(self) -> np.ndarray:
        """Reciprocal vectors as rows: wave vectors (in 1/dx) that are the same on every copy of the cell."""
        return 2 * np.pi * np.linalg.inv(self.steps).T

    def alike(self, k: np.ndarray, longest: float) -> np.ndarray:
        """(G, d): all wave vectors up to `longest` that the copies of a cell cannot tell from k, the shortest first."""
        most = int(np.ceil((longest + np.linalg.norm(k)) * np.linalg.norm(self.steps, axis=1).max() / (2 * np.pi)))
        whole = np.stack(np.meshgrid(*[np.arange(-most, most + 1)] * len(k), indexing="ij"), axis=-1)
        found = k + whole.reshape(-1, len(k)) @ self.back
        length = np.round(np.linalg.norm(found, axis=1), 9)
        return found[np.argsort(length, kind="stable")][: max(1, int((length <= longest).sum()))]


def patch(name: str, dim: int, volume: float, reach: float, kernel, seed: int = 0) -> Patch:
    """A piece of lattice `name` with this volume a particle; what a particle does is felt up to `reach` spacings away.

    Raises InputError for a lattice that this dimension does not have.
    """
    if name not in LATTICES[dim]:
        raise InputError(f"--lattice {name}: in {dim}-D there are {', '.join(LATTICES[dim])}")
    dx = (volume / FILLED[name]) ** (1 / dim)
    n = 2 * int(np.ceil(reach)) + 2
    return glassy(dim, dx, n, kernel, seed) if name == "glass" else regular(name, dim, dx, n)


def regular(name: str, dim: int, dx: float, n: int) -> Patch:
    """n particles along x and as many rows and layers as make it about as wide elsewhere, none of them stretched."""
    rows = 2 * int(np.ceil(n / (2 * sqrt(0.75))))
    layers = 2 * int(np.ceil(n / (2 * sqrt(2 / 3))))
    steps = {"hexagonal": (n, rows * sqrt(0.75)), "close_packed": (n, rows * sqrt(0.75), layers * sqrt(2 / 3))}
    box = tuple(dx * length for length in steps.get(name, (n,) * dim))
    make = {"line": line, "square": square, "hexagonal": hexagonal, "cubic": cubic, "close_packed": close_packed}[name]
    x = make(box, n)
    size = np.array(box)
    middle = int(np.argmin((((x - size / 2) / size) ** 2).sum(axis=1)))
    cell = [middle] if name != "close_packed" else pair_of_layers(x, middle, dx)
    return Patch(name, Box((0.0,) * dim, box), x, np.array(cell), dx, primitive(name, dim))


def primitive(name: str, dim: int) -> np.ndarray:
    """The steps from one cell of a lattice to the next."""
    if name not in ("hexagonal", "close_packed"):
        return np.eye(dim)
    rows = np.array([[1.0, 0.0, 0.0], [0.5, sqrt(0.75), 0.0], [0.0, 0.0, 2 * sqrt(2 / 3)]])
    return rows[:dim, :dim]


def pair_of_layers(x: np.ndarray, middle: int, dx: float) -> list[int]:
    """Hexagonal close packing alternates two layers: a particle of each."""
    above = np.abs(x[:, 2] - x[middle, 2] - sqrt(2 / 3) * dx) < 0.1 * dx
    nearest = np.where(above, ((x - x[middle]) ** 2).sum(axis=1), np.inf)
    return [middle, int(np.argmin(nearest))]


def glassy(dim: int, dx: float, n: int, kernel, seed: int) -> Patch:
    """A relaxed cell and its periodic copies, an odd number along each axis: the one in the middle is the cell."""
    along = max(GLASS[dim], int(np.ceil(2 * kernel.support * kernel.h_fact)) + 1)
    size = (along * dx,) * dim
    own = glass(size, along, kernel, seed)
    copies = 2 * int(np.ceil((n / along - 1) / 2)) + 1
    shifts = np.stack(np.meshgrid(*[np.arange(copies)] * dim, indexing="ij"), axis=-1).reshape(-1, dim) * along * dx
    x = (own[None] + shifts[:, None]).reshape(-1, dim)
    centre = len(shifts) // 2
    cell = np.arange(centre * len(own), (centre + 1) * len(own))
    return Patch(
        "glass", Box((0.0,) * dim, tuple(copies * length for length in size)), x, cell, dx, along * np.eye(dim)
    )


def recognised(positions: np.ndarray, spot: np.ndarray, box: Box) -> str:
    """The lattice around a spot, by how many neighbours are nearly as near as the nearest; the usual one if unclear."""
    dim = positions.shape[1]
    if dim == 1:
        return "line"
    apart = positions - positions[int(np.argmin(((positions - spot) ** 2).sum(axis=1)))]
    apart -= np.array(box.size) * np.round(apart / np.array(box.size))
    r = np.sort(np.sqrt((apart**2).sum(axis=1)))[1:]
    close = int((r < 1.2 * r[: 2 * dim].mean()).sum())
    return {2: {4: "square"}, 3: {12: "close_packed"}}[dim].get(close, LATTICES[dim][0])
