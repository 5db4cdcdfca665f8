from dataclasses import dataclass

from ..runtime import ti
from ..types import real, vec3
from .base import Term


@dataclass(frozen=True)
class Induction(Term):
    """d(B/rho)_i/dt = - sum_j v_ij (B_i.e) Gi

    Flux freezing, consistent with the summed density (lecture pp. 5, 12; Price 2012). b = B/rho is evolved and
    B = rho b follows at every evaluation with the new density. With B across the velocity gradient |B| stays
    proportional to rho exactly. Contains the advection of div B with the flow (Powell's source in the induction
    equation).
    """

    reads, makes, evolves = {"v": vec3, "rho": real, "b": vec3}, {"B": vec3}, {"b": vec3}

    @ti.func
    def open(self, i, now):
        return ti.Struct(b=i.B / i.rho)

    @ti.func
    def close(self, i, now):
        return ti.Struct(B=i.rho * i.b)

    @ti.func
    def pair(self, i, j, w, now):
        return ti.Struct(b=-(w.Gi * i.B.dot(w.e)) * (i.v - j.v))
