from dataclasses import dataclass

from ..runtime import ti
from ..types import real
from .hyperbolic import OwnSpeed


@dataclass(frozen=True)
class TriccoPrice2012(OwnSpeed):
    """d(B/rho)_i/dt = - sum_j ( psi_i Gi + psi_j Gj ) e,   dpsi/dt = - c_h^2 div B - (sigma c_h/h + div v/2) psi

    The first cleaning with a speed per particle (lecture p. 30; Tricco & Price 2012): psi itself is evolved. Its energy
    psi^2/(2 rho c_h^2) is conserved against the field's only as long as c_h does not change: where a particle's signal
    speed falls, the same psi is worth more, and the field may get energy that was never there. Cleaning (2016) mends
    that by evolving y = psi/c_h; here y is made for the ledger, in which such a gain is an unexplained drift.
    Advice: as for Cleaning; prefer Cleaning.
    """

    reads = {**OwnSpeed.reads, "psi": real}
    makes = {"y": real, "ch": real}
    evolves = {"psi": real, "leak_E": real}

    @ti.func
    def close(self, i, now):
        ch = self.f_clean * i.vw
        return ti.Struct(ch=ch, y=i.psi / (ch + 1e-30))

    @ti.func
    def pair(self, i, j, w, now):
        div_B, div_v = (i.B - j.B).dot(w.e) * w.Gi, (i.v - j.v).dot(w.e) * w.Gi  # - div / rho
        return ti.Struct(
            b=-(i.psi * w.Gi + j.psi * w.Gj) * w.e,
            psi=i.rho * (i.ch * i.ch * div_B + 0.5 * i.psi * div_v),
        )

    @ti.func
    def local(self, i, now):
        rate = self.rate(i)
        return ti.Struct(psi=-rate * i.psi, leak_E=-rate * i.y * i.y / i.rho)
