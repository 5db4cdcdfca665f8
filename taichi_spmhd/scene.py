"""Scene: what to simulate, as frozen data."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from .boundary import Boundary, everywhere
from .box import Box, as_box
from .density import SumMass, Summation
from .energy import Energy, Thermal
from .eos import Adiabatic, Radiating
from .errors import InputError
from .guard import Guard
from .kernels import CubicSpline, Kernel
from .picture import Picture, suggestion
from .scene_checks import check, check_kinds, numbers
from .stepper import LeapfrogKDK
from .terms import Term
from .terms.compression import Compression
from .terms.frozen_ends import FrozenEnds
from .terms.radiated import Radiated
from .terms.volume_slope import VolumeSlope


@dataclass(frozen=True, eq=False)
class Scene:
    """Terms add, choices replace.

    box: lengths or intervals per axis; positions: (N, d); start(x) -> {"rho", "v", "P" or "u" (LocallyIsothermal:
    "cs"), "B", "psi", "mass"}, arrays (N,) or (N, 3) or numbers; terms: the effects; eos, kernel, density, energy,
    stepper, boundary: one choice each. exact(x, t) -> {member: array}: the solution where there is one, `measure` the
    member whose error is quoted; reference: path of a stored map to compare with at its time
    (diagnostics/reference.py); guard: how far a run may stray before it is stopped. Without "mass" the mass is rho
    times volume / N.
    """

    box: Box
    positions: np.ndarray
    start: Callable
    terms: tuple
    eos: object = field(default_factory=Adiabatic)
    kernel: Kernel = field(default_factory=CubicSpline)
    density: Summation = field(default_factory=SumMass)
    energy: Energy = field(default_factory=Thermal)
    stepper: object = field(default_factory=LeapfrogKDK)
    boundary: Boundary = field(default_factory=everywhere)
    guard: Guard = field(default_factory=Guard)
    t_end: float = 1.0
    picture: Picture = field(default_factory=Picture)
    exact: Callable | None = None
    reference: Path | None = None
    measure: str | None = None

    def __post_init__(self):
        check_kinds(self)
        object.__setattr__(self, "box", as_box(self.box))
        x = numbers(self.positions)
        object.__setattr__(self, "positions", x[:, None] if x.ndim == 1 else x)
        object.__setattr__(self, "terms", tuple(self.terms))
        if self.reference is not None:
            object.__setattr__(self, "reference", Path(self.reference))
        check(self)

    @property
    def dim(self) -> int:
        return self.positions.shape[1]

    @property
    def listed(self) -> tuple:
        """Choices that take part in an evaluation, then the terms, as the scene names them."""
        energy = () if isinstance(self.eos, Radiating) else (self.energy,)
        return (*energy, self.eos, *self.terms)

    @property
    def parts(self) -> tuple:
        """The parts that do the work, in an order in which every need is made before."""
        parts = tuple(part.among(self.listed) for part in self.listed)
        parts += (Radiated().among(parts),) if isinstance(self.eos, Radiating) else ()
        closing = (Compression(),) if any("closing" in part.sums for part in parts) else ()
        ends = (FrozenEnds().among(parts),) if self.boundary.frozen else ()
        curved = (VolumeSlope(self.density),) if self.density.slope == "cubic" else ()
        return in_order((*parts, *closing, *ends, *curved))

    def sketch(self) -> str:
        """Terms, choices and box in one line: what a saved state must agree with."""
        choices = (self.kernel, self.density, self.stepper, self.boundary)
        return "; ".join([*(str(part) for part in self.parts), *(repr(choice) for choice in choices), repr(self.box)])

    def plus(self, *terms: Term) -> "Scene":
        """The same scene with more terms."""
        return replace(self, terms=(*self.terms, *terms))

    def without(self, *kinds: type | str) -> "Scene":
        """The same scene without the terms of these classes, given as classes or by their names."""
        names = {kind for kind in kinds if isinstance(kind, str)}
        classes = tuple(kind for kind in kinds if not isinstance(kind, str))
        kept = (t for t in self.terms if not isinstance(t, classes) and type(t).__name__ not in names)
        return replace(self, terms=tuple(kept))

    def tuned(self, term: str, **numbers) -> "Scene":
        """The same scene with other numbers in the term of this class name. Raises InputError where it has none."""
        names = [type(listed).__name__ for listed in self.terms]
        if term not in names:
            raise InputError(f"terms: no {term} to tune{suggestion(term, names)}; there are {', '.join(names)}")
        return replace(self, terms=tuple(replace(t, **numbers) if type(t).__name__ == term else t for t in self.terms))

    def but(self, **changes) -> "Scene":
        """The same scene with other choices or other numbers."""
        return replace(self, **changes)


def in_order(parts: tuple) -> tuple:
    """Parts sorted so that whoever reads a member comes after whoever makes it."""
    waiting, done, made = list(parts), [], set()
    ahead = {name for part in parts for name in part.makes}
    while waiting:
        ready = next(
            (p for p in waiting if all(n in made or n not in ahead or n in p.makes for n in p.reads)), waiting[0]
        )
        waiting.remove(ready)
        done.append(ready)
        made |= set(ready.makes)
    return tuple(done)
