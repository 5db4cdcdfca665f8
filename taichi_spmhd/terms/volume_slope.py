from dataclasses import dataclass

from ..godunov.slopes import FLAT
from ..runtime import ti
from ..types import real, vecd
from .base import Part


@dataclass(frozen=True)
class VolumeSlope(Part):
    """dV_i = sum_j ( V_j - V_i ) Gi e / ( - sum_j Gi r ):   the slope of the specific volume, in one dimension

    Exact where V is linear. For SumMass(slope="cubic"); a scene brings it along.
    """

    density: object
    gathers = {"dV": vecd, "dV_norm": real}
    makes = {"dV": vecd}

    @ti.func
    def gather(self, i, j, w):
        return ti.Struct(dV=(w.Gi * (self.density.room(j) - self.density.room(i))) * w.e, dV_norm=w.Gi * w.r)

    @ti.func
    def gathered(self, i, sums, now):
        norm = -i.rho * sums.dV_norm
        return ti.Struct(dV=i.rho / ti.select(norm > FLAT, norm, 1.0) * sums.dV)
