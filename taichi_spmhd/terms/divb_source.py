from dataclasses import dataclass
from numbers import Real

from ..errors import InputError
from ..runtime import ti
from ..types import real, vec3
from .base import Term, known_as
from .godunov_mhd import GodunovMHD
from .xi_rules import XiRule


@dataclass(frozen=True)
class DivBSource(Term):
    """dv_i/dt = - xi B_i S_i,   S_i = sum_j ( B_i.e Gi + B_j.e Gj )

    The cure of the tensile instability: it takes the force along B that div B errors exert away (lecture pp. 18-20;
    Borve, Omang & Trulsen 2001; Iwasaki 2015). S is the symmetric div B / rho, the one the stress contains.
    Stable for xi >= (1 - beta)/2, beta = 2P/B^2. Advice: xi = 1/2 keeps waves along B at their speed and is enough down
    to beta ~ 0.01; below use xi = 1. xi may be a rule instead of a number, PhantomXi(), LogLinearXi() or MinimalXi():
    then each particle has its own, from its beta. Momentum and energy are no longer conserved exactly: what this force
    adds to them is integrated beside v (leak_v, leak_E per mass), so that the drift is predicted and not only measured.
    """

    xi: float | XiRule = 1.0
    sums, live = {"S": real}, {"xi": (0.0, 1.0)}
    evolves = {"v": vec3, "leak_v": vec3, "leak_E": real}

    def __post_init__(self):
        number = isinstance(self.xi, Real) and 0 <= self.xi <= 2
        if not number and not isinstance(self.xi, XiRule):
            raise InputError(
                f"DivBSource: xi = {self.xi!r} must lie in 0..2 (1/2 cures, 1 is the Lorentz force) "
                "or be a rule, for example MinimalXi()"
            )

    def among(self, parts: tuple) -> "DivBSource":
        """The class that takes away what the scene's stress exerts along B."""
        godunov = next((part for part in parts if isinstance(part, GodunovMHD)), None)
        return self if godunov is None else CentredSource(self.xi, godunov.order)

    @property
    def reads(self) -> dict:
        """The pressure only where a rule asks for beta."""
        return {"B": vec3, "v": vec3} | ({"P": real} if isinstance(self.xi, XiRule) else {})

    @ti.func
    def strength(self, i):
        """xi of particle i."""
        xi = ti.cast(0.0, float)
        if ti.static(isinstance(self.xi, XiRule)):  # noqa: SIM108  (only one branch is compiled)
            xi = self.xi.of(2.0 * i.P / (i.B.dot(i.B) + 1e-30))
        else:
            xi = self.xi
        return xi

    @ti.func
    def pair(self, i, j, w, now):
        return ti.Struct(S=w.Gi * i.B.dot(w.e) + w.Gj * j.B.dot(w.e))

    @ti.func
    def after(self, i, total, now):
        force = -self.strength(i) * total.S * i.B
        return ti.Struct(v=force, leak_v=force, leak_E=force.dot(i.v))


@known_as("DivBSource")
@dataclass(frozen=True)
class CentredSource(DivBSource):
    """dv_i/dt = - xi B_i S_i,   S_i = sum_j Bn ( Gi + Gj ):   the div B that GodunovMHD contains, in mid-step

    S is summed by GodunovMHD, which also books the work of this force.
    """

    order: int = 2
    sums = {}
    pair = None

    @ti.func
    def after(self, i, total, now):
        B = i.B
        if ti.static(self.order == 2):
            B = i.B_mid
        force = -self.strength(i) * total.S * B
        return ti.Struct(v=force, leak_v=force)
