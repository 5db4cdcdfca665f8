"""Grid binning: cells at least as wide as the largest list radius, particles sorted by (cell, caller's index).

The order in memory is a function of the positions alone, so a run gives the same bits whatever the number of threads.
Axes without a period follow the particles.
"""

import numpy as np

from .cures import NOT_FINITE
from .errors import RunError
from .particles import Particles
from .runtime import ti

FAR = 3e38  # beyond every position
ROUNDOFF = 6e-7  # of the longest axis: what positions in single precision may be off by, in all


@ti.data_oriented
class Counting:
    """Kernels that know arrays only: compiled once, whatever is simulated."""

    @ti.kernel
    def count(self, cell_of: ti.types.ndarray(dtype=ti.i32, ndim=1), first: ti.types.ndarray(dtype=ti.i32, ndim=1),
              slot: ti.types.ndarray(dtype=ti.i32, ndim=1), order: ti.types.ndarray(dtype=ti.i32, ndim=1),
              cells: ti.i32):  # fmt: skip
        """Counting sort: serial, 5 ns a particle, and the same order on every run."""
        for c in range(cells + 1):
            first[c] = 0
        ti.loop_config(serialize=True)
        for n in range(order.shape[0]):
            first[cell_of[n] + 1] += 1
        ti.loop_config(serialize=True)
        for c in range(cells):
            first[c + 1] += first[c]
        for c in range(cells):
            slot[c] = first[c]
        ti.loop_config(serialize=True)
        for n in range(order.shape[0]):
            k = slot[cell_of[n]]
            slot[cell_of[n]] = k + 1
            order[k] = n

    @ti.kernel
    def arrange(self, first: ti.types.ndarray(dtype=ti.i32, ndim=1), ids: ti.types.ndarray(dtype=ti.i32, ndim=1),
                order: ti.types.ndarray(dtype=ti.i32, ndim=1), cells: ti.i32) -> ti.i32:  # fmt: skip
        """Inside each cell, order by the caller's index; returns whether anything in memory has to move."""
        moves = 0
        for c in range(cells):
            for k in range(first[c], first[c + 1]):
                n = order[k]
                place = k
                while place > first[c] and ids[order[place - 1]] > ids[n]:
                    order[place] = order[place - 1]
                    place -= 1
                order[place] = n
            for k in range(first[c], first[c + 1]):
                ti.atomic_or(moves, ti.cast(order[k] != k, ti.i32))
        return moves


COUNTING = Counting()


