"""Which energy is integrated in time.  (a choice)   A term always states its heat, u; only this file knows of E."""

from dataclasses import dataclass

from .errors import InputError
from .runtime import ti
from .terms.base import Choice, known_as
from .terms.held import free
from .types import real, vec3


class Energy(Choice):
    """What both share: nothing but the name of the choice."""


@dataclass(frozen=True)
class Thermal(Energy):
    """u is evolved: every term states the heat it gives, du_i/dt   (lecture p. 4)

    The default: robust where u is small beside the energies of motion and field.
    """

    evolves = {"u": real}


@dataclass(frozen=True)
class Total(Energy):
    """E = v^2/2 + u + B^2/(2 rho) is evolved: dE_i/dt = v.dv + du + B.d(B/rho) + B^2/(2 rho^2) drho   (lecture p. 14)

    Formed once a particle from the rates of all terms, so each term's part (that of DivBSource too, -xi v.B S) follows
    from what the term states: the same equations as with Thermal. u is what remains of E: where the gas is cold beside
    its motion or its field, that is a difference of large numbers. Then use Thermal.
    """

    centred: bool = False  # rates are those of a step, which works with the velocity in its middle; left to the scene
    reads, makes, evolves = {"v": vec3}, {"u": real}, {"E": real}
    sums = {"u": real}
    rank = 2  # E is opened and finished when u, v and B are

    def among(self, parts: tuple) -> "Total":
        """With the energy of the field where the scene has one, and the velocity that its terms work with."""
        field = any("B" in {**part.makes, **part.evolves} for part in parts)
        return (MagneticTotal if field else Total)(any(part.centred for part in parts))

    @ti.func
    def work(self, i, total, now):
        """v.dv/dt, for a step as a whole: the change of v^2/2 is that of the velocity in its middle."""
        v = i.v
        if ti.static(self.centred):
            v += 0.5 * now.dt * free(i) * total.v
        return v.dot(total.v)

    @ti.func
    def open(self, i, now):
        return ti.Struct(E=0.5 * i.v.dot(i.v) + i.u)

    @ti.func
    def close(self, i, now):
        return ti.Struct(u=i.E - 0.5 * i.v.dot(i.v))

    @ti.func
    def after(self, i, total, now):
        return ti.Struct(E=self.work(i, total, now) + total.u)

    @ti.func
    def max_dt(self, i, now):
        """None where u has run out: the run stops there."""
        return ti.select(i.u > 0.0, 1e30, 0.0)


@dataclass(frozen=True)
class MagneticTotal(Total):
    """E = v^2/2 + u + B^2/(2 rho), in a scene with a field."""

    reads = {"v": vec3, "B": vec3, "rho": real}
    sums = {"u": real, "b": vec3, "closing": real}

    @ti.func
    def field(self, i):
        """The energy of the field per mass."""
        return 0.5 * i.B.dot(i.B) / i.rho

    @ti.func
    def left(self, i):
        """What remains of E."""
        return i.E - 0.5 * i.v.dot(i.v) - self.field(i)

    @ti.func
    def gain(self, i, total, now):
        """dE/dt"""
        return self.work(i, total, now) + total.u + i.B.dot(total.b) + 0.5 * i.B.dot(i.B) * total.closing

    @ti.func
    def open(self, i, now):
        return ti.Struct(E=0.5 * i.v.dot(i.v) + i.u + self.field(i))

    @ti.func
    def close(self, i, now):
        return ti.Struct(u=self.left(i))

    @ti.func
    def after(self, i, total, now):
        return ti.Struct(E=self.gain(i, total, now))


@dataclass(frozen=True)
class Dual(Total):
    """E is evolved, and beside it u of gas that is only squeezed, du_i/dt = P/rho^2 drho/dt

    What remains of E is taken where it is above `least` of the energy of the field, else that u (Bryan et al. 1995): at
    beta of 1e-4 the former is a small difference of large numbers, of either sign; the latter stays positive.
    `switched` counts, for each particle, the steps that ended with it; E is then set right and what that adds is booked
    in leak_E.
    """

    least: float = 1e-3

    def __post_init__(self):
        if not 0 <= self.least <= 1:
            raise InputError(f"Dual: least = {self.least} must lie in 0..1; 1e-3 is usual")

    def among(self, parts: tuple) -> "Energy":
        """For a scene with a field; without one, E is nothing but motion and heat, and u is evolved."""
        total = super().among(parts)
        return MagneticDual(total.centred, self.least) if isinstance(total, MagneticTotal) else Thermal()


@known_as("Dual")
@dataclass(frozen=True)
class MagneticDual(MagneticTotal):
    """E, and u_own beside it, in a scene with a field."""

    least: float = 1e-3
    evolves = {"E": real, "u_own": real, "leak_E": real}
    keeps = {"switched": real}

    @ti.func
    def open(self, i, now):
        return ti.Struct(E=0.5 * i.v.dot(i.v) + i.u + self.field(i), u_own=i.u)

    @ti.func
    def known(self, i):
        """Whether what remains of E is more than its own error."""
        return self.left(i) > self.least * self.field(i)

    @ti.func
    def close(self, i, now):
        return ti.Struct(u=ti.select(self.known(i), self.left(i), i.u_own))

    @ti.func
    def after(self, i, total, now):
        return ti.Struct(E=self.gain(i, total, now), u_own=i.P * total.closing)

    @ti.func
    def settle(self, i, now):
        """Both energies agree again at the end of a step."""
        amiss = i.u - self.left(i)
        taken = ti.select(self.known(i), 0.0, 1.0)
        return ti.Struct(E=i.E + amiss, leak_E=i.leak_E + amiss, u_own=i.u, switched=i.switched + taken)
