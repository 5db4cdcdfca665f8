from dataclasses import dataclass

from ..eos import Radiating
from ..godunov.areas import CorrectedAreas
from ..godunov.rarefaction import ExactRiemann, Fan, IsothermalFan
from ..godunov.states import FirstOrder, SecondOrder
from ..runtime import ti
from ..types import real, vec3
from ..vector import traced
from .base import known_as
from .godunov import Godunov


@dataclass(frozen=True)
class GodunovHydro(Godunov):
    """dv_i/dt = - sum_j P* ( Gi + Gj ) e,   du_i/dt = - sum_j P* ( v* - v_i^(1/2) ).e ( Gi + Gj )

    Godunov SPH (lecture p. 22; Inutsuka 2002; Cha & Whitworth 2003): P* and v* solve the Riemann problem of the pair
    exactly, v^(1/2) = v + dt/2 dv/dt. No artificial viscosity or conductivity: shocks heat through P*. Momentum and
    energy are conserved to round-off for any dt. order=2: states from limited gradients, predicted to the middle of the
    step; pairs that approach faster than c/C_shock fall back to order 1. areas="corrected": n = -a/|a| and -|a| for
    e and Gi + Gj, a = A_i^-1 e Gi + A_j^-1 e Gj with A of the gradients (godunov/areas.py). Needs
    stepper=TimeCentred(); best with SumMass(slope="mean").
    """

    reads = {"P": real, "cs": real, "rho": real, "v": vec3}
    makes, evolves = {"vw": real}, {"v": vec3}
    sums = {"push": vec3, "heat": real}
    fields, beside = ("v",), ("PassiveDensity",)

    def forms(self) -> dict:
        """{(order, areas): class}"""
        return {(1, "plain"): FirstOrderHydro, (2, "plain"): SecondOrderHydro, (2, "corrected"): CorrectedHydro}

    def waves(self, eos) -> object:
        """The Riemann problem of this gas."""
        return ExactRiemann(IsothermalFan() if isinstance(eos, Radiating) else Fan(eos.gamma))

    @ti.func
    def close(self, i, now):
        return ti.Struct(vw=i.cs)

    @ti.func
    def side(self, s, P, v):
        """A side of the problem."""
        rho = self.riemann.law.density(self.density(s), P, self.pressure(s) / self.density(s))
        return ti.Struct(rho=rho, P=P, b2=0.0, v=v)

    @traced
    def sides(self, i, j, w, n, keep):
        """R and L: i and j."""
        pressures = self.pressures(i, j, w, keep)
        velocities = self.vectors("v", i, j, w, (n,), keep)
        return tuple(self.side(s, P, v.x) for s, P, v in zip((i, j), pressures, velocities, strict=True))

    @ti.func
    def pair(self, i, j, w, now):
        n, F = self.face(i, j, w)
        R, L = self.sides(i, j, w, n, self.kept(i, j, w))
        P, v = self.riemann.star(L, R)
        push = -P * F
        return ti.Struct(push=push * n, heat=push * (v - i.v.dot(n)))

    @ti.func
    def after(self, i, total, now):
        return ti.Struct(v=total.push, u=total.heat - self.gain(i, total, now).dot(total.push))


@known_as("GodunovHydro")
@dataclass(frozen=True)
class FirstOrderHydro(FirstOrder, GodunovHydro):
    """Riemann problems of the particles as they are."""


@known_as("GodunovHydro")
@dataclass(frozen=True)
class SecondOrderHydro(SecondOrder, GodunovHydro):
    """Riemann problems of limited states in the middle of the step."""

    @ti.func
    def predicted(self, i, slopes, half, closing):
        """dv/dt = - grad P/rho"""
        v = i.v
        for a in ti.static(range(self.dim)):
            v[a] -= half * slopes.dP[a] / i.rho
        return ti.Struct(v=v)


@known_as("GodunovHydro")
@dataclass(frozen=True)
class CorrectedHydro(CorrectedAreas, SecondOrderHydro):
    """Of second order, through corrected areas."""
