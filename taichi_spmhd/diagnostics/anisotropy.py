"""Anisotropy: <|e_nn . B^|>, how well the direction to the nearest neighbour lines up with the field.

2/pi in disorder in two dimensions with B in the plane, 1/2 in three; towards 1 where particles attract each other along
B, as in the tensile instability (lecture pp. 15-17).
"""

import numpy as np

from ..runtime import ti
from .clumping import squared_gaps
from .field import FAINT
from .rows import apart, rows, somebody, sorted_as

TIE = 1.01  # neighbours as near as this times the nearest all count: on a lattice round-off chooses no direction


@ti.kernel
def align(x: ti.types.ndarray(ndim=2), period: ti.types.ndarray(ndim=2), near: ti.types.ndarray(ti.i32, ndim=2),
          count: ti.types.ndarray(ti.i32, ndim=1), most: ti.types.ndarray(ndim=1), unit: ti.types.ndarray(ndim=2),
          out: ti.types.ndarray(ndim=1)):  # fmt: skip
    """out[n] = mean |e . unit[n]| over the neighbours within the squared distance most[n]; -1 where there is none."""
    for n in range(x.shape[0]):
        total, found = ti.cast(0.0, float), 0
        for k in range(count[n]):
            if somebody(x, n, near[n, k]):
                d = apart(x, period, n, near[n, k])
                if d.norm_sqr() <= most[n]:
                    along = d[0] * unit[n, 0] + d[1] * unit[n, 1] + d[2] * unit[n, 2]
                    total += ti.abs(along) / d.norm()
                    found += 1
        out[n] = total / found if found > 0 else -1.0


def anisotropy(sim, columns: dict | None = None) -> float:
    """Mean of |e_nn . B^| over the particles, e_nn to the nearest neighbour, the mean over several at one distance.

    Particles without a neighbour and those in a field below 1e-3 B_rms have no such direction and are left out; 0 if
    none is left. Raises KeyError in a scene without B.
    """
    columns = columns or sim.columns()
    strength = np.linalg.norm(columns["B"].astype(float), axis=1)
    clear = strength > FAINT * np.sqrt((strength**2).mean())
    unit = columns["B"] / np.where(clear, strength, 1)[:, None]
    found = rows(sim, columns)
    most, out = found.x.dtype.type(TIE**2) * squared_gaps(found), np.empty(len(sim), found.x.dtype)
    align(found.x, found.period, found.near, found.count, most, sorted_as(found, unit), out)
    values = out[clear[found.ids] & (out >= 0)]
    return float(values.astype(float).mean()) if len(values) else 0.0
