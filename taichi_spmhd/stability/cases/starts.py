"""Bad starts: strewn at random, particles all but on one spot."""

import numpy as np

from ...box import Box
from ...lattice import hexagonal
from ..case import Case, Limits, Problem

BOX = (1.0, 1.0)


def strewn(beta: float, nx: int) -> Problem:
    """Positions drawn at random: some particles have twice the neighbours of others, some are nearly on one spot."""
    x = np.random.default_rng(4).uniform(size=(nx * nx, 2))
    given = {"rho": 1.0, "P": 0.5 * beta, "B": [1.0, 0.0, 0.0]}
    return Problem(BOX, x, lambda x: given, 1.0)


def strewn_3d(beta: float, nx: int) -> Problem:
    """The same in three dimensions."""
    x = np.random.default_rng(4).uniform(size=(nx**3, 3))
    given = {"rho": 1.0, "P": 0.5 * beta, "B": [1.0, 0.0, 0.0]}
    return Problem((1.0, 1.0, 1.0), x, lambda x: given, 0.3)


def doubled(gap: float, nx: int) -> Problem:
    """One particle in twenty is put `gap` spacings beside its neighbour on the lattice."""
    box = Box((0.0, 0.0), BOX)
    x = hexagonal(box, nx)
    moved = np.arange(0, len(x) - 1, 20)
    x[moved] = x[moved + 1] + gap / nx * np.array([0.6, 0.8])
    given = {"rho": 1.0, "P": 0.5, "B": [1.0, 0.0, 0.0]}
    return Problem(BOX, x, lambda x: given, 0.5)


# clumps are there at the start, and viscosity parts them slowly: what counts is that nothing breaks
CLUMPED = Limits(energy=0.02, close=0.5)

CASES = (
    Case("strewn", "positions drawn at random in a uniform field", "beta", strewn, (10.0, 1.0, 0.1), (1e-2, 1e-4),
         (32, 20), CLUMPED),
    Case("strewn_3d", "the same in three dimensions", "beta", strewn_3d, (10.0, 1.0, 0.1), (1e-2, 1e-3), (14, 10),
         CLUMPED),
    Case("doubled", "one particle in twenty all but on its neighbour's spot", "gap", doubled,
         (1e-3, 1e-6, 1e-9), (1e-12, 1e-14), (32, 20), CLUMPED, single=(1e-3,)),
)  # fmt: skip
