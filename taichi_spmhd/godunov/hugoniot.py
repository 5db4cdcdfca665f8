"""Mass fluxes of shocks into a side of the Riemann problem, as functions of the pressure between the waves.

A side is a record with rho, P (the total pressure, P + b2/2), b2 = B_perp^2 and the normal velocity v. B_perp is frozen
into the gas that is squeezed, B_perp/rho stays: the shock is the fast one across the field, without B_parallel. The
same formula is taken for rarefactions (two-shock approximation).
"""

from dataclasses import dataclass

from ..runtime import ti

TINY = 1e-12  # of M^2: keeps roots and divisions away from zero


@dataclass(frozen=True)
class Hugoniot:
    """M^2 = rho/4 [ (gamma-3) P + (gamma+3) P* - (gamma-2) b2 + D ]   of an adiabatic gas

    D^2 = [ (gamma+1) P + (gamma-1) P* ]^2 - (gamma-2) b2 [ 2(gamma-3) P + 2(gamma+3) P* - (gamma-2) b2 ]
    (Iwasaki & Inutsuka 2011; b2 = 0 is the gas alone; P* -> P gives M = rho c_f).
    """

    gamma: float = 5 / 3

    @ti.func
    def density(self, rho, P, c2):
        """The density of a side whose pressure was reconstructed: as it was."""
        return rho

    @ti.func
    def acoustic(self, s):
        """(rho c_f)^2 = rho [ gamma P_gas + b2 ]"""
        return s.rho * (self.gamma * s.P + (1.0 - 0.5 * self.gamma) * s.b2)

    @ti.func
    def stiffness(self, s):
        """How much M^2 rises with P*: exactly so in a gas without a field."""
        return 0.5 * (self.gamma + 1.0) * s.rho

    @ti.func
    def flux(self, s, P):
        """M^2 at the pressure P between the waves, and its derivative as a fraction, numerator and denominator."""
        g = ti.static(self.gamma)
        base = (g + 1.0) * s.P + (g - 1.0) * P
        field = (g - 2.0) * s.b2
        D2 = base * base - field * ((2.0 * g - 6.0) * s.P + (2.0 * g + 6.0) * P - field)
        D = ti.sqrt(ti.max(D2, TINY * base * base))
        M2 = 0.25 * s.rho * ((g - 3.0) * s.P + (g + 3.0) * P - field + D)
        return M2, 0.25 * s.rho * ((g + 3.0) * D + (g - 1.0) * base - (g + 3.0) * field), D


@dataclass(frozen=True)
class Isothermal:
    """M^2 = rho x [ c^2 rho + b2 (x + 1)/2 ],   c^2 rho x + b2 x^2/2 = P*:   x = rho*/rho of an isothermal gas

    The jump of momentum with P = c^2 rho and B_perp/rho frozen; c belongs to the side.
    """

    gamma = 1.0

    @ti.func
    def density(self, rho, P, c2):
        """The density that the reconstructed pressure means."""
        return P / c2

    @ti.func
    def acoustic(self, s):
        """(rho c_f)^2 = rho [ P_gas + b2 ]"""
        return s.rho * (s.P + 0.5 * s.b2)

    @ti.func
    def stiffness(self, s):
        """How much M^2 rises with P*: exactly so in a gas without a field."""
        return s.rho

    @ti.func
    def flux(self, s, P):
        """M^2 at the pressure P between the waves, and its derivative as a fraction, numerator and denominator."""
        gas = s.P - 0.5 * s.b2
        root = ti.sqrt(gas * gas + 2.0 * s.b2 * P)  # = c^2 rho + b2 x
        x = 2.0 * P / (gas + root)
        M2 = s.rho * x * (gas + 0.5 * s.b2 * (x + 1.0))
        return M2, s.rho * (gas + 0.5 * s.b2 * (2.0 * x + 1.0)), root
