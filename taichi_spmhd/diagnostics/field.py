"""The magnetic field's divergence, by the difference operator: zero for a uniform field on any set of particles."""

import numpy as np

from ..runtime import ti
from ..types import real

SUMS = {"div_B": real}
FAINT = 1e-3  # of B_rms: where the field is weaker, div B is measured against this


@ti.kernel
def divergence(rhs: ti.template(), near: ti.types.ndarray(dtype=ti.i32, ndim=2),
               rows: ti.types.ndarray(dtype=ti.i32, ndim=1), out: ti.types.ndarray(ndim=1)):  # fmt: skip
    """div B_i = - rho_i sum_j (B_i - B_j).e Gi   (Price 2012), by the caller's index."""
    for n in range(rhs.p.n):
        i, sums = rhs.pairs.mine(n), rhs.lanes.totals(SUMS)
        for block in range(rows[n] // rhs.lanes.width):
            j = rhs.pairs.theirs(near, n, block)
            w = rhs.weights(i, j)
            sums.add(ti.Struct(div_B=(j.B - i.B).dot(w.e) * w.Gi), rhs.choice)
        out[rhs.p.state[n].id] = rhs.p.state[n].rho * rhs.lanes.summed(sums).div_B


def div_B(sim, columns: dict | None = None) -> np.ndarray:
    """h |div B| / max(|B|, 1e-3 B_rms), (N,), in the caller's order. Raises KeyError in a scene without B."""
    columns = columns or sim.columns()
    B = np.linalg.norm(columns["B"].astype(float), axis=1)
    out = np.empty(len(sim), sim.particles.word)
    divergence(sim.rhs, sim.neighbours.near, sim.neighbours.count, out)
    against = np.maximum(B, FAINT * np.sqrt((B**2).mean()))
    return columns["h"] * np.abs(out) / np.maximum(against, 1e-300)  # no field anywhere: 0/tiny = 0


def div_B_figures(sim, columns: dict | None = None) -> dict[str, float]:
    """Mean, 99th percentile and maximum of div_B over the particles."""
    values = div_B(sim, columns)
    return {"mean": float(values.mean()), "p99": float(np.percentile(values, 99)), "max": float(values.max())}
