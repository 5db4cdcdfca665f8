from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti
from ..types import real, vec3
from .base import known_as
from .hyperbolic import SAFE, Hyperbolic

FRAMES = ("flow", "eulerian")


@dataclass(frozen=True)
class ConstantCleaning(Hyperbolic):
    """d(B/rho)_i/dt = - c_h sum_j ( y_i Gi + y_j Gj ) e,   dy/dt = - c_h div B - (1/tau + div v/2) y,   y = psi/c_h

    Hyperbolic divergence cleaning with one speed for all particles (lecture pp. 27-30; Dedner et al. 2002; Iwasaki &
    Inutsuka 2013): c_h = C_CFL min(dx)/dt, dx = (m/rho)^(1/d), of the step that is being taken (the largest vw before
    the first), and 1/tau = alpha c_h/min(dx), so that each step damps psi by exp(-alpha C_CFL), exactly, at its end.
    What that takes is booked in leak_E.

    frame="flow" (the default): psi moves with the gas; -psi div v/2 keeps its energy when the gas is squeezed, as in
    Cleaning, and nothing depends on the observer's motion. frame="eulerian": psi stays where it is, as in Dedner's
    equations, by adding v.grad psi; its energy is then not conserved, and not the same for a moving observer.
    scaled=True (the default): y = psi/c_h is evolved, so psi follows when c_h changes and no energy is made.
    scaled=False: psi is evolved, as the equations are usually written; a step that grows by 10 then makes the energy of
    psi 100 times larger.
    Advice: alpha = 0.3; f_clean > 1 shortens the step, and so raises c_h, by that factor where Courant's limit rules.
    """

    alpha: float = 0.3
    f_clean: float = 1.0
    C_CFL: float = 0.3
    frame: str = "flow"
    scaled: bool = True
    reads = {"B": vec3, "v": vec3, "rho": real, "h": real, "vw": real, "y": real}
    keeps = {"psi": real}  # at the end of the last step: for pictures
    evolves, sums = {"y": real, "leak_E": real}, {"b": vec3}
    mosts = {"most_per_dx": real, "most_vw": real}
    live = {"alpha": (0.0, 2.0), "f_clean": (1.0, 5.0)}

    def __post_init__(self):
        if not (0 <= self.alpha < 100 and 1 <= self.f_clean < 100 and 0 < self.C_CFL <= 1):
            numbers = f"alpha = {self.alpha}, f_clean = {self.f_clean}, C_CFL = {self.C_CFL}"
            raise InputError(f"ConstantCleaning: {numbers} must lie in 0..100, 1..100 and (0, 1]")
        if self.frame not in FRAMES:
            raise InputError(f'ConstantCleaning: frame = {self.frame!r}; give "flow" (the default) or "eulerian"')

    def among(self, parts: tuple) -> "ConstantCleaning":
        """The class that does what `frame` and `scaled` say, or the one for steps of a single evaluation."""
        super().among(parts)
        if any(part.centred for part in parts):
            return CentredCleaning(self.alpha, self.f_clean, self.C_CFL, self.frame, self.scaled)
        kind = KINDS[self.frame, bool(self.scaled)]
        return kind(self.alpha, self.f_clean, self.C_CFL, self.frame, self.scaled)

    @ti.func
    def most(self, i):
        return ti.Struct(most_per_dx=ti.pow(i.rho / i.m, 1.0 / i.x.n), most_vw=i.vw)

    @ti.func
    def ch(self, now):
        """c_h: from the step being taken, or where there is none yet from the signal speed."""
        per_step = self.C_CFL / (now.dt * now.most_per_dx + 1e-30)
        return ti.select(now.dt > 0.0, per_step, self.f_clean * now.most_vw)

    @ti.func
    def carried(self, own, other, i, j, w):
        """- div v/2 times y (or psi), over - rho Gi: what moving with the flow adds."""
        return 0.5 * own * (i.v - j.v).dot(w.e)

    @ti.func
    def open(self, i, now):
        return ti.Struct(y=i.psi / (self.f_clean * i.vw + 1e-30))

    @ti.func
    def pair(self, i, j, w, now):
        ch, div_B = self.ch(now), (i.B - j.B).dot(w.e)
        return ti.Struct(
            b=-ch * (i.y * w.Gi + j.y * w.Gj) * w.e,
            y=i.rho * w.Gi * (ch * div_B + self.carried(i.y, j.y, i, j, w)),
        )

    @ti.func
    def settle(self, i, now):
        """The decay over the step, and what energy it took."""
        left = ti.exp(-self.alpha * self.ch(now) * now.most_per_dx * now.dt)
        y = i.y * left
        return ti.Struct(y=y, psi=self.ch(now) * y, leak_E=i.leak_E - 0.5 * (i.y * i.y - y * y) / i.rho)

    @ti.func
    def max_dt(self, i, now):
        """From vw, not from c_h: c_h follows the step, and a step that followed c_h would shrink for ever."""
        return SAFE * i.h / (self.f_clean * i.vw + 1e-30)


