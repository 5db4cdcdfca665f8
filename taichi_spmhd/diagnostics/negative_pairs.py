"""Negative pairs: the share of neighbours that attract each other, S_par = P + B_perp^2/2 + (xi - 1/2) B_par^2 < 0.

S_par is the stress along the line between two particles, the mean of both (lecture pp. 15-20). Where it is negative a
particle that comes closer is pulled closer still: the share foretells clumping before any is seen.
"""

import numpy as np

from ..runtime import ti
from ..terms import DivBSource, xi_of
from .rows import apart, rows, somebody, sorted_as


@ti.func
def stress(own: ti.template(), n, d):
    """push - pull (B.d)^2/d^2 of particle n, times d^2."""
    along = own[n, 3] * d[0] + own[n, 4] * d[1] + own[n, 5] * d[2]
    return own[n, 1] * d.norm_sqr() - own[n, 2] * along * along


@ti.kernel
def tally(x: ti.types.ndarray(ndim=2), period: ti.types.ndarray(ndim=2), near: ti.types.ndarray(ti.i32, ndim=2),
          count: ti.types.ndarray(ti.i32, ndim=1), own: ti.types.ndarray(ndim=2),
          out: ti.types.ndarray(ti.i32, ndim=2)):  # fmt: skip
    """out[n] = neighbours within either support, and those of negative stress. own: support, push, pull, B."""
    for n in range(x.shape[0]):
        pairs, negative = 0, 0
        for k in range(count[n]):
            j = near[n, k]
            if somebody(x, n, j):
                d = apart(x, period, n, j)
                if d.norm_sqr() < ti.max(own[n, 0], own[j, 0]) ** 2:
                    pairs += 1
                    negative += ti.select(stress(own, n, d) + stress(own, j, d) < 0.0, 1, 0)
        out[n, 0], out[n, 1] = pairs, negative


def xi_of_each(sim, columns: dict) -> np.ndarray:
    """xi (N,) of the scene's DivBSource, by number or by rule of beta = 2P/B^2; 0 in a scene without that term."""
    term = next((term for term in sim.scene.terms if isinstance(term, DivBSource)), None)
    B2 = (columns["B"].astype(float) ** 2).sum(axis=1)
    return xi_of(term, (2 * columns["P"] / np.maximum(B2, 1e-30)).astype(sim.particles.word))


def negative_pairs(sim, columns: dict | None = None) -> float:
    """The share of pairs within the kernel's support whose S_par is negative. Raises KeyError in a scene without B."""
    columns = columns or sim.columns()
    found, B = rows(sim, columns), columns["B"].astype(float)
    push = columns["P"] + 0.5 * (B**2).sum(axis=1)
    reach = sim.neighbours.kernel.support * columns["h"]
    own = sorted_as(found, np.column_stack([reach, push, 1 - xi_of_each(sim, columns), B]))
    out = np.empty((len(sim), 2), np.int32)
    tally(found.x, found.period, found.near, found.count, own, out)
    pairs, negative = out.sum(axis=0, dtype=np.int64)
    return float(negative / pairs) if pairs else 0.0