@ti.data_oriented
class Cells:
    """first[c] .. first[c + 1] are the particles of cell c; cells are numbered with axis 0 running fastest."""

    def __init__(self, particles: Particles, box, periodic: tuple[bool, ...]):
        self.p, self.dim, self.periodic = particles, particles.dim, periodic
        self.lo, self.size = box.lo, box.size
        self.shape = np.ones(3, np.int32)
        self.grid = np.ones((2, 3), particles.word)  # lower corner and cells per length
        self.widest = 0.0  # the largest h0
        self.first, self.slot = ti.ndarray(ti.i32, 2), ti.ndarray(ti.i32, 2)
        self.cell_of, self.ids, self.order = (ti.ndarray(ti.i32, particles.n) for _ in range(3))

    @ti.kernel
    def note(self, fold: ti.i32) -> ti.types.vector(7, float):
        """Positions folded into the periodic box and noted, with h, as those of this build (fold = 0: they are noted).

        Returns the lowest and highest per axis and the largest h0: plain numbers, of which every thread has its own.
        """
        x, y, z = ti.cast(FAR, float), ti.cast(FAR, float), ti.cast(FAR, float)
        X, Y, Z, h = ti.cast(-FAR, float), ti.cast(-FAR, float), ti.cast(-FAR, float), ti.cast(0.0, float)
        for n in range(self.p.n):
            if fold == 1:
                self.wrap(n)
            x0 = self.p.state[n].x0
            ti.atomic_min(x, x0[0])
            ti.atomic_max(X, x0[0])
            if ti.static(self.dim > 1):
                ti.atomic_min(y, x0[1])
                ti.atomic_max(Y, x0[1])
            if ti.static(self.dim > 2):
                ti.atomic_min(z, x0[2])
                ti.atomic_max(Z, x0[2])
            ti.atomic_max(h, self.p.state[n].h0)
        return ti.Vector([x, y, z, X, Y, Z, h])

    @ti.func
    def wrap(self, n):
        """x0 and h0 of this build."""
        x = self.p.state[n].x
        for a in ti.static(range(self.dim)):
            if ti.static(self.periodic[a]):
                x[a] -= self.size[a] * ti.floor((x[a] - self.lo[a]) / self.size[a])
        self.p.state[n].x = x
        self.p.state[n].x0 = x
        self.p.state[n].h0 = self.p.state[n].h

    @ti.func
    def cell(self, n, grid: ti.template(), shape: ti.template()):
        """The number of the cell of particle n."""
        c, x = ti.Vector.zero(ti.i32, 3), self.p.state[n].x0
        for a in ti.static(range(self.dim)):
            c[a] = ti.min(ti.max(ti.cast(ti.floor((x[a] - grid[0, a]) * grid[1, a]), ti.i32), 0), shape[a] - 1)
        return (c[2] * shape[1] + c[1]) * shape[0] + c[0]

    @ti.kernel
    def locate(self, grid: ti.types.ndarray(ndim=2), shape: ti.types.ndarray(dtype=ti.i32, ndim=1),
               cell_of: ti.types.ndarray(dtype=ti.i32, ndim=1),
               ids: ti.types.ndarray(dtype=ti.i32, ndim=1)):  # fmt: skip
        """The cell and the caller's index of every particle, in the order of memory."""
        for n in range(self.p.n):
            cell_of[n] = self.cell(n, grid, shape)
            ids[n] = self.p.state[n].id

    def bin(self, reach_per_h: float, fold: bool = True) -> None:
        """Cells for the noted positions; `reach_per_h` times the largest h0 is the width a cell must have."""
        span = np.array(self.note(int(fold)), self.p.word)
        self.widest, self.longest, self.span = float(span[6]), 0.0, span
        if not np.isfinite(span[[*range(self.dim), *range(3, 3 + self.dim), 6]]).all():
            raise RunError("cells: a position or smoothing length is not finite", NOT_FINITE)
        self.divide(reach_per_h * self.widest)
        cells = int(self.shape.prod())
        if self.first.shape[0] < cells + 1:
            self.first, self.slot = (ti.ndarray(ti.i32, cells + 1 + cells // 4) for _ in range(2))
        self.locate(self.grid, self.shape, self.cell_of, self.ids)
        COUNTING.count(self.cell_of, self.first, self.slot, self.order, cells)
        self.cells = cells

    def divide(self, reach: float) -> None:
        """The grid: cells wider than reach, at most 4 per particle."""
        grid = np.ones((2, 3))
        for a in range(self.dim):
            lo, size = (
                (self.lo[a], self.size[a]) if self.periodic[a] else (self.span[a], self.span[3 + a] - self.span[a])
            )
            grid[:, a] = lo, size
            self.longest = max(self.longest, float(size))
        reach = reach * (1 + 1e-5) + ROUNDOFF * self.longest
        shape = np.minimum(np.maximum(grid[1] / reach, 1), 2**20).astype(int)
        shape[self.dim :] = 1
        crowd = max(1.0, float(shape.astype(float).prod()) / (4 * self.p.n + 64)) ** (1 / self.dim)
        self.shape = np.maximum(shape / crowd, 1).astype(np.int32)
        grid[1] = self.shape / np.maximum(grid[1], 1e-30)
        self.grid = grid.astype(self.p.word)

    def sort(self) -> None:
        """Bring the particles, and what must follow them, into the order of the cells."""
        if COUNTING.arrange(self.first, self.ids, self.order, self.cells):
            self.p.permute(self.order)
