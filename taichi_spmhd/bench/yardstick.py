"""The yardstick: a bare hand-written loop over the same neighbour list, to measure the rates kernel against.

    s_i = sum_j m_j ( (P_i + P_j) (W'(h_i) + W'(h_j)) / r ) (x_i - x_j)

Written in as many lanes as the rates are (8 on the CPU, 1 elsewhere), so that rates/yardstick depends little on the
machine; it uses nothing of the package's pair loop, which is what it watches.
"""

import time
from functools import partial

import numpy as np

from ..lanes import best
from ..runtime import ti
from ..wide import wide

COLUMNS = 6  # x, y, z, 1/h, m, P
MARGIN = 1.6  # rates whose lanes are taken apart take 2.9 times as long in full MHD; noise moved the ratios by 3 %

# rates/yardstick by `spmhd bench --quick --threads 1`, 2026-11-26, Taichi 1.7.4, AMD EPYC (Zen 4, AVX-512): the middle
# of three rounds, minima of interleaved repeats each. godunov: one round, 2026-11-27.
EXPECTED = {
    "mhd3d_f64": 2.74,
    "mhd2d_f64": 2.65,
    "hydro3d_f64": 1.88,
    "hydro2d_f64": 1.71,
    "godunov3d_f64": 10.5,
    "godunov2d_f64": 8.6,
    "mhd3d_f32": 2.69,
    "mhd2d_f32": 2.28,
    "hydro3d_f32": 1.73,
    "hydro2d_f32": 1.52,
    "godunov3d_f32": 8.8,
    "godunov2d_f32": 6.8,
}


@ti.data_oriented
class Yardstick:
    """Own columns for the particles of a periodic simulation in its memory order; the list is the simulation's."""

    def __init__(self, sim):
        self.n, self.dim, self.lanes, self.near = len(sim), sim.dim, best(), sim.neighbours
        columns = np.zeros((COLUMNS, self.n + 1), sim.particles.word)
        self.fill(sim, columns)
        self.columns = ti.ndarray(float, columns.shape)
        self.columns.from_numpy(columns)
        self.out = ti.ndarray(float, (3, self.n))
        self.inside = ti.ndarray(ti.i32, self.n)

    def fill(self, sim, columns: np.ndarray) -> None:
        """The last column is nobody: no mass, far from h."""
        table, _ = sim.particles.table()
        first = sim.particles.first
        columns[: self.dim, :-1] = table[:, first["x"] : first["x"] + self.dim].T
        for row, name in enumerate(("hinv", "m", "P"), 3):
            columns[row, :-1] = table[:, first[name]]
        columns[3, -1] = 1.0

    @ti.func
    def lane(self, columns: ti.template(), row: ti.template(), near: ti.template(), n, first):
        """One quantity of the next neighbours of n, a lane each."""
        return ti.Vector([columns[row, near[n, first + k]] for k in ti.static(range(self.lanes))])

    @ti.func
    def zero(self):
        return ti.Vector([ti.cast(0.0, float) for _ in ti.static(range(self.lanes))])

    @ti.func
    def nearest(self, d):
        """The nearest image in a box of length 1."""
        return d - ti.floor(d + 0.5)

    @ti.func
    def along(self, columns: ti.template(), a: ti.template(), near: ti.template(), n, first):
        """x_i - x_j along axis a."""
        return self.nearest(columns[a, n] - self.lane(columns, a, near, n, first))

    @ti.func
    def slope(self, q):
        """The cubic spline's f'(q)."""
        a, b = ti.max(2.0 - q, 0.0), ti.max(1.0 - q, 0.0)
        return 3.0 * b * b - 0.75 * a * a

    @ti.kernel
    @wide
    def loop(self, near: ti.types.ndarray(dtype=ti.i32, ndim=2), rows: ti.types.ndarray(dtype=ti.i32, ndim=1),
             columns: ti.types.ndarray(ndim=2), out: ti.types.ndarray(ndim=2)):  # fmt: skip
        """s_i of all particles."""
        for n in range(self.n):
            sx, sy, sz = self.zero(), self.zero(), self.zero()
            for block in range(rows[n] // self.lanes):
                first = block * self.lanes
                r2 = self.along(columns, 0, near, n, first) ** 2
                for a in ti.static(range(1, self.dim)):
                    r2 += self.along(columns, a, near, n, first) ** 2
                rinv = 1.0 / ti.sqrt(r2 + 1e-30)
                r, hinv = r2 * rinv, self.lane(columns, 3, near, n, first)
                pull = (self.slope(r * columns[3, n]) + self.slope(r * hinv)) * rinv
                pull *= self.lane(columns, 4, near, n, first) * (columns[5, n] + self.lane(columns, 5, near, n, first))
                sx += pull * self.along(columns, 0, near, n, first)
                sy += pull * self.along(columns, 1, near, n, first)
                if ti.static(self.dim > 2):
                    sz += pull * self.along(columns, 2, near, n, first)
            out[0, n], out[1, n], out[2, n] = sx.sum(), sy.sum(), sz.sum()

    @ti.kernel
    def count(self, near: ti.types.ndarray(dtype=ti.i32, ndim=2), rows: ti.types.ndarray(dtype=ti.i32, ndim=1),
              columns: ti.types.ndarray(ndim=2), inside: ti.types.ndarray(dtype=ti.i32, ndim=1)):  # fmt: skip
        """Particles within 2 h_i of i, itself included."""
        for n in range(self.n):
            found = 0
            for k in range(rows[n]):
                r2, m = ti.cast(0.0, float), near[n, k]
                for a in ti.static(range(self.dim)):
                    r2 += self.nearest(columns[a, n] - columns[a, m]) ** 2
                found += ti.cast(m < self.n and r2 * columns[3, n] ** 2 < 4.0, ti.i32)
            inside[n] = found

    def run(self) -> None:
        """One pass of the loop."""
        self.loop(self.near.near, self.near.count, self.columns, self.out)

    def neighbours(self) -> float:
        """Mean number of particles within 2 h_i, i included."""
        self.count(self.near.near, self.near.count, self.columns, self.inside)
        return float(self.inside.to_numpy().mean())


def ratio(sim, stick: Yardstick, repeats: int) -> tuple[float, float]:
    """ns a particle of the rates kernel and of the yardstick: minima of interleaved repeats."""
    near, rhs, best_of = sim.neighbours, sim.rhs, [np.inf, np.inf]
    rates = partial(rhs.rates, near.near, near.count, sim.time, 0.0, rhs.moment.most, rhs.sums.rows)
    for _ in range(repeats + 1):  # the first compiles
        for k, call in enumerate((rates, stick.run)):
            clock = time.perf_counter()
            call()
            ti.sync()
            best_of[k] = min(best_of[k], time.perf_counter() - clock)
    return best_of[0] / len(sim) * 1e9, best_of[1] / len(sim) * 1e9
