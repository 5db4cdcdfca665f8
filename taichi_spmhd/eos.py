"""Equations of state: pressure and sound speed from density and thermal energy.  (a choice)"""

from dataclasses import dataclass

from .errors import InputError
from .runtime import ti
from .terms.base import Choice
from .types import real


@dataclass(frozen=True)
class Adiabatic(Choice):
    """P = (gamma - 1) rho u,   c_s^2 = gamma P / rho"""

    gamma: float = 5 / 3
    reads, makes = {"rho": real, "u": real}, {"P": real, "cs": real}

    def __post_init__(self):
        if not self.gamma > 1:
            raise InputError(f"Adiabatic: gamma = {self.gamma} must be above 1 (use Isothermal for gamma = 1)")

    @ti.func
    def close(self, i, now):
        P = (self.gamma - 1.0) * i.rho * i.u
        return ti.Struct(P=P, cs=ti.sqrt(self.gamma * ti.max(P, 0.0) / i.rho))

    @ti.func
    def open(self, i, now):
        """u from the pressure the scene gives and the summed density: the pressure at t = 0 is what the scene says."""
        return ti.Struct(u=i.P / ((self.gamma - 1.0) * i.rho))


@dataclass(frozen=True)
class Isothermal(Choice):
    """P = c^2 rho,   c_s = c;   there is no thermal energy, heat is radiated away"""

    c: float = 1.0
    reads, makes = {"rho": real}, {"P": real, "cs": real}

    def __post_init__(self):
        if not self.c > 0:
            raise InputError(f"Isothermal: the sound speed c = {self.c} must be positive")

    @ti.func
    def close(self, i, now):
        return ti.Struct(P=self.c * self.c * i.rho, cs=ti.cast(self.c, float))
