"""The calibration loop: a fixed piece of work beside every measurement, so that seconds of two machines compare.

    s_n = sum_k W'(|x_n - x_m(n,k)|),   m(n, k) = (n + 37 k) mod N

in the precision and with the threads of the measurement: the neighbours' positions come from memory, the kernel's slope
is arithmetic, as in SPH. It uses nothing of the package's own loops, so it stays the same when those become faster.
"""

import statistics
import time

import numpy as np

from ..runtime import ti

N, NEAR = 20_000, 40  # particles, neighbours each
STANDARD = 4e-3  # seconds: scaled seconds are those of a machine on which one pass takes this long
PASSES = 5


@ti.kernel
def sweep(x: ti.types.ndarray(ndim=1), out: ti.types.ndarray(ndim=1)):
    """One pass."""
    for n in range(x.shape[0]):
        total = x[n] * 0.0
        for k in range(NEAR):
            q = ti.abs(x[n] - x[(n + 37 * k) % x.shape[0]])
            a, b = ti.max(2.0 - q, 0.0), ti.max(1.0 - q, 0.0)
            total += 3.0 * b * b - 0.75 * a * a
        out[n] = total


class Calibration:
    """loop = Calibration(); loop.seconds(): the median of a few passes."""

    def __init__(self):
        word = np.float64 if ti.lang.impl.current_cfg().default_fp == ti.f64 else np.float32
        self.x, self.out = ti.ndarray(float, N), ti.ndarray(float, N)
        self.x.from_numpy(np.random.default_rng(0).uniform(0.0, 3.0, N).astype(word))
        self.once()  # compiles

    def once(self) -> float:
        """Seconds of one pass."""
        clock = time.perf_counter()
        sweep(self.x, self.out)
        ti.sync()
        return time.perf_counter() - clock

    def seconds(self) -> float:
        """Median seconds of a pass."""
        return statistics.median(self.once() for _ in range(PASSES))


def scaled(seconds: float, calibration: float) -> float:
    """Seconds as they would be on a machine that needs STANDARD for a pass."""
    return seconds * STANDARD / calibration
