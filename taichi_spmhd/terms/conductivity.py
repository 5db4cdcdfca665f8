from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti
from ..types import real
from .base import Term


@dataclass(frozen=True)
class Conductivity(Term):
    """du_i/dt = alpha/2 sum_j v_u (u_i - u_j) ( rho_i Gi + rho_j Gj ),   v_u = sqrt( |P_i - P_j| / rho_mean )

    Artificial heat conduction, so that the pressure has no blip at a contact (lecture p. 21; Price 2008; Price et al.
    2018). Conserves sum m u exactly. Advice: alpha = 1 for hydrodynamic shocks, 0.1 or none where gas pressure varies
    across a magnetically supported layer, which it would smear.
    """

    alpha: float = 1.0
    reads, evolves = {"P": real, "rho": real, "u": real}, {}

    def __post_init__(self):
        if not 0 <= self.alpha < 100:
            raise InputError(f"Conductivity: alpha = {self.alpha} must lie in 0..100")

    @ti.func
    def pair(self, i, j, w, now):
        v_u = ti.sqrt(2.0 * ti.abs(i.P - j.P) / (i.rho + j.rho))
        return ti.Struct(u=0.5 * self.alpha * v_u * (i.u - j.u) * (i.rho * w.Gi + j.rho * w.Gj))
