from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti
from ..types import real, vec3
from .base import Term
from .fast_speed import Directional


@dataclass(frozen=True)
class Viscosity(Directional, Term):
    """dv_i/dt = - sum_j ( s_i q_i Gi + s_j q_j Gj ) e,   q = - rho/2 (alpha vw - beta mu) mu,   mu = min(v_ij.e, 0)

    Artificial viscosity for approaching pairs, so that shocks are spread over a few particles (lecture p. 21;
    Monaghan 1997; Price et al. 2018). Each particle takes its own heat, du_i/dt = sum_j s_i q_i Gi mu >= 0; momentum,
    angular momentum and energy are conserved exactly. s_i = 2 m_j/(m_i + m_j), s_j = 2 m_i/(m_i + m_j): 1 for equal
    masses; between unequal ones the harmonic mean of both sides (Cleary & Monaghan 1999), without which a heavy
    neighbour brakes a light particle m_j/m_i times too fast for any time step. Advice: alpha = 1 and beta = 2 for
    shocks; less, or a switch in its place (Balsara, MorrisMonaghan, CullenDehnen), where the flow is smooth.
    directional=True puts the fast speed along the pair, c_f(e), in place of vw: less viscosity along a strong field,
    for two more roots a pair.
    """

    alpha: float = 1.0
    beta: float = 2.0
    directional: bool = False
    reads, evolves = {"vw": real, "rho": real, "v": vec3}, {"v": vec3}
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
        share = 2.0 * self.share(i, j) / (i.m + j.m)
        own, other = share * j.m * w.Gi * self.q(i, w.e, mu), share * i.m * w.Gj * self.q(j, w.e, mu)
        return ti.Struct(v=-(own + other) * w.e, u=own * mu)

    @ti.func
    def pair(self, i, j, w, now):
        return self.push(i, j, w, ti.min((i.v - j.v).dot(w.e), 0.0))

    @ti.func
    def speed(self, i, j, w, now):
        return ti.max(i.vw, j.vw) - self.beta * ti.min((i.v - j.v).dot(w.e), 0.0)
