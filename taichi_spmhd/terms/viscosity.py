from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti
from ..types import real, vec3
from .base import Term
from .fast_speed import Directional


@dataclass(frozen=True)
class Viscosity(Directional, Term):
    """dv_i/dt = - sum_j ( q_i Di + q_j Dj ) e,   q = - rho/2 (alpha vw - beta mu) mu,   mu = min(v_ij.e, 0)

    Artificial viscosity for approaching pairs, so that shocks are spread over a few particles (lecture p. 21;
    Monaghan 1997; Price et al. 2018). Each particle takes its own heat, du_i/dt = sum_j q_i Di mu >= 0; momentum,
    angular momentum and energy are conserved exactly. Di, Dj are Gi, Gj, but for unequal masses by volume (SumVolume).
    Advice: alpha = 1 and beta = 2 for shocks; less, or a switch in its place (Balsara, MorrisMonaghan, CullenDehnen),
    where the flow is smooth. directional=True puts the fast speed along the pair, c_f(e), in place of vw: less
    viscosity along a strong field, for two more roots a pair.
    """

    alpha: float = 1.0
    beta: float = 2.0
    directional: bool = False
    reads, evolves = {"vw": real, "rho": real, "v": vec3}, {"v": vec3}
    weighs = ("Di", "Dj")
    live = {"alpha": (0.0, 3.0), "beta": (0.0, 6.0)}

    def __post_init__(self):
        name = type(self).__name__
        if not (0 <= self.alpha < 100 and 0 <= self.beta < 100):
            raise InputError(f"{name}: alpha = {self.alpha} and beta = {self.beta} must lie in 0..100")
        self.look_along()

    @ti.func
    def strength(self, s):
        """alpha of particle s."""
        return self.alpha

    @ti.func
    def share(self, i, j):
        """How much of it acts between i and j."""
        return 1.0

    @ti.func
    def q(self, s, e, mu):
        return -0.5 * s.rho * (self.strength(s) * self.wave(s, e) - self.beta * mu) * mu

    @ti.func
    def push(self, i, j, w, mu):
        """The rates of v and u between two that approach with mu."""
        share = self.share(i, j)
        own, other = share * w.Di * self.q(i, w.e, mu), share * w.Dj * self.q(j, w.e, mu)
        return ti.Struct(v=-(own + other) * w.e, u=own * mu)

    @ti.func
    def pair(self, i, j, w, now):
        return self.push(i, j, w, ti.min((i.v - j.v).dot(w.e), 0.0))

    @ti.func
    def speed(self, i, j, w, now):
        return ti.max(i.vw, j.vw) - self.beta * ti.min((i.v - j.v).dot(w.e), 0.0)
