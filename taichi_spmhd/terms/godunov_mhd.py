from dataclasses import dataclass

from ..eos import Radiating
from ..godunov.across import across
from ..godunov.areas import CorrectedAreas
from ..godunov.characteristics import crossed, sign
from ..godunov.hugoniot import Hugoniot, Isothermal
from ..godunov.riemann import Riemann
from ..godunov.states import FirstOrder, SecondOrder
from ..runtime import ti
from ..types import real, vec3
from ..vector import traced
from .base import known_as
from .godunov import Godunov


@dataclass(frozen=True)
class GodunovMHD(Godunov):
    """dv_i/dt = sum_j ( Bn B_perp* - Pi* e )( Gi + Gj ),   d(B/rho)_i/dt = sum_j Bn ( v* - v_i^(1/2) )( Gi + Gj )

    Godunov SPMHD (lecture pp. 22-23; Iwasaki & Inutsuka 2011): P_t* and v_n* solve the Riemann problem of the total
    pressure P + B_perp^2/2 between the pair, whose waves are fast shocks across the field; B_perp* and v_perp* follow
    from the characteristics of the Alfven wave. Bn is the mean of both B.e, Pi* = P_t* - (Bn_i^2 + Bn_j^2)/4, v^(1/2) =
    v + dt/2 dv/dt. No artificial viscosity, conductivity or resistivity. With energy=Total() momentum and energy are
    conserved to round-off for any dt, but for what DivBSource(xi) adds, which the ledger knows.

    order=2: states from limited gradients, predicted to the middle of the step with all of the gradient tensors (along
    the pair's axis alone an Alfven wave in two dimensions would grow). Pairs that approach faster than c/C_shock are
    treated to first order: without that B_n jumps by a quarter behind strong shocks. areas="corrected": n = -a/|a| and
    -|a| in place of e and Gi + Gj where v and E change, a = A_i^-1 e Gi + A_j^-1 e Gj with A of the gradients
    (godunov/areas.py); best with few neighbours (schemes.STIRRED). Needs stepper=TimeCentred() and Induction(), which
    carries B; best with SumMass(slope="mean") and, with plain areas, 20 or more neighbours (h_fact 1.2 in 2-D).
    """

    reads = {"P": real, "cs": real, "rho": real, "v": vec3, "B": vec3}
    makes, evolves = {"vw": real}, {"v": vec3}
    sums = {"push": vec3, "heat": real, "carried": vec3, "S": real, "b": vec3, "closing": real}
    fields = ("v", "B")
    beside = ("Induction", "DivBSource", "ConstantCleaning", "PassiveDensity")

    def forms(self) -> dict:
        """{(order, areas): class}"""
        return {(1, "plain"): FirstOrderMHD, (2, "plain"): SecondOrderMHD, (2, "corrected"): CorrectedMHD}

    def waves(self, eos) -> object:
        """The Riemann problem of this gas."""
        return Riemann(Isothermal() if isinstance(eos, Radiating) else Hugoniot(eos.gamma))

    @ti.func
    def close(self, i, now):
        return ti.Struct(vw=ti.sqrt(i.cs * i.cs + i.B.dot(i.B) / i.rho))

    @ti.func
    def side(self, s, P, v, B):
        """A side of the problem, its pressure with that of the field across."""
        rho = self.riemann.law.density(self.density(s), P, self.pressure(s) / self.density(s))
        b2 = B.y * B.y + B.z * B.z
        return ti.Struct(rho=rho, P=P + 0.5 * b2, b2=b2, v=v.x, root=ti.sqrt(rho), v_perp=v, B_perp=B)

    @traced
    def sides(self, i, j, w, axes, keep):
        """R and L: i and j."""
        pressures = self.pressures(i, j, w, keep)
        v, B = (self.vectors(name, i, j, w, axes, keep) for name in self.fields)
        return tuple(self.side(*four) for four in zip((i, j), pressures, v, B, strict=True))

    @ti.func
    def pair(self, i, j, w, now):
        n, F = self.face(i, j, w)
        first, second = across(n)
        R, L = self.sides(i, j, w, (n, first, second), self.kept(i, j, w))
        along_i, along_j = self.field(i).dot(n), self.field(j).dot(n)
        mean = 0.5 * (along_i + along_j)
        P, vn = self.riemann.star(L, R)
        B1, v1 = crossed(L.root, R.root, sign(mean), L.v_perp.y, R.v_perp.y, L.B_perp.y, R.B_perp.y)
        B2, v2 = crossed(L.root, R.root, sign(mean), L.v_perp.z, R.v_perp.z, L.B_perp.z, R.B_perp.z)
        past = vn * n + v1 * first + v2 * second - i.v
        push = (mean * (B1 * first + B2 * second) - (P - 0.25 * (along_i * along_i + along_j * along_j)) * n) * F
        S = mean * F
        return ti.Struct(push=push, heat=push.dot(past), **self.passing(i, j, w, past, S))

    @traced
    def passing(self, i, j, w, past, S) -> dict:
        """What the field between the pair adds to the sums."""
        return {"carried": S * past, "S": S}

    @ti.func
    def after(self, i, total, now):
        """Rates from the sums: by then total.v has all other forces, and total.b what cleaning adds."""
        gain = self.gain(i, total, now)
        b = total.carried - self.sent(total) * gain
        work = i.B.dot(b) + 0.5 * total.closing * i.B.dot(i.B)
        heat = total.heat - gain.dot(total.push) - work
        spare = 0.5 * i.rho * now.dt * total.b.dot(total.b)  # of the field's energy, quadratic in what cleaning adds
        return ti.Struct(v=total.push, b=b, u=heat, E=spare, leak_E=self.pull(total).dot(i.v + gain))

    @ti.func
    def sent(self, total):
        """The sum that multiplies v_i in the induction."""
        return total.S

    @ti.func
    def pull(self, total):
        """The force of the div B source, if there is one: its work is booked here, where the velocity is known."""
        if ti.static("leak_v" in total.keys):
            return total.leak_v
        else:
            return 0.0 * total.v


