"""The area between a pair: (Gi + Gj) e, or one to which each side adds a share that is exact where P is linear.

What a Godunov term asks for is the `face`: the normal n of the Riemann problem and F, minus the area, so that a
pressure pushes by P F n.
"""

from ..runtime import ti
from ..types import slopes
from ..vector import Vector3, named, traced

AREAS = ("plain", "corrected")
TINY = 1e-30  # the normal of no area is zero, and finite


class PlainAreas:
    """n = e,   F = Gi + Gj"""

    @traced
    def remembered(self, inverse) -> dict:
        """The members that are kept of A^-1."""
        return {}

    @traced
    def face(self, i, j, w):
        return w.e, w.Gi + w.Gj


class CorrectedAreas(PlainAreas):
    """a = A_i^-1 e Gi + A_j^-1 e Gj,   n = -a/|a|,   F = -|a|     (A: slopes.py)

    To be added before SecondOrder. a changes its sign with i and j: what one of the pair gains, the other loses. A is a
    sum of r e e with weights >= 0, so n.e > 0 however the particles lie. Where A is not inverted, in a corner say, the
    share of that side is the plain one.
    """

    @property
    def rows(self) -> dict:
        """The rows of A^-1: a mirror turns them as it turns slopes."""
        return {f"I{letter}": kind for letter, kind in list(slopes.items())[: self.dim]}

    @property
    def makes(self) -> dict:
        return {**super().makes, **self.rows}

    @traced
    def remembered(self, inverse) -> dict:
        return {name: self.row(inverse, a) for a, name in enumerate(self.rows)}

    @ti.func
    def row(self, inverse, a: ti.template()):
        return ti.Vector([inverse[a, b] for b in ti.static(range(self.dim))])

    @traced
    def face(self, i, j, w):
        a = named(self.share(i, w.e) * w.Gi + self.share(j, w.e) * w.Gj)
        size = ti.lang.impl.expr_init(a.norm())
        return named(a * (-1.0 / (size + TINY))), -size

    @traced
    def share(self, s, e):
        """A^-1 e; below the diagonal the entries of above serve, so that half of them need not be loaded."""
        upper = [getattr(s, name).parts for name in self.rows]
        rows = [Vector3(upper[min(a, b)][max(a, b)] for b in range(3)) for a in range(self.dim)]
        return named(Vector3([*(row.dot(e) for row in rows), 0.0, 0.0][:3]))
