"""Equations of state: pressure and sound speed from density and thermal energy.  (a choice)"""

from dataclasses import dataclass

import numpy as np

from .errors import InputError
from .runtime import ti
from .terms.base import Choice
from .types import real, vec3


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


class Radiating(Choice):
    """A gas without thermal energy: P follows from rho alone, the heat of friction is radiated away at once.

    What it radiates is integrated in leak_E (terms/radiated.py): shocks lose energy as predicted.
    """

    def sound_speed(self, columns: dict) -> np.ndarray | float:
        """c of every particle, (N,) or one number."""
        raise NotImplementedError

    def free_energy(self, columns: dict, mean: float) -> np.ndarray:
        """c^2 (1 + ln(rho/mean)) per mass, (N,): what such a gas stores in place of u, since d/drho of it is P/rho^2.

        mean: any constant density; it only shifts the zero.
        """
        return self.sound_speed(columns) ** 2 * (1 + np.log(columns["rho"] / mean))


@dataclass(frozen=True)
class Isothermal(Radiating):
    """P = c^2 rho,   c_s = c;   there is no thermal energy, heat is radiated away"""

    c: float = 1.0
    reads, makes = {"rho": real, "v": vec3}, {"P": real, "cs": real}

    def __post_init__(self):
        if not self.c > 0:
            raise InputError(f"Isothermal: the sound speed c = {self.c} must be positive")

    def sound_speed(self, columns: dict) -> float:
        return self.c

    @ti.func
    def close(self, i, now):
        return ti.Struct(P=self.c * self.c * i.rho, cs=ti.cast(self.c, float))


@dataclass(frozen=True)
class LocallyIsothermal(Radiating):
    """P_i = c_i^2 rho_i;   every particle keeps the sound speed cs that the start gives it, whatever happens

    For gases of different temperature that do not mix, each kept warm or cold by its own radiation: the hot gas of an
    HII region and the cloud around it (lecture p. 40). Give "cs" in start, a number or an array (N,).
    """

    reads, makes, keeps = {"rho": real, "v": vec3}, {"P": real}, {"cs": real}

    def sound_speed(self, columns: dict) -> np.ndarray:
        return columns["cs"].astype(float)

    @ti.func
    def close(self, i, now):
        return ti.Struct(P=i.cs * i.cs * i.rho)
