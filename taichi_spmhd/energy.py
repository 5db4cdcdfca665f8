"""Which energy is integrated in time.  (a choice)   A term always states its heat, u; only this file knows of E."""

from dataclasses import dataclass

from .runtime import ti
from .terms.base import Choice
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

    reads, makes, evolves = {"v": vec3}, {"u": real}, {"E": real}
    sums = {"u": real}
    rank = 2  # E is opened and finished when u, v and B are

    def among(self, parts: tuple) -> "Total":
        """With the energy of the field where the scene has one."""
        return MagneticTotal() if any("B" in {**part.makes, **part.evolves} for part in parts) else self

    @ti.func
    def open(self, i, now):
        return ti.Struct(E=0.5 * i.v.dot(i.v) + i.u)

    @ti.func
    def close(self, i, now):
        return ti.Struct(u=i.E - 0.5 * i.v.dot(i.v))

    @ti.func
    def after(self, i, total, now):
        return ti.Struct(E=i.v.dot(total.v) + total.u)

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
    def open(self, i, now):
        return ti.Struct(E=0.5 * i.v.dot(i.v) + i.u + 0.5 * i.B.dot(i.B) / i.rho)

    @ti.func
    def close(self, i, now):
        return ti.Struct(u=i.E - 0.5 * i.v.dot(i.v) - 0.5 * i.B.dot(i.B) / i.rho)

    @ti.func
    def after(self, i, total, now):
        return ti.Struct(
            E=i.v.dot(total.v) + total.u + i.B.dot(total.b) + 0.5 * i.B.dot(i.B) * total.closing,
        )
