from dataclasses import dataclass

from ..runtime import ti
from ..types import real, vec3
from .base import Term


@dataclass(frozen=True)
class Pressure(Term):
    """dv_i/dt = - sum_j ( P_i Gi + P_j Gj ) e,   du_i/dt = P_i sum_j Gi v_ij.e

    Gas pressure alone, for scenes without a magnetic field (lecture p. 4; Price 2012). With B use Stress instead.
    Momentum and energy are conserved exactly. The signal speed of the gas is the sound speed, vw = c_s.
    """

    reads, makes, evolves = {"P": real, "cs": real, "v": vec3}, {"vw": real}, {"v": vec3}

    @ti.func
    def close(self, i, now):
        return ti.Struct(vw=i.cs)

    @ti.func
    def pair(self, i, j, w, now):
        push = i.P * w.Gi
        return ti.Struct(v=-(push + j.P * w.Gj) * w.e, u=push * (i.v - j.v).dot(w.e))
