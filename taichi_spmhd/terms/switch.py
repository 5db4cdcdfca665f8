from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti
from ..types import real, vec3
from .viscosity import Viscosity


@dataclass(frozen=True)
class CullenDehnen(Viscosity):
    """Viscosity with alpha_i of its own: alpha_loc = 10 h^2 A / c_s^2,   A = D^2/(D^2 + |curl v|^2) max(-d div v/dt, 0)

    Cullen & Dehnen 2010 as simplified by Price et al. 2018: alpha jumps to alpha_loc (within 0..alpha) where a
    compression sets in, D = max(-div v, 0), and decays over h/(0.1 c_s) behind the shock. d(div v)/dt is the finite
    difference over the last step. Use it in place of Viscosity: nearly no viscosity in smooth flow, full `alpha` in
    shocks.
    """

    reads = {**Viscosity.reads, "cs": real, "h": real}
    keeps = {"alpha": real, "div_v": real, "div_v_before": real}
    gathers = {"div_v": real, "curl_v": vec3}

    def __post_init__(self):
        super().__post_init__()
        if not self.alpha > 0:
            raise InputError("CullenDehnen: alpha is the largest viscosity the switch may set; give it above 0")

    @ti.func
    def strength(self, s):
        return s.alpha

    @ti.func
    def gather(self, i, j, w):
        dv = (i.v - j.v) * (w.Gi * i.rho)
        return ti.Struct(div_v=-dv.dot(w.e), curl_v=dv.cross(w.e))

    @ti.func
    def gathered(self, i, sums, now):
        """Jump: no decay here, so that evaluating twice changes nothing."""
        closing = ti.max(-sums.div_v, 0.0) ** 2
        shear = closing / (closing + sums.curl_v.dot(sums.curl_v) + 1e-30)
        onset, before = 0.0, i.div_v_before
        if now.dt > 0.0:
            onset = shear * ti.max((before - sums.div_v) / now.dt, 0.0)
        else:
            before = sums.div_v  # at the start there is no step to take the difference over
        wanted = ti.min(10.0 * i.h * i.h * onset / (i.cs * i.cs + 1e-30), self.alpha)
        return ti.Struct(alpha=ti.max(i.alpha, wanted), div_v=sums.div_v, div_v_before=before)

    @ti.func
    def settle(self, i, now):
        """Decay over h/(0.1 c_s), and remember div v for the next difference."""
        return ti.Struct(alpha=i.alpha / (1.0 + 0.1 * now.dt * i.cs / i.h), div_v_before=i.div_v)
