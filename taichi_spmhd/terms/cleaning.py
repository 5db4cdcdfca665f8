from dataclasses import dataclass

from ..runtime import ti
from ..types import real
from .hyperbolic import OwnSpeed


@dataclass(frozen=True)
class Cleaning(OwnSpeed):
    """d(B/rho)_i/dt = - sum_j ( psi_i Gi + psi_j Gj ) e,   dy/dt = - c_h div B - (sigma c_h/h + div v/2) y

    Hyperbolic divergence cleaning with a cleaning speed per particle (lecture pp. 27-30; Dedner et al. 2002; Tricco,
    Price & Bate 2016). y = psi/c_h is evolved, c_h = f_clean vw. The difference div B and the symmetric grad psi are
    conjugate, so magnetic + cleaning energy (y^2/2 rho per mass) never grows, whatever c_h does in space and time. What
    the damping takes is integrated in leak_E, so that the energy drift is predicted.
    Advice: sigma = 0.3 in 2-D, 1 in 3-D (the default chooses); f_clean > 1 cleans more and costs time step.
    """

    reads = {**OwnSpeed.reads, "y": real}
    makes = {"psi": real, "ch": real}
    evolves = {"y": real, "leak_E": real}

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
        damping = self.rate(i) * i.y
        return ti.Struct(y=-damping, leak_E=-damping * i.y / i.rho)
