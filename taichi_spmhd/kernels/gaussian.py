"""The Gaussian, cut."""

from dataclasses import dataclass
from math import pi, sqrt

from ..runtime import ti
from .base import Kernel


@dataclass(frozen=True)
class Gaussian(Kernel):
    """f = exp(-q^2), cut at q = 3 as in Inutsuka 2002 (the cut leaves out 1e-4 of the mass in 2-D).

    The exponential is a Taylor series of exp(-q^2/64) raised to the 64th power: exact to 1e-14 and, unlike a call of
    exp, vectorised.
    """

    h_fact: float = 1.2
    dim: int = 0
    support = 3.0
    norms = (1 / sqrt(pi), 1 / pi, pi**-1.5)

    @ti.func
    def f(self, q):
        z = ti.min(q * q, 9.0) * (-1.0 / 64.0)
        e = 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0 * (1.0 + z / 5.0 * (1.0 + z / 6.0 * (
            1.0 + z / 7.0 * (1.0 + z / 8.0 * (1.0 + z / 9.0))))))))  # fmt: skip
        for _ in ti.static(range(6)):
            e = e * e
        return ti.select(q < 3.0, e, 0.0)

    @ti.func
    def df(self, q):
        return -2.0 * q * self.f(q)

    @ti.func
    def ddf(self, q):
        return (4.0 * q * q - 2.0) * self.f(q)
