from dataclasses import dataclass

from ..runtime import ti
from ..types import real
from .flow import Flow
from .viscosity import Viscosity


@dataclass(frozen=True)
class Balsara(Flow, Viscosity):
    """Viscosity times (f_i + f_j)/2,   f = |div v| / ( |div v| + |curl v| + 1e-4 c_s/h )

    Balsara 1995: all of the viscosity in a compression, none in a shear or a rotation, so that discs and vortices live
    longer. It does not tell a shock from a smooth compression. Use it in place of Viscosity (lecture p. 21).
    """

    reads = {**Viscosity.reads, "cs": real, "h": real}
    makes = {"f": real}

    @ti.func
    def gathered(self, i, sums, now):
        div = ti.abs(sums.div_v)
        return ti.Struct(f=div / (div + sums.curl_v.norm() + 1e-4 * i.cs / i.h + 1e-30))

    @ti.func
    def share(self, i, j):
        return 0.5 * (i.f + j.f)
