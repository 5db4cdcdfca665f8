from dataclasses import dataclass

from ..runtime import ti
from ..types import real, vec3
from .base import Part
from .held import free


@dataclass(frozen=True)
class Radiated(Part):
    """leak_E_i = P_i/rho_i^2 drho_i/dt - all heat:   what a gas without thermal energy radiates

    A scene with such a gas has this part by itself, so that the ledger knows what its shocks lose.
    """

    reads = {"P": real}
    evolves, sums = {"leak_E": real}, {"u": real, "closing": real}
    rank = 2  # when all heat is known

    def among(self, parts: tuple) -> "Radiated":
        """For the scene's steps: of several evaluations, or of one."""
        if not any(part.centred for part in parts):
            return self
        field = any("B" in {**part.makes, **part.evolves} for part in parts)
        return (MagneticRadiatedInSteps if field else RadiatedInSteps)()

    @ti.func
    def after(self, i, total, now):
        return ti.Struct(leak_E=i.P * total.closing - total.u)


@dataclass(frozen=True)
class RadiatedInSteps(Radiated):
    """leak_E_i += [ c_i^2 ln rho_i ] - dt times all heat,   [ ]: the change over a step

    For steps of one evaluation: its rates belong to the step, and what the gas stores is known at both ends of it.
    """

    reads, keeps = {"cs": real, "rho": real}, {"E_stored": real}
    sums = {"u": real}

    @ti.func
    def stores(self, i):
        """The free energy per mass, but for a constant."""
        return i.cs * i.cs * ti.log(i.rho)

    @ti.func
    def open(self, i, now):
        return ti.Struct(E_stored=self.stores(i))

    @ti.func
    def after(self, i, total, now):
        return ti.Struct(leak_E=-total.u)

    @ti.func
    def settle(self, i, now):
        new = self.stores(i)
        return ti.Struct(leak_E=i.leak_E + new - i.E_stored, E_stored=new)


@dataclass(frozen=True)
class MagneticRadiatedInSteps(RadiatedInSteps):
    """leak_E_i += [ c_i^2 ln rho_i + B_i^2/(2 rho_i) ] - dt times all heat and all work on the field"""

    reads = {"cs": real, "rho": real, "B": vec3}
    sums = {"u": real, "b": vec3, "closing": real}

    @ti.func
    def stores(self, i):
        return i.cs * i.cs * ti.log(i.rho) + 0.5 * i.B.dot(i.B) / i.rho

    @ti.func
    def after(self, i, total, now):
        """Where frozen ends hold the particle, they have booked B.db."""
        work = free(i) * i.B.dot(total.b) + 0.5 * i.B.dot(i.B) * total.closing
        return ti.Struct(leak_E=-total.u - work)
