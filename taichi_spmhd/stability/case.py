"""What a hard case is: a start without the terms that act on it, one parameter that makes it harder, and limits."""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf

import numpy as np

from ..boundary import Boundary, everywhere
from ..density import SumMass, Summation
from ..eos import Adiabatic


@dataclass(frozen=True, eq=False)
class Problem:
    """Particles, their start and what surrounds them; terms and kernel are a preset's, `extra` terms the problem's own.

    changes: choices of the problem that replace the preset's, for instance {"stepper": Heun()}; without: names of
    terms of the preset that it does without.
    """

    box: tuple
    positions: np.ndarray
    start: Callable
    t_end: float
    eos: object = field(default_factory=lambda: Adiabatic(5 / 3))
    boundary: Boundary = field(default_factory=everywhere)
    density: Summation = field(default_factory=SumMass)
    extra: tuple = ()
    without: tuple = ()
    changes: dict = field(default_factory=dict)

    @property
    def magnetised(self) -> bool:
        return "B" in self.start(self.positions)


@dataclass(frozen=True)
class Limits:
    """Beyond these a run that has finished is not sound.

    energy: off the ledger, of all energy there is; momentum: off the ledger, of M times the largest r.m.s. velocity,
    or r.m.s. speed of signals where that is more;
    close: share of particles nearer to a neighbour than half a spacing; div_B: mean of h |div B| / |B|.
    """

    energy: float = 0.01
    momentum: float = 1e-6
    close: float = 0.01
    div_B: float = inf


SHOCKED = Limits(energy=0.02, close=0.02)  # where shocks take apart what lattice there was


@dataclass(frozen=True)
class Case:
    """make(value, nx) -> Problem at a value of the parameter `hard`.

    values: those that must be sound, the hardest last; beyond: harder ones, to find how far it is to trouble; nx: of
    the whole battery and of the quick one; quick: the values of the quick one (default: the hardest); single: the
    values in f32, where it cannot represent the others.
    """

    name: str
    about: str
    hard: str
    make: Callable
    values: tuple
    beyond: tuple = ()
    nx: tuple[int, int] = (48, 24)
    limits: Limits = Limits()
    quick: tuple | None = None
    single: tuple | None = None

    def chosen(self, whole: bool, precision: str = "f64") -> tuple[int, tuple]:
        """Resolution and values of the whole battery, or of the quick one."""
        values = self.single if self.single and precision == "f32" else self.values
        return (self.nx[0], values) if whole else (self.nx[1], self.quick or values[-1:])

    def further(self, precision: str) -> tuple:
        """What is beyond; nothing where f32 cannot even tell the stated values apart."""
        return () if self.single and precision == "f32" else self.beyond
