from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti
from ..types import real, vec3
from .base import Term


@dataclass(frozen=True)
class Resistivity(Term):
    """d(B/rho)_i/dt = 1/2 sum_j alpha v_B B_ij ( Gi + Gj ),   v_B = |v_ij x e|

    and the heat du_i/dt = - 1/4 sum_j alpha v_B B_ij^2 ( Gi + Gj ) >= 0.

    Artificial resistivity for magnetic shocks and current sheets (lecture p. 21; Price et al. 2018). Vanishes where
    there is no velocity jump across the pair's line, so smooth fields keep their strength. What the field loses heats
    the gas: total energy is conserved exactly. Advice: alpha = 1. TriccoPrice2013, in its place, looks at the field.
    """

    alpha: float = 1.0
    reads, sums = {"B": vec3, "v": vec3, "rho": real}, {"b": vec3, "exchange": real}
    live = {"alpha": (0.0, 3.0)}

    def __post_init__(self):
        if not 0 <= self.alpha < 100:
            raise InputError(f"{type(self).__name__}: alpha = {self.alpha} must lie in 0..100")

    @ti.func
    def alpha_v(self, i, j, w):
        """alpha v_B of the pair, the same from both sides."""
        return self.alpha * (i.v - j.v).cross(w.e).norm()

    @ti.func
    def pair(self, i, j, w, now):
        dB, exchange = i.B - j.B, self.alpha_v(i, j, w) * (w.Gi + w.Gj)
        rate = 0.5 * exchange * dB
        return ti.Struct(b=rate, u=-0.5 * rate.dot(dB), exchange=exchange)

    @ti.func
    def longest(self, i, total, now):
        """Explicit diffusion is stable while dt rho/2 sum |exchange| <= 1 (Gershgorin); half is allowed."""
        return 1.0 / (i.rho * ti.abs(total.exchange) + 1e-30)
