"""Rarefactions without a power or a logarithm, which would cost more than all the rest of a pair.

The eighth root of the pressure ratio is three square roots, and what is wanted is smooth in it: a polynomial.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ..runtime import ti
from .hugoniot import Hugoniot, Isothermal
from .riemann import Riemann

LEAST = 0.1  # the eighth root of the smallest ratio, 1e-8, that is told from smaller ones
DEGREE = 10


def fitted(function: Callable) -> tuple:
    """Coefficients, highest power first, of q in function(y) = (y - 1) q(y) for LEAST < y < 1; function(1) = 0.

    As a factor of y - 1 the fit has a small relative error also where the wave is weak: 1e-6 from gamma = 1.4 on, more
    towards the logarithm, 1e-4.
    """
    nodes = np.polynomial.chebyshev.chebpts1(200)
    y = 0.5 * (1 + LEAST) + 0.5 * (1 - LEAST) * nodes
    fit = np.polynomial.Chebyshev.fit(y, function(y) / (y - 1), DEGREE, domain=[LEAST, 1])
    return tuple(map(float, fit.convert(kind=np.polynomial.Polynomial).coef[::-1]))


@lru_cache
def power(gamma: float) -> tuple:
    """x^( (gamma-1)/(2 gamma) ) - 1, x = y^8"""
    return fitted(lambda y: y ** (4 * (gamma - 1) / gamma) - 1)


@lru_cache
def logarithm() -> tuple:
    """ln x, x = y^8"""
    return fitted(lambda y: 8 * np.log(y))


@ti.func
def eighth(x):
    """x^(1/8) of a ratio, between LEAST and 1."""
    return ti.max(ti.min(ti.sqrt(ti.sqrt(ti.sqrt(x))), 1.0), LEAST)


@ti.func
def polynomial(coefficients: ti.template(), y):
    """Horner's rule."""
    total = 0.0 * y
    for c in ti.static(coefficients):
        total = total * y + c
    return total


class Fan(Hugoniot):
    """An adiabatic gas without a field, phi = 2 c/(gamma-1) [ (P*/P)^((gamma-1)/(2 gamma)) - 1 ] in rarefactions"""

    @ti.func
    def flux(self, s, P):
        """M^2 = rho/2 [ (gamma+1) P* + (gamma-1) P ]"""
        M2 = 0.5 * s.rho * ((self.gamma + 1.0) * P + (self.gamma - 1.0) * s.P)
        return M2, self.stiffness(s), 1.0

    @ti.func
    def fan(self, s, P):
        """phi and its derivative, which falls as P*^-k, and k."""
        y, g = eighth(P / s.P), ti.static(self.gamma)
        z = (y - 1.0) * polynomial(ti.static(power(self.gamma)), y)
        flux = ti.sqrt(g * s.P * s.rho)
        return 2.0 * g / (g - 1.0) * s.P / flux * z, (1.0 + z) * s.P / (P * flux), (g + 1.0) / (2.0 * g)


class IsothermalFan(Isothermal):
    """An isothermal gas without a field, phi = c ln(P*/P) in rarefactions"""

    @ti.func
    def flux(self, s, P):
        """M^2 = rho P*"""
        return s.rho * P, s.rho, 1.0

    @ti.func
    def fan(self, s, P):
        """phi and its derivative, which falls as P*^-k, and k."""
        y, c = eighth(P / s.P), ti.sqrt(s.P / s.rho)
        return c * (y - 1.0) * polynomial(ti.static(logarithm()), y), c / P, 1.0


@dataclass(frozen=True)
class ExactRiemann(Riemann):
    """The steps know rarefactions: star values are those of the exact problem of a gas without a field."""

    @ti.func
    def waves(self, L, R, P):
        left, right = Riemann.waves(self, L, R, P)
        return self.either(L, P, left), self.either(R, P, right)

    @ti.func
    def either(self, s, P, shock):
        """phi and its derivatives: of a shock, or of a rarefaction where the pressure falls."""
        phi, first, k = self.law.fan(s, P)
        second = -k * first / P
        fan, falls = (phi, first, second, -(k + 1.0) * second / P), P < s.P
        return [ti.select(falls, fan[n], shock[n]) for n in ti.static(range(4))]
