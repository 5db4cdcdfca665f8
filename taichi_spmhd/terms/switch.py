from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti
from ..types import real
from .flow import Flow
from .viscosity import Viscosity


@dataclass(frozen=True)
class CullenDehnen(Flow, Viscosity):
    """Viscosity with alpha_i of its own: alpha_loc = 10 h^2 A / c_s^2,   A = D^2/(D^2 + |curl v|^2) max(-d div v/dt, 0)

    Cullen & Dehnen 2010 as simplified by Price et al. 2018: alpha jumps to alpha_loc (within 0..alpha) where a
    compression sets in, D = max(-div v, 0), and decays over h/(0.1 c_s) behind the shock. d(div v)/dt is the finite
    difference over the last step. Use it in place of Viscosity: nearly no viscosity in smooth flow, full `alpha` in
    shocks. fast=True puts vw = sqrt(c_s^2 + v_A^2) for c_s in both, alpha_loc and decay: where the field dominates
    (low beta) the compressions of fast waves are then not taken for shocks of the cold gas.
    """

    fast: bool = False
    reads = {**Viscosity.reads, "cs": real, "h": real}
    live = {"alpha": (0.05, 3.0), "beta": (0.0, 6.0)}
    keeps = {"alpha": real, "div_v": real, "div_v_before": real}

    def __post_init__(self):
        super().__post_init__()
        if not self.alpha > 0:
            raise InputError("CullenDehnen: alpha is the largest viscosity the switch may set; give it above 0")

    @ti.func
    def strength(self, s):
        return s.alpha

    @ti.func
    def pace(self, i):
        """The speed against which a compression is judged."""
        return i.vw if ti.static(self.fast) else i.cs

    @ti.func
    def gathered(self, i, sums, now):
        """Jump: no decay here, so that evaluating twice changes nothing."""
        closing = ti.max(-sums.div_v, 0.0) ** 2
        shear = closing / (closing + sums.curl_v.dot(sums.curl_v) + 1e-30)
        onset, before, pace = 0.0, i.div_v_before, self.pace(i)
        if now.dt > 0.0:
            onset = shear * ti.max((before - sums.div_v) / now.dt, 0.0)
        else:
            before = sums.div_v  # at the start there is no step to take the difference over
        wanted = ti.min(10.0 * i.h * i.h * onset / (pace * pace + 1e-30), self.alpha)
        return ti.Struct(alpha=ti.max(i.alpha, wanted), div_v=sums.div_v, div_v_before=before)

    @ti.func
    def settle(self, i, now):
        """Decay over h/(0.1 pace), and remember div v for the next difference."""
        return ti.Struct(alpha=i.alpha / (1.0 + 0.1 * now.dt * self.pace(i) / i.h), div_v_before=i.div_v)
