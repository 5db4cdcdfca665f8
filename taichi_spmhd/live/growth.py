"""The noise of the particles, and how fast it grows: what the tensile instability does before clumps can be seen.

    noise = r.m.s. of n_i over the r.m.s. of vw,   n = w - <w>,   w = v - <v>,   <.>_i = the mean of the neighbours

A smooth flow of wave number k leaves a rest of order (k h)^4: taken once, the rest of a wave would hide most of the
growth. A lattice that tears itself up makes the noise grow by e again and again, at the rate that linear theory gives
for the shortest waves (physics of scenes/uniform_field.py), which the two means hardly touch.
"""

import numpy as np

from ..diagnostics.rows import Rows, somebody, sorted_as
from ..runtime import ti

LEAST_ROWS, LEAST_RISE, FIT = 4, 1.5, 4  # rows and powers of e that a rate needs; rows that it is taken over
SATURATED = 0.15  # noise above which growth is no longer linear: particles are then a tenth of a spacing off
SILENT = 1e-12  # noise below which there is only round-off


@ti.kernel
def deviations(x: ti.types.ndarray(ndim=2), v: ti.types.ndarray(ndim=2), near: ti.types.ndarray(ti.i32, ndim=2),
               count: ti.types.ndarray(ti.i32, ndim=1), out: ti.types.ndarray(ndim=2)):  # fmt: skip
    """v_i - <v>_i in memory order; 0 for a lonely particle."""
    for n in range(x.shape[0]):
        mean, found = ti.Vector([0.0, 0.0, 0.0]), 0
        for k in range(count[n]):
            j = near[n, k]
            if somebody(x, n, j):
                mean += ti.Vector([v[j, 0], v[j, 1], v[j, 2]])
                found += 1
        for a in ti.static(range(3)):
            out[n, a] = ti.select(found > 0, v[n, a] - mean[a] / ti.max(found, 1), 0.0)


def noise(found: Rows, columns: dict) -> float:
    """The noise of the present state."""
    v = sorted_as(found, columns["v"])
    once, twice = np.empty_like(v), np.empty_like(v)
    deviations(found.x, v, found.near, found.count, once)
    deviations(found.x, once, found.near, found.count, twice)
    return float(np.sqrt((twice.astype(float) ** 2).sum(axis=1).mean() / (columns["vw"].astype(float) ** 2).mean()))


class Growth:
    """Times and noise of the last rows, and the rate found in them.

    A rate stays known after its growth has ended in clumps, for as long as that growth lasted: to be read in time.
    """

    def __init__(self):
        self.times, self.logs = [], []
        self.now, self.found, self.until = -np.inf, None, -np.inf

    def add(self, time: float, noise: float, pace: float = 1.0) -> None:
        """A reading; rates are told in units of pace. What is too large to be growth in the linear sense ends it."""
        if time <= self.now:
            return
        self.now = time
        if noise >= SATURATED:
            self.times, self.logs = [], []
        elif noise > SILENT:
            self.times, self.logs = [*self.times[-60:], time], [*self.logs[-60:], float(np.log(noise))]
            self.found, self.until = self.fitted(pace)

    def fitted(self, pace: float) -> tuple[float | None, float]:
        """d ln(noise)/dt over the latest stretch where it rose from row to row, and until when to tell it."""
        rising = 1
        while rising < len(self.logs) and self.logs[-rising] > self.logs[-rising - 1]:
            rising += 1
        if rising < LEAST_ROWS or self.logs[-1] - self.logs[-rising] < LEAST_RISE:
            return None, self.now
        taken = slice(-min(rising, FIT), None)
        rate = float(np.polyfit(self.times[taken], self.logs[taken], 1)[0])
        return rate / pace, 2 * self.now - self.times[-rising]

    def rate(self) -> float | None:
        """The growth rate; None where the noise does not grow."""
        return self.found if self.now <= self.until else None
