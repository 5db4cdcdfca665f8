"""Gradients for the second order: sums over neighbours that are exact where a quantity is linear.

    grad f = A^-1 rho_i sum_j ( f_j - f_i ) Gi e,   A = - rho_i sum_j Gi r e e   (the unit matrix in a perfect lattice)

They are tensors of each particle; components along a pair's axis follow for every pair.
"""

from ..runtime import ti
from ..types import real, slopes, vec3, vecd
from ..vector import named, traced

FLAT = 0.1  # the smallest determinant of A that is inverted: below, the neighbours are on one side only


class Slopes:
    """To be added to a Godunov term: gradients of P and of the vectors in `fields`, and the predicted state.

    Makes dP, dvx, dvy, ... (the gradient of each component) and P_mid, rho_mid, v_mid, ... (the state half a step on).
    """

    @property
    def gradients(self) -> dict:
        return {"dP": vecd, **{f"d{name}{a}": kind for name in self.fields for a, kind in slopes.items()}}

    @property
    def gathers(self) -> dict:
        return {**self.gradients, **dict.fromkeys(self.entries, real)}

    @property
    def entries(self) -> dict:
        """The entries of A, which is symmetric: {name: its row and column}."""
        return {f"A{'xyz'[a]}{'xyz'[b]}": (a, b) for a in range(self.dim) for b in range(a, self.dim)}

    @property
    def makes(self) -> dict:
        middle = {"P_mid": real, "rho_mid": real, **{f"{name}_mid": vec3 for name in self.fields}}
        return {"vw": real, **self.gradients, **middle}

    @property
    def together(self) -> tuple:
        return tuple(self.makes)

    @traced
    def gather(self, i, j, w):
        along = named(w.e * w.Gi)
        sums = {"dP": along * (j.P - i.P)}
        sums |= {name: along.parts[a] * (w.e.parts[b] * w.r) for name, (a, b) in self.entries.items()}
        for name in self.fields:
            apart = getattr(j, name) - getattr(i, name)
            sums |= {f"d{name}{letter}": along * part for letter, part in zip("xyz", apart.parts, strict=True)}
        return ti.Struct(sums)

    @traced
    def gathered(self, i, sums, now):
        inverse = self.inverse(self.matrix(i, sums))
        found = {name: self.turned(inverse, i.rho, getattr(sums, name)) for name in self.gradients}
        middle = self.middle(i, ti.Struct(found), 0.5 * now.dt)
        return ti.Struct({**found, **middle, **self.remembered(inverse)})

    @ti.func
    def turned(self, inverse, rho, raw):
        return rho * (inverse @ raw)

    @ti.func
    def matrix(self, i, sums):
        """A"""
        if ti.static(self.dim == 1):
            return -i.rho * ti.Matrix([[sums.Axx]])
        elif ti.static(self.dim == 2):
            return -i.rho * ti.Matrix([[sums.Axx, sums.Axy], [sums.Axy, sums.Ayy]])
        else:
            x, y, z = [sums.Axx, sums.Axy, sums.Axz], [sums.Axy, sums.Ayy, sums.Ayz], [sums.Axz, sums.Ayz, sums.Azz]
            return -i.rho * ti.Matrix([x, y, z])

    @ti.func
    def inverse(self, A):
        """A^-1; the unit matrix where A cannot be inverted."""
        unit = ti.Matrix.identity(float, self.dim)
        trusted = A.determinant() > FLAT
        return ti.select(trusted, A, unit).inverse()

    @traced
    def middle(self, i, slopes, half) -> dict:
        """The members of the middle of the step, unpredicted where half a step would change P or rho too much."""
        closing = ti.lang.impl.expr_init(half * self.divergence(slopes))
        gas, ahead = self.squeezed(i, closing), self.predicted(i, slopes, half, closing)
        made = {"P": gas.P, "rho": gas.rho, **{name: getattr(ahead, name) for name in self.fields}}
        return {f"{name}_mid": self.chosen(gas.trusted, value, getattr(i, name)) for name, value in made.items()}

    @ti.func
    def chosen(self, trusted, ahead, now):
        return ti.select(trusted, ahead, now)

    @ti.func
    def divergence(self, slopes):
        """div v"""
        div = slopes.dvx[0]
        if ti.static(self.dim > 1):
            div += slopes.dvy[1]
        if ti.static(self.dim > 2):
            div += slopes.dvz[2]
        return div

    @ti.func
    def squeezed(self, i, closing):
        """drho/dt = - rho div v,   dP/dt = - gamma P div v;   trusted while both keep more than 0.3 of themselves"""
        more = self.riemann.law.gamma * closing  # P changes gamma times as much as rho
        return ti.Struct(P=i.P * (1.0 - more), rho=i.rho * (1.0 - closing), trusted=ti.abs(more) < 0.7)
