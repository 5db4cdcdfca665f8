"""The noise of the particles, and how fast it grows: what the tensile instability does before clumps can be seen.

    noise = r.m.s. of v_i - <v>_i  over the r.m.s. of vw,   <v>_i = the mean of the particle's neighbours

A smooth flow leaves a rest of second order in the spacing; a lattice that tears itself up makes it grow by e again and
again, at the rate that linear theory gives for the shortest waves (physics of scenes/uniform_field.py).
"""

import numpy as np

from ..diagnostics.rows import Rows, somebody
from ..runtime import ti

LEAST_ROWS, LEAST_RISE, FIT = 4, 1.0, 12  # rows and powers of e that a rate needs; rows that it is taken over
SATURATED = 0.05  # noise above which growth is no longer linear


@ti.kernel
def deviations(x: ti.types.ndarray(ndim=2), v: ti.types.ndarray(ndim=2), near: ti.types.ndarray(ti.i32, ndim=2),
               count: ti.types.ndarray(ti.i32, ndim=1), out: ti.types.ndarray(ndim=1)):  # fmt: skip
    """|v_i - <v>_i|^2 in memory order."""
    for n in range(x.shape[0]):
        mean, found = ti.Vector([0.0, 0.0, 0.0]), 0
        for k in range(count[n]):
            j = near[n, k]
            if somebody(x, n, j):
                mean += ti.Vector([v[j, 0], v[j, 1], v[j, 2]])
                found += 1
        apart = ti.Vector([v[n, 0], v[n, 1], v[n, 2]]) - mean / ti.max(found, 1)
        out[n] = ti.select(found > 0, apart.norm_sqr(), 0.0)


def noise(found: Rows, columns: dict) -> float:
    """The noise of the present state."""
    v = np.ascontiguousarray(columns["v"][found.ids], found.x.dtype)
    out = np.empty(len(v), found.x.dtype)
    deviations(found.x, v, found.near, found.count, out)
    return float(np.sqrt(out.astype(float).mean() / (columns["vw"].astype(float) ** 2).mean()))


class Growth:
    """Times and noise of the last rows."""

    def __init__(self):
        self.times, self.logs = [], []

    def add(self, time: float, noise: float) -> None:
        """A reading; what is too small or too large to be growth in the linear sense counts as an end of it."""
        if not 1e-12 < noise < SATURATED or (self.times and time <= self.times[-1]):
            if noise >= SATURATED:
                self.times, self.logs = [], []
            return
        self.times, self.logs = [*self.times[-60:], time], [*self.logs[-60:], float(np.log(noise))]

    def rate(self) -> float | None:
        """d ln(noise)/dt over the latest stretch where it rose from row to row; None where it does not grow."""
        rising = 1
        while rising < len(self.logs) and self.logs[-rising] > self.logs[-rising - 1]:
            rising += 1
        if rising < LEAST_ROWS or self.logs[-1] - self.logs[-rising] < LEAST_RISE:
            return None
        taken = slice(-min(rising, FIT), None)
        return float(np.polyfit(self.times[taken], self.logs[taken], 1)[0])
