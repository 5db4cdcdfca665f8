from dataclasses import dataclass

from ..runtime import ti
from ..types import real
from .viscosity import Viscosity


@dataclass(frozen=True)
class LectureViscosity(Viscosity):
    """dv_i/dt = sum_j alpha v_sig mu F/rho_ij e,   v_sig = (vw_i + vw_j - beta mu)/2,   F = m_j (W'(h_i) + W'(h_j))/2

    mu = min(v_ij.e, 0), rho_ij the mean density: the lecture's form (p. 21; Monaghan 1997, Price 2012). In the
    continuum grad(D div v), D = alpha v_sig r. Both of a pair take half of its heat: du_i/dt = - 1/2 sum_j alpha v_sig
    mu^2 F/rho_ij >= 0. Momentum, angular momentum and energy are conserved exactly. Viscosity, in its place, weighs
    each side with its own density and Omega and heats each with its own share. Advice: alpha = 1; beta counts half as
    much as in Viscosity, so 4 for strong shocks.
    """

    beta: float = 4.0
    reads, weighs = {**Viscosity.reads, "Omega": real}, ("F",)  # Omega: F is without it
    live = {"alpha": (0.0, 3.0), "beta": (0.0, 12.0)}

    @ti.func
    def push(self, i, j, w, mu):
        v_sig = 0.5 * (self.wave(i, w.e) + self.wave(j, w.e) - self.beta * mu)
        force = self.alpha * v_sig * mu * w.F * 2.0 / (i.rho + j.rho)
        return ti.Struct(v=force * w.e, u=-0.5 * force * mu)
