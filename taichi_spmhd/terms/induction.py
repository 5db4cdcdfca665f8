from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti
from ..types import real, vec3
from .base import Term, known_as
from .godunov_mhd import GodunovMHD

FORMS = ("B/rho", "B")


@dataclass(frozen=True)
class Induction(Term):
    """d(B/rho)_i/dt = - sum_j v_ij (B_i.e) Gi

    Flux freezing, consistent with the summed density (lecture pp. 5, 12; Price 2012). form="B/rho" (the default): b =
    B/rho is evolved and B = rho b follows at every evaluation with the new density; with B across the velocity gradient
    |B| stays proportional to rho exactly, and strong compression in one step does no harm. form="B": B itself is
    evolved, with B along v it stays as it is to round-off. Both are the same equation in continuous time and contain
    the advection of div B with the flow (Powell's source in the induction equation).
    """

    form: str = "B/rho"
    reads, makes, evolves = {"v": vec3, "rho": real, "b": vec3}, {"B": vec3}, {"b": vec3}

    def __post_init__(self):
        if self.form not in FORMS:
            raise InputError(f'Induction: form = {self.form!r}; give "B/rho" (the default) or "B"')

    def among(self, parts: tuple) -> "Induction":
        """The class that evolves what `form` says, or only carries what Godunov's scheme induces."""
        if any(isinstance(part, GodunovMHD) for part in parts):
            return Carried(self.form)
        return InductionOfB(self.form) if self.form == "B" else self

    @ti.func
    def open(self, i, now):
        return ti.Struct(b=i.B / i.rho)

    @ti.func
    def close(self, i, now):
        return ti.Struct(B=i.rho * i.b)

    @ti.func
    def pair(self, i, j, w, now):
        return ti.Struct(b=-(w.Gi * i.B.dot(w.e)) * (i.v - j.v))


@dataclass(frozen=True)
class InductionOfB(Term):
    """dB_i/dt = - rho_i sum_j [ v_ij (B_i.e) - B_i (v_ij.e) ] Gi

    The form of Induction that evolves B (lecture p. 5). What other terms state as a rate of B/rho is turned into one
    of B here: dB = rho d(B/rho) + (B/rho) drho.
    """

    form: str = "B"
    reads, evolves = {"v": vec3, "rho": real, "B": vec3}, {"B": vec3}
    sums = {"b": vec3, "closing": real}
    rank = 1  # when all rates of B/rho are summed

    @ti.func
    def pair(self, i, j, w, now):
        return ti.Struct(b=-(w.Gi * i.B.dot(w.e)) * (i.v - j.v))

    @ti.func
    def after(self, i, total, now):
        return ti.Struct(B=i.rho * (total.b + total.closing * i.B))


@known_as("Induction")
@dataclass(frozen=True)
class Carried(Induction):
    """b = B/rho is evolved and B = rho b follows; GodunovMHD says at what rate, from its characteristics."""

    reads = {"rho": real, "b": vec3}
    pair = None

    def __post_init__(self):
        if self.form != "B/rho":
            raise InputError('Induction: GodunovMHD evolves B/rho; leave out form="B"')
