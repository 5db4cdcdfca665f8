"""The rows of the neighbour list and what is needed to write them: cells, compact copies, the Finder of the box.

Copies of positions are in single precision; the list radius carries a margin for their round-off.
"""

from functools import cache

import numpy as np

from .cells import ROUNDOFF, Cells
from .cures import STRAYED
from .errors import RunError
from .finder import BLOCK, LANES, Finder
from .particles import Particles
from .runtime import ti

INNER = 1.02  # radius over support of the inner ring, which comes first in a row
MOST_BYTES = 8e9  # of a list
IMAGE = 26  # bits of an entry that hold the particle; above them, per axis, which wall it is mirrored at


def code_of(image: tuple[int, int, int]) -> int:
    """The walls of an image as the upper bits of a signed 32-bit entry."""
    code = sum(side << (IMAGE + 2 * a) for a, side in enumerate(image))
    return code - 2**32 if code >= 2**31 else code


@cache
def finder(box, periodic: tuple, images: tuple) -> Finder:
    """The one Finder of a box."""
    return Finder(box, periodic, images)


@ti.data_oriented
class Search:
    """Fills `near` (n, width) and `count` (n,) with the particles within a radius around the noted positions x0.

    Those within INNER supports come first, `inner` (n,) of them in whole lanes: all that is needed while they hold.
    """

    def __init__(self, particles: Particles, box, boundary, support: float, expected: float):
        self.p, self.dim, self.support = particles, particles.dim, support
        self.lo, self.hi, self.size, self.periodic = box.lo, box.hi, box.size, boundary.periodic
        self.finder = finder(box, boundary.periodic, tuple((image, code_of(image)) for image in boundary.images))
        self.cells = Cells(particles, box, boundary.periodic)
        n = particles.n
        self.width, self.fewest = LANES * int(np.ceil(1.6 * expected / LANES)), n  # fewest: in a row, itself included
        self.near, self.count = ti.ndarray(ti.i32, (n, self.width)), ti.ndarray(ti.i32, n)
        self.inner = ti.ndarray(ti.i32, n)
        self.at = ti.ndarray(ti.f32, (self.dim + 1, n + BLOCK))  # compact copies of x0 and of the squared radius
        self.bit = ti.ndarray(ti.i32, BLOCK)
        self.bit.from_numpy((np.uint32(1) << np.arange(BLOCK, dtype=np.uint32)).view(np.int32))

    @ti.kernel
    def compact(self, at: ti.types.ndarray(dtype=ti.f32, ndim=2), cell_of: ti.types.ndarray(dtype=ti.i32, ndim=1),
                reach: float, grid: ti.types.ndarray(ndim=2), shape: ti.types.ndarray(dtype=ti.i32, ndim=1),
                roundoff: float):  # fmt: skip
        """Positions from the grid's corner, squared radii and cells, in the order of memory."""
        for n in range(self.p.n):
            for a in ti.static(range(self.dim)):
                at[a, n] = ti.cast(self.p.state[n].x0[a] - grid[0, a], ti.f32)
            at[self.dim, n] = ti.cast((reach * self.p.state[n].h0 + roundoff) ** 2, ti.f32)
            cell_of[n] = self.cells.cell(n, grid, shape)

    def list(self, pad: float) -> None:
        """Rows for the noted positions in the present memory order; widened until no neighbour is dropped."""
        cells, roundoff = self.cells, ROUNDOFF * self.cells.longest
        self.compact(self.at, cells.cell_of, pad * self.support, cells.grid, cells.shape, roundoff)
        share = (INNER / pad) ** 2
        most = self.fill_rows(share)
        if most > self.width and 4.0 * self.p.n * most > MOST_BYTES:
            size = f"a list of {4e-9 * self.p.n * most:.0f} GB"
            what = f"neighbours: a particle has {most} of them, {size}: one has strayed far, or h differs too much"
            raise RunError(what, STRAYED)
        if most > self.width:
            self.width = LANES * int(np.ceil(1.25 * most / LANES))
            self.near = ti.ndarray(ti.i32, (self.p.n, self.width))
            self.fill_rows(share)

    def fill_rows(self, share: float) -> int:
        """All rows; returns the largest count, and notes the smallest."""
        cells = self.cells
        narrow = any(cells.shape[a] < 3 and self.periodic[a] for a in range(self.dim))
        rows, grid = (self.near, self.count, self.inner), (cells.cell_of, cells.grid, cells.shape)
        most, self.fewest = self.finder.fill(*rows, cells.first, self.at, self.bit, share, *grid, narrow)
        return most
