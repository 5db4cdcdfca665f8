"""Clumping: how close the nearest neighbours have come, in units of the mean spacing (m/rho)^(1/d).

A hexagonal lattice has 1.075, a square one 1, healthy disorder 0.6 to 0.9; a clumped set is below 0.5.
"""

import numpy as np

from ..runtime import ti
from .rows import Rows, apart, rows, somebody

CLOSE = 0.5  # spacings: particles nearer than this are a clump
NOBODY = 1e37  # squared distance of a neighbour that is not there; finite in f32 too


@ti.kernel
def nearest(x: ti.types.ndarray(ndim=2), period: ti.types.ndarray(ndim=2), near: ti.types.ndarray(ti.i32, ndim=2),
            count: ti.types.ndarray(ti.i32, ndim=1), out: ti.types.ndarray(ndim=1)):  # fmt: skip
    """Squared distance to the nearest particle, in memory order."""
    for n in range(x.shape[0]):
        least = ti.cast(NOBODY, float)
        for k in range(count[n]):
            if somebody(x, n, near[n, k]):
                least = ti.min(least, apart(x, period, n, near[n, k]).norm_sqr())
        out[n] = least


def squared_gaps(found: Rows) -> np.ndarray:
    """Squared distance (n,) to the nearest neighbour, in memory order; NOBODY where there is none."""
    out = np.empty(len(found.x), found.x.dtype)
    nearest(found.x, found.period, found.near, found.count, out)
    return out


def nearest_gaps(sim, columns: dict | None = None) -> np.ndarray:
    """Distance (N,) to the nearest neighbour in units of (m/rho)^(1/d), in the caller's order; inf for a lonely one."""
    columns = columns or sim.columns()
    found = rows(sim, columns)
    squared = np.empty(len(sim), found.x.dtype)
    squared[found.ids] = squared_gaps(found)
    gaps = np.sqrt(squared) * (columns["rho"] / columns["m"]) ** (1 / sim.dim)
    return np.where(squared >= 0.5 * NOBODY, np.inf, gaps)


def clumping(sim, columns: dict | None = None) -> dict[str, float]:
    """The smallest and the mean gap, and the fraction of particles whose nearest neighbour is within half a spacing.

    A lonely particle counts with the radius of the neighbour list, the least its gap can be: every number is finite.
    """
    kernel = sim.neighbours.kernel
    gaps = np.minimum(nearest_gaps(sim, columns).astype(float), sim.neighbours.pad * kernel.support * kernel.h_fact)
    return {
        "smallest_gap": float(gaps.min()),
        "mean_gap": float(gaps.mean()),
        "close_pairs": float((gaps < CLOSE).mean()),
    }