class Unscaled(ConstantCleaning):
    """dpsi/dt = - c_h^2 div B - (1/tau + div v/2) psi"""

    reads = {"B": vec3, "v": vec3, "rho": real, "h": real, "vw": real, "psi": real}
    keeps = {"y": real}  # at the end of the last step: for the ledger
    evolves = {"psi": real, "leak_E": real}

    @ti.func
    def pair(self, i, j, w, now):
        ch, div_B = self.ch(now), (i.B - j.B).dot(w.e)
        return ti.Struct(
            b=-(i.psi * w.Gi + j.psi * w.Gj) * w.e,
            psi=i.rho * w.Gi * (ch * ch * div_B + self.carried(i.psi, j.psi, i, j, w)),
        )

    @ti.func
    def settle(self, i, now):
        before, left = i.psi / self.ch(now), ti.exp(-self.alpha * self.ch(now) * now.most_per_dx * now.dt)
        y = before * left
        return ti.Struct(psi=i.psi * left, y=y, leak_E=i.leak_E - 0.5 * (before * before - y * y) / i.rho)


@known_as("ConstantCleaning")
@dataclass(frozen=True)
class CentredCleaning(ConstantCleaning):
    """y <- y - dt c_h div B first, then d(B/rho)_i/dt = - c_h sum_j ( y_i Gi + y_j Gj ) e with that y

    For steps of one evaluation: the field answers to the psi that it has just made, as in a leapfrog. With both at the
    start of the step the waves of psi would grow.
    """

    gathers = {"div_B": real}
    makes, together = {"y_new": real, "div_B": real}, ("y_new",)
    sums = {"b": vec3, "closing": real}

    def __post_init__(self):
        super().__post_init__()
        if self.frame != "flow" or not self.scaled:
            raise InputError('ConstantCleaning: GodunovMHD needs frame="flow" and scaled=True; leave them out')

    @ti.func
    def gather(self, i, j, w):
        return ti.Struct(div_B=-i.rho * w.Gi * (i.B - j.B).dot(w.e))

    @ti.func
    def gathered(self, i, sums, now):
        return ti.Struct(div_B=sums.div_B, y_new=i.y - now.dt * self.ch(now) * sums.div_B)

    @ti.func
    def pair(self, i, j, w, now):
        return ti.Struct(b=-self.ch(now) * (i.y_new * w.Gi + j.y_new * w.Gj) * w.e)

    @ti.func
    def after(self, i, total, now):
        return ti.Struct(y=0.5 * i.y * i.rho * total.closing - self.ch(now) * i.div_B)


class Eulerian:
    """psi that does not move with the gas: Dy/Dt has v.grad y, by differences."""

    @ti.func
    def carried(self, own, other, i, j, w):
        return -i.v.dot(w.e) * (own - other)


class EulerianScaled(Eulerian, ConstantCleaning):
    """dy/dt = v.grad y - c_h div B - y/tau,   y = psi/c_h:   psi stays where it is"""


class EulerianUnscaled(Eulerian, Unscaled):
    """dpsi/dt = v.grad psi - c_h^2 div B - psi/tau:   psi stays where it is and is not scaled with c_h"""


KINDS = {
    ("flow", True): ConstantCleaning,
    ("flow", False): Unscaled,
    ("eulerian", True): EulerianScaled,
    ("eulerian", False): EulerianUnscaled,
}
