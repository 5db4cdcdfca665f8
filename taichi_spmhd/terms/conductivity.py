from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti
from ..types import real, vec3
from .base import Term

SPEEDS = ("pressure", "velocity")


@dataclass(frozen=True)
class Conductivity(Term):
    """du_i/dt = alpha/2 sum_j v_u (u_i - u_j) ( rho_i Di + rho_j Dj ),   v_u = sqrt( |P_i - P_j| / rho_mean )

    Artificial heat conduction, so that the pressure has no blip at a contact (lecture p. 21; Price 2008; Price et al.
    2018). Conserves sum m u exactly. Di, Dj are Gi, Gj, but for unequal masses by volume (SumVolume).
    v_sig="velocity" takes v_u = |v_ij.e| instead (Wadsley, Veeravalli & Couchman 2008), which leaves layers at rest
    alone: with gravity, or a pressure that the field holds. Advice: alpha = 1 for hydrodynamic shocks, 0.1 or
    v_sig="velocity" where gas pressure varies across a magnetically supported layer, which it would smear.
    """

    alpha: float = 1.0
    v_sig: str = "pressure"
    reads, evolves = {"P": real, "rho": real, "u": real}, {}
    weighs = ("Di", "Dj")
    live = {"alpha": (0.0, 3.0)}

    def __post_init__(self):
        if not 0 <= self.alpha < 100:
            raise InputError(f"Conductivity: alpha = {self.alpha} must lie in 0..100")
        if self.v_sig not in SPEEDS:
            raise InputError(f'Conductivity: v_sig = {self.v_sig!r}; give "pressure" (the default) or "velocity"')

    def among(self, parts: tuple) -> "Conductivity":
        """The class with the signal speed that `v_sig` says."""
        return ConductivityOfMotion(self.alpha, self.v_sig) if self.v_sig == "velocity" else self

    @ti.func
    def v_u(self, i, j, w):
        return ti.sqrt(2.0 * ti.abs(i.P - j.P) / (i.rho + j.rho))

    @ti.func
    def pair(self, i, j, w, now):
        exchange = self.v_u(i, j, w) * (i.rho * w.Di + j.rho * w.Dj)
        return ti.Struct(u=0.5 * self.alpha * (i.u - j.u) * exchange)


@dataclass(frozen=True)
class ConductivityOfMotion(Conductivity):
    """The form of Conductivity with v_u = |v_ij.e|, which may exceed the speed of sound where gas flies apart."""

    reads = {"v": vec3, "rho": real, "u": real}

    @ti.func
    def v_u(self, i, j, w):
        return ti.abs((i.v - j.v).dot(w.e))

    @ti.func
    def speed(self, i, j, w, now):
        return self.alpha * ti.abs((i.v - j.v).dot(w.e))
