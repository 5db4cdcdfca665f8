from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti
from ..types import real, vec3
from .base import Term


@dataclass(frozen=True)
class Viscosity(Term):
    """dv_i/dt = - sum_j ( q_i Gi + q_j Gj ) e,   q = - rho/2 (alpha vw - beta mu) mu,   mu = min(v_ij.e, 0)

    Artificial viscosity for approaching pairs, so that shocks are spread over a few particles (lecture p. 21;
    Monaghan 1997; Price et al. 2018). Each particle takes its own heat, du_i/dt = sum_j q_i Gi mu >= 0; momentum,
    angular momentum and energy are conserved exactly. Advice: alpha = 1 and beta = 2 for shocks; less, or the
    CullenDehnen switch (which replaces the constant alpha), where the flow is smooth.
    """

    alpha: float = 1.0
    beta: float = 2.0
    reads, evolves = {"vw": real, "rho": real, "v": vec3}, {"v": vec3}

    def __post_init__(self):
        if not (0 <= self.alpha < 100 and 0 <= self.beta < 100):
            raise InputError(f"Viscosity: alpha = {self.alpha} and beta = {self.beta} must lie in 0..100")

    @ti.func
    def strength(self, s):
        """alpha of particle s."""
        return self.alpha

    @ti.func
    def q(self, s, mu):
        return -0.5 * s.rho * (self.strength(s) * s.vw - self.beta * mu) * mu

    @ti.func
    def pair(self, i, j, w, now):
        mu = ti.min((i.v - j.v).dot(w.e), 0.0)
        push = w.Gi * self.q(i, mu)
        return ti.Struct(v=-(push + w.Gj * self.q(j, mu)) * w.e, u=push * mu)

    @ti.func
    def speed(self, i, j, w, now):
        return ti.max(i.vw, j.vw) - self.beta * ti.min((i.v - j.v).dot(w.e), 0.0)
