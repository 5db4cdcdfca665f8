from dataclasses import dataclass, replace

from ..runtime import ti
from ..types import integer, real, vec3
from .base import Part


@dataclass(frozen=True)
class FrozenEnds(Part):
    """leak_v_i = - dv_i/dt,   leak_E_i = - dE_i/dt   of the particles that frozen ends hold

    Held particles push the others but do not yield: the momentum and the energy they do not take is what the ends do to
    the gas (a piston, where they move). A scene with frozen ends has this part by itself, so that the ledger knows
    their work. Of the energy only what the held keep counts: v, u and B/rho stay, while rho follows their neighbours.
    """

    heat: bool = False  # u is evolved
    field: bool = False  # there is a magnetic field
    total: bool = False  # E is evolved
    reads = {"v": vec3, "held": integer}
    evolves = {"leak_v": vec3, "leak_E": real}
    rank = 3  # when all rates are known

    def among(self, parts: tuple) -> "FrozenEnds":
        """With what the scene's particles have of energy."""
        evolved = {name for part in parts for name in part.evolves}
        field = "B" in {name for part in parts for name in part.makes} | evolved
        return replace(self, heat="u" in evolved, field=field, total="E" in evolved)

    @ti.func
    def energy(self, i, total):
        """The rate of the energy that the others lose to particle i, or gain from it."""
        rate = i.v.dot(total.v)
        if ti.static(self.heat):
            rate += total.u
        if ti.static(self.field):
            rate += i.B.dot(total.b)
        if ti.static(self.total):
            rate = total.E
        return rate

    @ti.func
    def after(self, i, total, now):
        held = ti.cast(i.held, float)
        return ti.Struct(leak_v=-held * total.v, leak_E=-held * self.energy(i, total))
