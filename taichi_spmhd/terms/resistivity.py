from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti
from ..types import real, vec3
from .base import Term


@dataclass(frozen=True)
class Resistivity(Term):
    """d(B/rho)_i/dt = alpha/2 sum_j v_B B_ij ( Gi + Gj ),   v_B = |v_ij x e|

    and the heat du_i/dt = - alpha/4 sum_j v_B B_ij^2 ( Gi + Gj ) >= 0.

    Artificial resistivity for magnetic shocks and current sheets (lecture p. 21; Price et al. 2018). Vanishes where
    there is no velocity jump across the pair's line, so smooth fields keep their strength. What the field loses heats
    the gas: total energy is conserved exactly. Advice: alpha = 1.
    """

    alpha: float = 1.0
    reads, evolves = {"B": vec3, "v": vec3, "vw": real}, {"b": vec3}

    def __post_init__(self):
        if not 0 <= self.alpha < 100:
            raise InputError(f"Resistivity: alpha = {self.alpha} must lie in 0..100")

    @ti.func
    def pair(self, i, j, w, now):
        v_B = (i.v - j.v).cross(w.e).norm()
        dB = i.B - j.B
        rate = 0.5 * self.alpha * v_B * (w.Gi + w.Gj) * dB
        return ti.Struct(b=rate, u=-0.5 * rate.dot(dB))

    @ti.func
    def speed(self, i, j, w, now):
        """The diffusion over a neighbour's distance is stable at the Courant step of vw + alpha v_B."""
        return ti.max(i.vw, j.vw) + self.alpha * (i.v - j.v).cross(w.e).norm()
