"""Clumping: how close the nearest neighbours have come, in units of the mean spacing (m/rho)^(1/d).

A hexagonal lattice has 1.075, a square one 1, healthy disorder 0.6 to 0.9; a clumped set is below 0.5.
"""

import numpy as np

from ..runtime import ti

CLOSE = 0.5  # spacings: particles nearer than this are a clump
NOBODY = 1e37  # squared distance of a neighbour that is not there; finite in f32 too


@ti.kernel
def nearest(neighbours: ti.template(), near: ti.types.ndarray(dtype=ti.i32, ndim=2),
            rows: ti.types.ndarray(dtype=ti.i32, ndim=1), out: ti.types.ndarray(ndim=1)):  # fmt: skip
    """Squared distance to the nearest particle, by the caller's index. Mirror images are no particles and skipped."""
    for n in range(neighbours.p.n):
        least = ti.cast(NOBODY, float)
        for k in range(rows[n]):
            entry = near[n, k]
            if entry != n and entry >= 0 and entry < neighbours.p.n:
                r2 = ti.cast(0.0, float)
                for a in ti.static(range(neighbours.dim)):
                    here, there = neighbours.p.state[n].x[a], neighbours.p.state[entry].x[a]
                    r2 += neighbours.separation(here, there, a, True) ** 2
                least = ti.min(least, r2)
        out[neighbours.p.state[n].id] = least


def nearest_gaps(sim, columns: dict | None = None) -> np.ndarray:
    """Distance (N,) to the nearest neighbour in units of (m/rho)^(1/d), in the caller's order; inf for a lonely one."""
    columns = columns or sim.columns()
    squared = np.empty(len(sim), sim.particles.word)
    nearest(sim.neighbours, sim.neighbours.near, sim.neighbours.count, squared)
    alone = squared >= 0.5 * NOBODY
    gaps = np.sqrt(squared) * (columns["rho"] / columns["m"]) ** (1 / sim.dim)
    return np.where(alone, np.inf, gaps)


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
