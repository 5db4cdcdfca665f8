from dataclasses import dataclass

from ..runtime import ti
from ..types import real, vec3
from .base import Term


@dataclass(frozen=True)
class Stress(Term):
    """dv_i/dt = - sum_j ( T_i.e Gi + T_j.e Gj ),   T = (P + B^2/2) 1 - B B,   du_i/dt = P_i sum_j Gi v_ij.e

    The Maxwell stress in conservative form (lecture pp. 13-14; Price 2012). Momentum and total energy are conserved
    exactly. Where B^2/2 > P the stress along B is negative and particles attract each other: the tensile instability
    (lecture pp. 15-17). Add DivBSource(xi) to cure it.
    `Pt` = P + B^2/2 is computed once per particle. The signal speed is vw = sqrt(c_s^2 + v_A^2), the fast speed's
    upper bound in all directions.
    """

    reads = {"P": real, "cs": real, "rho": real, "B": vec3, "v": vec3}
    makes = {"Pt": real, "vw": real}
    evolves = {"v": vec3}

    @ti.func
    def close(self, i, now):
        B2 = i.B.dot(i.B)
        return ti.Struct(Pt=i.P + 0.5 * B2, vw=ti.sqrt(i.cs * i.cs + B2 / i.rho))

    @ti.func
    def pair(self, i, j, w, now):
        along_i, along_j = w.Gi * i.B.dot(w.e), w.Gj * j.B.dot(w.e)
        pull = along_i * i.B + along_j * j.B
        return ti.Struct(v=pull - (i.Pt * w.Gi + j.Pt * w.Gj) * w.e, u=i.P * w.Gi * (i.v - j.v).dot(w.e))
