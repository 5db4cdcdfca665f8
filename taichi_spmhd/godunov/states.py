"""The states on both sides of a pair's Riemann problem: to first order the particles, to second order limited.

A side is a record with rho, P, v (the component along e, then two across it) and, with a field, B across.
"""

from ..runtime import ti
from ..vector import Vector3, named, nothing, traced
from .limiter import LIMITERS, minmod, unlimited
from .slopes import Slopes


@traced
def components(vector, axes):
    """The components of a vector along up to three axes."""
    return named(Vector3([*(vector.dot(axis) for axis in axes), 0.0, 0.0][:3]))


class FirstOrder:
    """Sides are the particles themselves."""

    @ti.func
    def pressure(self, s):
        return s.P

    @ti.func
    def density(self, s):
        return s.rho

    @ti.func
    def velocity(self, s):
        return s.v

    @ti.func
    def field(self, s):
        return s.B

    @traced
    def pressures(self, i, j, w, keep):
        return i.P, j.P

    @traced
    def vectors(self, name, i, j, w, axes, keep):
        return components(getattr(i, name), axes), components(getattr(j, name), axes)

    @ti.func
    def kept(self, i, j, w):
        return 0.0


class SecondOrder(Slopes):
    """Sides are the states that limited slopes lead to, half way between, half a step on.

    With a density that knows better where the pair meets (its weight `shift`), there and not half way.
    """

    weighs = ("shift",)

    @ti.func
    def pressure(self, s):
        return s.P_mid

    @ti.func
    def density(self, s):
        return s.rho_mid

    @ti.func
    def velocity(self, s):
        return s.v_mid

    @ti.func
    def field(self, s):
        return s.B_mid

    @property
    def rule(self):
        return LIMITERS[self.limiter]

    @ti.func
    def limited(self, at_i, at_j, slope_i, slope_j, keep):
        """R and L of one quantity."""
        jump = at_i - at_j
        return at_i - keep * self.rule(slope_i, jump), at_j + keep * self.rule(slope_j, jump)

    @property
    def bound(self):
        """Keeps a state between both particles wherever the pair meets."""
        return unlimited if self.rule is unlimited else minmod

    @ti.func
    def shifted(self, at_i, at_j, slope_i, slope_j, keep_i, keep_j):
        """R and L of one quantity, f_i + df/ds (s* - r/2) and f_j + df/ds (s* + r/2)."""
        jump = at_i - at_j
        from_i, from_j = keep_i * self.rule(slope_i, jump), keep_j * self.rule(slope_j, jump)
        return at_i - self.bound(from_i, jump), at_j + self.bound(from_j, jump)

    @traced
    def met(self, at_i, at_j, slope_i, slope_j, keep):
        return (self.limited if len(keep) == 1 else self.shifted)(at_i, at_j, slope_i, slope_j, *keep)

    @traced
    def pressures(self, i, j, w, keep):
        return self.met(i.P_mid, j.P_mid, w.r * i.dP.dot(w.e), w.r * j.dP.dot(w.e), keep)

    @traced
    def vectors(self, name, i, j, w, axes, keep):
        """R and L of a vector, component by component."""
        at_i, at_j = (components(getattr(s, f"{name}_mid"), axes) for s in (i, j))
        slope_i, slope_j = (components(self.along(s, name, w), axes) for s in (i, j))
        parts = zip(at_i.parts, at_j.parts, slope_i.parts, slope_j.parts, strict=True)
        sides = [(0.0, 0.0) if nothing(four[0]) else self.met(*four, keep) for four in parts]
        return tuple(Vector3(side) for side in zip(*sides, strict=True))

    @traced
    def along(self, s, name, w):
        """How a vector of s changes over the distance of the pair."""
        return named(Vector3(getattr(s, f"d{name}{letter}").dot(w.e) for letter in "xyz") * w.r)

    @traced
    def kept(self, i, j, w) -> tuple:
        """How much of its slope each side uses: one number for both, or two where the pair has a shift."""
        keep = ti.lang.impl.expr_init(self.calm(i, j, w))
        return (keep * (1.0 - w.shift), keep * (1.0 + w.shift)) if "shift" in w.keys else (keep,)

    @ti.func
    def calm(self, i, j, w):
        """1/2; 0 where the pair approaches faster than c/C_shock: the shock switch."""
        closing = -(i.v_mid - j.v_mid).dot(w.e)
        return ti.select(self.C_shock * closing > ti.min(i.vw, j.vw), 0.0, 0.5)
