"""B-splines."""

from dataclasses import dataclass
from math import pi

from ..runtime import ti
from .base import Kernel, above


@dataclass(frozen=True)
class CubicSpline(Kernel):
    """M4: f = (2-q)^3/4 - (1-q)^3, each clamped at 0. 18 neighbours in 2-D, 58 in 3-D; cheap, noisy in shear."""

    h_fact: float = 1.2
    dim: int = 0
    norms = (2 / 3, 10 / (7 * pi), 1 / pi)

    @ti.func
    def f(self, q):
        a, b = above(2.0 - q), above(1.0 - q)
        return 0.25 * a * a * a - b * b * b

    @ti.func
    def df(self, q):
        a, b = above(2.0 - q), above(1.0 - q)
        return 3.0 * b * b - 0.75 * a * a

    @ti.func
    def ddf(self, q):
        return 1.5 * above(2.0 - q) - 6.0 * above(1.0 - q)


@dataclass(frozen=True)
class QuinticSpline(Kernel):
    """M6: f = (3-q)^5 - 6 (2-q)^5 + 15 (1-q)^5, each clamped at 0. 28 neighbours in 2-D, 113 in 3-D; for waves."""

    h_fact: float = 1.0
    dim: int = 0
    support = 3.0
    norms = (1 / 120, 7 / (478 * pi), 1 / (120 * pi))

    @ti.func
    def f(self, q):
        a, b, c = above(3.0 - q), above(2.0 - q), above(1.0 - q)
        a2, b2, c2 = a * a, b * b, c * c
        return a2 * a2 * a - 6.0 * b2 * b2 * b + 15.0 * c2 * c2 * c

    @ti.func
    def df(self, q):
        a, b, c = above(3.0 - q), above(2.0 - q), above(1.0 - q)
        a2, b2, c2 = a * a, b * b, c * c
        return -5.0 * a2 * a2 + 30.0 * b2 * b2 - 75.0 * c2 * c2

    @ti.func
    def ddf(self, q):
        a, b, c = above(3.0 - q), above(2.0 - q), above(1.0 - q)
        return 20.0 * a * a * a - 120.0 * b * b * b + 300.0 * c * c * c
