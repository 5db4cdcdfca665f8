from dataclasses import dataclass, replace

from ..errors import InputError
from ..runtime import ti
from ..types import real, vec3
from .base import Term


@dataclass(frozen=True)
class Cleaning(Term):
    """d(B/rho)_i/dt = - sum_j ( psi_i Gi + psi_j Gj ) e,   dy/dt = - c_h div B - (sigma c_h/h + div v/2) y

    Hyperbolic divergence cleaning with a cleaning speed per particle (lecture pp. 27-30; Dedner et al. 2002; Tricco,
    Price & Bate 2016). y = psi/c_h is evolved, c_h = f_clean vw. The difference div B and the symmetric grad psi are
    conjugate, so magnetic + cleaning energy (y^2/2 rho per mass) never grows, whatever c_h does in space and time. What
    the damping takes is integrated in leak_E, so that the energy drift is predicted.
    Advice: sigma = 0.3 in 2-D, 1 in 3-D (the default chooses); f_clean > 1 cleans more and costs time step.
    """

    sigma: float = 0.0  # 0: by dimension
    f_clean: float = 1.0
    reads = {"B": vec3, "v": vec3, "rho": real, "h": real, "vw": real, "y": real}
    makes = {"psi": real, "ch": real}
    evolves, sums = {"y": real, "leak_E": real}, {"b": vec3}

    def __post_init__(self):
        if not (0 <= self.sigma < 100 and 0 < self.f_clean < 100):
            raise InputError(
                f"Cleaning: sigma = {self.sigma} must lie in 0..100 and f_clean = {self.f_clean} in (0, 100)"
            )

    def at(self, dim: int) -> "Cleaning":
        """With the damping that suits the number of dimensions where none was given."""
        return self if self.sigma else replace(self, sigma=1.0 if dim == 3 else 0.3)

    @ti.func
    def open(self, i, now):
        return ti.Struct(y=i.psi / (self.f_clean * i.vw))

    @ti.func
    def close(self, i, now):
        ch = self.f_clean * i.vw
        return ti.Struct(ch=ch, psi=ch * i.y)

    @ti.func
    def pair(self, i, j, w, now):
        div_B, div_v = (i.B - j.B).dot(w.e) * w.Gi, (i.v - j.v).dot(w.e) * w.Gi  # - div / rho
        return ti.Struct(
            b=-(i.psi * w.Gi + j.psi * w.Gj) * w.e,
            y=i.rho * (i.ch * div_B + 0.5 * i.y * div_v),
        )

    @ti.func
    def local(self, i, now):
        damping = self.sigma * i.ch / i.h * i.y
        return ti.Struct(y=-damping, leak_E=-damping * i.y / i.rho)

    @ti.func
    def max_dt(self, i, now):
        return 0.3 * i.h / (i.ch + 1e-30)
