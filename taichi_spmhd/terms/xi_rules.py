"""Rules that give xi of DivBSource from the local beta = 2P/B^2: as much of it as each place needs.

    DivBSource(xi=MinimalXi())

A rule is a small frozen dataclass with one line, `of(beta)`; it is computed once a particle. Any other rule is eight
lines inside a scene file.
"""

from dataclasses import dataclass
from numbers import Real

import numpy as np

from ..errors import InputError
from ..runtime import ti


@ti.func
def clip(value, low, high):
    return ti.min(ti.max(value, low), high)


@dataclass(frozen=True)
class XiRule:
    """xi = of(beta), beta = 2P/B^2 of particle i."""


@dataclass(frozen=True)
class PhantomXi(XiRule):
    """xi = 1 for beta < 2, (10 - beta)/8, 0 from beta = 10 on   (Price et al. 2018)

    The full Lorentz force wherever the field matters; where it is weak, momentum is conserved exactly again.
    """

    @ti.func
    def of(self, beta):
        return clip((10.0 - beta) / 8.0, 0.0, 1.0)


@dataclass(frozen=True)
class LogLinearXi(XiRule):
    """xi = 1/2 for beta > high, 1 for beta < low, linear in log beta between   (lecture p. 20)

    1/2 keeps waves along B at their speed; only where beta is so low that 1/2 has no margin left does xi rise to 1.
    """

    low: float = 0.01
    high: float = 0.1

    def __post_init__(self):
        if not 0 < self.low < self.high < 1e6:
            raise InputError(f"LogLinearXi: low = {self.low} and high = {self.high}; give 0 < low < high")

    @ti.func
    def of(self, beta):
        span = ti.static(float(np.log(self.high / self.low)))
        return 0.5 + 0.5 * clip(ti.log(self.high / ti.max(beta, 0.5 * self.low)) / span, 0.0, 1.0)


@dataclass(frozen=True)
class MinimalXi(XiRule):
    """xi = (1 - beta)/2 + margin, within 0..1: the least that is stable, and a margin

    (1 - beta)/2 is the threshold of linear theory on a lattice (physics of uniform_field). Takes the least momentum
    and energy, none for beta > 1 + 2 margin; margin = 0 stands on the edge, a negative one clumps.
    """

    margin: float = 0.05

    def __post_init__(self):
        if not -0.5 <= self.margin <= 0.5:
            raise InputError(f"MinimalXi: margin = {self.margin} must lie in -0.5..0.5; 0.05 is usual")

    @ti.func
    def of(self, beta):
        return clip(0.5 * (1.0 - beta) + self.margin, 0.0, 1.0)


@ti.kernel
def tabulate(rule: ti.template(), beta: ti.types.ndarray(ndim=1), out: ti.types.ndarray(ndim=1)):
    for n in range(beta.shape[0]):
        out[n] = rule.of(beta[n])


def xi_of(term, beta: np.ndarray) -> np.ndarray:
    """xi (N,) of particles with this beta (N,): the term's number, or what its rule says; 0 where the term is None."""
    beta = np.ascontiguousarray(beta)
    xi = getattr(term, "xi", 0.0)
    if isinstance(xi, Real):
        return np.full(beta.shape, float(xi))
    out = np.empty_like(beta)
    tabulate(xi, beta, out)
    return out
