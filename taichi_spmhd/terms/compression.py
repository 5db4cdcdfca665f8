from dataclasses import dataclass

from ..runtime import ti
from .base import Part


@dataclass(frozen=True)
class Compression(Part):
    """closing_i = sum_j Gi v_ij.e = (drho_i/dt) / rho_i^2

    The rate at which the summed density changes (Price 2012), for whatever needs it once the pairs are summed: a part
    asks by naming `closing` in its `sums`, a scene then sums it once for all of them.
    """

    @ti.func
    def pair(self, i, j, w, now):
        return ti.Struct(closing=w.Gi * (i.v - j.v).dot(w.e))