@known_as("GodunovMHD")
@dataclass(frozen=True)
class FirstOrderMHD(FirstOrder, GodunovMHD):
    """Riemann problems of the particles as they are."""


@known_as("GodunovMHD")
@dataclass(frozen=True)
class SecondOrderMHD(SecondOrder, GodunovMHD):
    """Riemann problems of limited states in the middle of the step."""

    @ti.func
    def predicted(self, i, slopes, half, closing):
        """dv/dt = [ (B.grad) B - grad(P + B^2/2) ]/rho,   dB/dt = (B.grad) v - B div v"""
        v, B = i.v, i.B
        B -= closing * i.B
        for a in ti.static(range(self.dim)):
            dB = ti.Vector([slopes.dBx[a], slopes.dBy[a], slopes.dBz[a]])
            dv = ti.Vector([slopes.dvx[a], slopes.dvy[a], slopes.dvz[a]])
            v += half / i.rho * i.B[a] * dB
            v[a] -= half / i.rho * (slopes.dP[a] + i.B.dot(dB))
            B += half * i.B[a] * dv
        return ti.Struct(v=v, B=B)


@known_as("GodunovMHD")
@dataclass(frozen=True)
class CorrectedMHD(CorrectedAreas, SecondOrderMHD):
    """Of second order, through corrected areas, but for the induction: Bn ( v* - v_i^(1/2) )( Gi + Gj ), Bn along e.

    S is the div B that the force contains, as ever: with that of plain areas xi = 1/2 would not be enough at low beta.
    """

    sums = GodunovMHD.sums | {"through": real}

    @traced
    def passing(self, i, j, w, past, S) -> dict:
        mean = 0.5 * (self.field(i) + self.field(j)).dot(w.e)
        through = ti.lang.impl.expr_init(mean * (w.Gi + w.Gj))
        return {"carried": through * past, "S": S, "through": through}

    @ti.func
    def sent(self, total):
        return total.through
