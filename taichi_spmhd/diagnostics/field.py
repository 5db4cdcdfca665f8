"""Divergence and curl of the magnetic field by differences: zero for a uniform field on any set of particles.

And S, the symmetric div B / rho that the Maxwell stress and DivBSource contain: zero only where particles are in order.
"""

import numpy as np

from ..runtime import ti
from ..types import real, vec3

SUMS = {"div_B": real, "S": real, "curl_B": vec3}
FAINT = 1e-3  # of B_rms: where the field is weaker, div B is measured against this


@ti.kernel
def derivatives(rhs: ti.template(), pairs: ti.template(), near: ti.types.ndarray(dtype=ti.i32, ndim=2),
                rows: ti.types.ndarray(dtype=ti.i32, ndim=1), out: ti.types.ndarray(ndim=2)):  # fmt: skip
    """div B_i = - rho_i sum_j (B_i - B_j).e Gi, S_i = sum_j ( B_i.e Gi + B_j.e Gj ), curl B_i = rho_i sum_j
    (B_i - B_j) x e Gi   (Price 2012), by the caller's index."""
    for n in range(rhs.p.n):
        i, sums = pairs.mine(n), pairs.lanes.totals(SUMS)
        for k in range(rows[n]):
            j = pairs.theirs(near, n, k)
            w = rhs.weights(i, j)
            dB, S = (i.B - j.B) * w.Gi, i.B.dot(w.e) * w.Gi + j.B.dot(w.e) * w.Gj
            sums.add(ti.Struct(div_B=-dB.dot(w.e), S=S, curl_B=dB.cross(w.e)), rhs.choice)
        rho, id, total = rhs.p.state[n].rho, rhs.p.state[n].id, pairs.lanes.summed(sums)
        out[id, 0], out[id, 1] = rho * total.div_B, total.S
        for a in ti.static(range(3)):
            out[id, 2 + a] = rho * total.curl_B[a]


def differences(sim) -> dict[str, np.ndarray]:
    """div_B (N,), S (N,) and curl_B (N, 3) in the caller's order."""
    out = np.empty((len(sim), 5), sim.particles.word)
    derivatives(sim.rhs, sim.one_by_one, sim.neighbours.near, sim.neighbours.count, out)
    return {"div_B": out[:, 0], "S": out[:, 1], "curl_B": out[:, 2:]}


def div_B(sim, columns: dict | None = None) -> np.ndarray:
    """h |div B| / max(|B|, 1e-3 B_rms), (N,), in the caller's order. Raises KeyError in a scene without B."""
    columns = columns or sim.columns()
    B = np.linalg.norm(columns["B"].astype(float), axis=1)
    against = np.maximum(B, FAINT * np.sqrt((B**2).mean()))
    return columns["h"] * np.abs(differences(sim)["div_B"]) / np.maximum(against, 1e-300)  # no field: 0/tiny = 0


def div_B_figures(sim, columns: dict | None = None) -> dict[str, float]:
    """Mean, 99th percentile and maximum of div_B over the particles."""
    values = div_B(sim, columns)
    return {"mean": float(values.mean()), "p99": float(np.percentile(values, 99)), "max": float(values.max())}
