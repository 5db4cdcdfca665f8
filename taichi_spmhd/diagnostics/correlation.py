"""Pair correlation: g(s) = (pairs at distance s) / (pairs there would be if the particles were strewn at random).

s is the distance in units of the mean spacing (m_i/rho_i)^(1/d) of particle i, so that g of a gas of any density is one
curve. Its first peak is where the neighbours sit: at 1 in a square lattice, 1.075 in a hexagonal one, far below in a
clumped set.
"""

import numpy as np

from ..runtime import ti
from .rows import apart, rows, somebody, sorted_as

BIN = 0.002  # spacings
BLUR = 0.05  # spacings, s.d. of the Gaussian that smooths g before a peak is looked for
APART = 0.25  # spacings: a peak is not exceeded within this distance on either side
HEIGHT = 1.2  # of the smoothed g at a peak, at least: below it the particles lie as if strewn at random
BALL = (2.0, np.pi, 4 / 3 * np.pi)  # volume of the unit ball in 1, 2, 3 dimensions


@ti.kernel
def tally(x: ti.types.ndarray(ndim=2), period: ti.types.ndarray(ndim=2), near: ti.types.ndarray(ti.i32, ndim=2),
          count: ti.types.ndarray(ti.i32, ndim=1), scale: ti.types.ndarray(ndim=1),
          bins: ti.types.ndarray(ti.i32, ndim=1)):  # fmt: skip
    """bins[b] += 1 for every neighbour at a distance r with scale r in bin b. Integers: the same on any threads."""
    for n in range(x.shape[0]):
        for k in range(count[n]):
            if somebody(x, n, near[n, k]):
                b = ti.cast(apart(x, period, n, near[n, k]).norm() * scale[n], ti.i32)
                if b < bins.shape[0]:
                    ti.atomic_add(bins[b], 1)


def pair_correlation(sim, columns: dict | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Middles s of the bins and g(s) there, up to the kernel's support, within which the neighbour list is complete."""
    columns = columns or sim.columns()
    found, kernel, d = rows(sim, columns), sim.neighbours.kernel, sim.dim
    bins = np.zeros(int(kernel.support * kernel.h_fact / BIN), np.int32)
    spacings = sorted_as(found, (columns["rho"] / columns["m"]) ** (1 / d))
    tally(found.x, found.period, found.near, found.count, spacings / found.x.dtype.type(BIN), bins)
    edges = BIN * np.arange(len(bins) + 1)
    return 0.5 * (edges[1:] + edges[:-1]), bins / (len(sim) * BALL[d - 1] * np.diff(edges**d))


def first_peak(sim, columns: dict | None = None) -> float:
    """Distance, in mean spacings, of the first peak of g; 0 where g has no peak.

    g is smoothed over BLUR; a peak reaches HEIGHT and is the highest point within APART. There is none where particles
    lie as if strewn at random, as they do once clumps have torn a lattice apart.
    """
    s, g = pair_correlation(sim, columns)
    half, around = round(4 * BLUR / BIN), round(APART / BIN)
    blur = np.exp(-0.5 * (BIN * np.arange(-half, half + 1) / BLUR) ** 2)
    smooth = np.convolve(g, blur / blur.sum())[half : half + len(g)]
    highest = np.lib.stride_tricks.sliding_window_view(np.pad(smooth, around), 2 * around + 1).max(axis=1)
    peaks = np.flatnonzero((smooth >= highest) & (smooth >= HEIGHT))
    return round(float(s[peaks[0]]), 4) if len(peaks) else 0.0
