from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti
from ..types import real, vec3
from .base import Term


@dataclass(frozen=True)
class Repulsion(Term):
    """dv_i/dt = - sum_j ( R_i Gi + R_j Gj ) near^n e,   R = eps max( B_par^2 - P - B^2/2, 0 )

    Pushes particles apart that come too close where the stress along their line attracts them (lecture p. 18; Monaghan
    2000, for weakly compressible fluids). B_par = B.e; near = W(r, h)/W(dx, h) is 1 at the mean spacing dx and grows
    inwards. Antisymmetric: momentum is conserved exactly. Its work has no energy to come from and is integrated in
    leak_E, so that the energy drift is predicted.
    Advice: no cure where beta is far below 1, but a lesson. At beta = 0.1 along the rows of a hexagonal lattice the
    instability grows by 1.24 v_A/dx without it, 0.91 with eps = 0.2, about 0.3 with eps = 1 (measured): later, not
    never. From eps = 2 on the stress it adds along B drives an instability of its own.
    """

    eps: float = 0.2
    n: int = 4
    reads = {"B": vec3, "Pt": real, "h": real, "v": vec3}
    evolves, sums, weighs = {"v": vec3, "leak_E": real}, {"push": vec3}, ("near",)
    live = {"eps": (0.0, 4.0)}

    def __post_init__(self):
        if not 0 <= self.eps <= 100:
            raise InputError(f"Repulsion: eps = {self.eps} must lie in 0..100; 0.2 is usual")
        if self.n not in range(1, 13):
            raise InputError(f"Repulsion: n = {self.n} must be a whole number from 1 to 12; 4 is usual")

    @ti.func
    def attraction(self, s, e):
        """- (P + B_perp^2/2 - B_par^2/2) where that is positive."""
        along = s.B.dot(e)
        return ti.max(along * along - s.Pt, 0.0)

    @ti.func
    def pair(self, i, j, w, now):
        near = w.near
        for _ in ti.static(range(self.n - 1)):
            near = near * w.near
        push = self.attraction(i, w.e) * w.Gi + self.attraction(j, w.e) * w.Gj
        return ti.Struct(push=-(self.eps * near * push) * w.e)

    @ti.func
    def after(self, i, total, now):
        return ti.Struct(v=total.push, leak_E=total.push.dot(i.v))
