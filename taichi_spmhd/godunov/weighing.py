"""What a choice of density needs to weigh pairs with Inutsuka's V_ij^2: reach, weights, the shift of the interface."""

from dataclasses import replace
from math import sqrt

from ..runtime import ti
from .between import BETWEEN, spread


class Between:
    """To be added to a choice of density with a `slope`, and `room` and `even` of its particles."""

    @property
    def reach(self) -> float:
        """How far pairs reach, in supports of the kernel."""
        return sqrt(2.0) if self.slope in BETWEEN else 1.0

    @property
    def early(self) -> "Between":
        """What weighs the pairs of `gather`: there nobody knows yet what is between them."""
        return replace(self, slope="own") if self.slope in BETWEEN else self

    def offers(self, weight: str) -> bool:
        """Whether this choice has a weight that a part asks for."""
        return weight != "shift" or self.slope in BETWEEN

    @ti.func
    def between(self, i, j, e, r, kernel: ti.template()):
        """Gi and Gj of "linear" and "cubic"."""
        even, q_i, q_j = self.even(i, j), r * i.hinv, r * j.hinv
        V = BETWEEN[self.slope].curve(i, j, self.room(i), self.room(j), e, r)
        at_i, at_j = self.wide(i, q_i, kernel), self.wide(j, q_j, kernel)
        return (
            even * at_i * BETWEEN[self.slope].square(V, spread(q_i)),
            even * at_j * BETWEEN[self.slope].square(V, spread(q_j)),
        )

    @ti.func
    def wide(self, s, q, kernel: ti.template()):
        """W'(r, sqrt(2) h), q = r/h"""
        return s.g * s.rho * s.rho * ti.static(0.5 ** (0.5 * (kernel.dim + 1))) * kernel.df(q * ti.static(sqrt(0.5)))

    @ti.func
    def shift(self, i, j, w, kernel: ti.template()):
        """2 s*/r at the mean h: from -1, where the Riemann problem of the pair is at j, to 1, where it is at i."""
        V = BETWEEN[self.slope].curve(i, j, self.room(i), self.room(j), w.e, w.r)
        t = spread(2.0 * w.r / (i.h + j.h))
        return ti.max(ti.min(BETWEEN[self.slope].moment(V, t) / BETWEEN[self.slope].square(V, t), 1.0), -1.0)
