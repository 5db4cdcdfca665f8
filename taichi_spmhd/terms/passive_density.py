from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti
from ..types import real, vec3
from .base import Term


@dataclass(frozen=True)
class PassiveDensity(Term):
    """drho'_i/dt = rho_i^2 sum_j v_ij.e Gi = (1/Omega_i) sum_j m_j v_ij.e W'(r, h_i)

    A second density rho' as a passenger: integrated in time beside the summed rho, from which it starts, and felt by
    nobody (lecture pp. 6, 9-11; Springel & Hernquist 2002). With Omega the right-hand side is the exact derivative
    of the sum, so rho' and rho part only by the error of the time step; Omega=False leaves the factor 1/Omega out,
    as early SPH did, and they part where h changes quickly. What flux freezing needs (Induction) is the same
    derivative. Advice: draw `rho_error` = rho'/rho - 1.
    """

    Omega: bool = True
    reads = {"v": vec3, "rho": real, "Omega": real}
    makes, evolves, sums = {"rho_error": real}, {"rho_evolved": real}, {"closing": real}

    def __post_init__(self):
        if not isinstance(self.Omega, bool):
            raise InputError(f"PassiveDensity: Omega = {self.Omega!r} must be True (with grad-h) or False (without)")

    @ti.func
    def open(self, i, now):
        return ti.Struct(rho_evolved=i.rho)

    @ti.func
    def close(self, i, now):
        return ti.Struct(rho_error=i.rho_evolved / i.rho - 1.0)

    @ti.func
    def after(self, i, total, now):
        rate = i.rho * i.rho * total.closing
        if ti.static(not self.Omega):
            rate *= i.Omega  # w.Gi holds 1/Omega
        return ti.Struct(rho_evolved=rate)
