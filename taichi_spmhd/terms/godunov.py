"""What both Godunov terms share: their numbers, what they replace, and the law of the waves that the gas has."""

from dataclasses import dataclass, replace
from numbers import Real

from ..eos import Adiabatic, Radiating
from ..errors import InputError
from ..godunov.areas import AREAS, PlainAreas
from ..godunov.limiter import LIMITERS
from ..guard import ours
from ..runtime import ti
from .base import Term
from .held import free


@dataclass(frozen=True)
class Godunov(PlainAreas, Term):
    """The gas between a pair of particles is a Riemann problem: its star state pushes both, and heats what shocks heat.

    order: 1 or 2. limiter: "II11", "minmod" or "none". C_shock: pairs that approach faster than c/C_shock are treated
    to first order. areas: "plain" or, with order=2, "corrected" (godunov/areas.py). riemann, dim: known when the scene
    is; leave them out.
    """

    order: int = 2
    limiter: str = "II11"
    C_shock: float = 3.0
    areas: str = "plain"
    riemann: object = None
    dim: int = 0
    live = {"C_shock": (0.5, 10.0)}
    centred = True
    rank = 1  # when all other forces are summed

    def __post_init__(self):
        name = type(self).__name__
        if isinstance(self.order, bool) or self.order not in (1, 2):
            raise InputError(f"{name}: order = {self.order!r}; give 1 or 2")
        if not isinstance(self.limiter, str) or self.limiter not in LIMITERS:
            raise InputError(f"{name}: limiter = {self.limiter!r}; give one of {', '.join(LIMITERS)}")
        if not (isinstance(self.C_shock, Real) and 0 <= self.C_shock <= 1e6):
            raise InputError(f"{name}: C_shock = {self.C_shock} must lie in 0..1e6; 3 is usual")
        if not isinstance(self.areas, str) or self.areas not in AREAS:
            raise InputError(f"{name}: areas = {self.areas!r}; give one of {', '.join(AREAS)}")
        if (self.order, self.areas) not in self.forms():
            raise InputError(f'{name}: areas="{self.areas}" needs gradients: give order=2, or leave areas out')

    def __str__(self) -> str:
        areas = "" if self.areas == AREAS[0] else f', areas="{self.areas}"'
        return f'{type(self).__name__}(order={self.order}, limiter="{self.limiter}", C_shock={self.C_shock:g}{areas})'

    def among(self, parts: tuple) -> "Godunov":
        """The class that does what `order` and `areas` say, with the waves of the scene's gas."""
        own = type(self).__name__
        for part in parts:
            name = type(part).__name__
            if isinstance(part, Term) and part is not self and ours(part) and name not in self.beside:
                raise InputError(f"terms: {own} contains what {name} does, or cannot work with it; leave out {name}")
        eos = next(part for part in parts if isinstance(part, Adiabatic | Radiating))
        form = self.forms()[self.order, self.areas]
        made = form(self.order, self.limiter, self.C_shock, self.areas)
        return replace(made, riemann=self.waves(eos))

    def smooth(self) -> "Godunov":
        """Slopes as they are: a limiter is not linear, however small the wave."""
        return replace(self, limiter="none", C_shock=0.0)

    def at(self, dim: int) -> "Godunov":
        return replace(self, dim=dim)

    @ti.func
    def speed(self, i, j, w, now):
        """The faster signal, and how fast the two approach."""
        return ti.max(i.vw, j.vw) - ti.min((self.velocity(i) - self.velocity(j)).dot(w.e), 0.0)

    @ti.func
    def gain(self, i, total, now):
        """What the velocity gains up to the middle of the step; nothing where frozen ends hold the particle."""
        return 0.5 * now.dt * free(i) * (total.v + total.push)
