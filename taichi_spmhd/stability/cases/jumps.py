"""Jumps: of masses, of densities, of smoothing lengths, of pressures."""

from math import inf

import numpy as np

from ...boundary import Boundary, Reflecting
from ...density import SumVolume
from ...lattice import hexagonal, jitter, line
from ...profiles import step_lattice
from ..case import Case, Limits, Problem

BOX = (1.0, 0.5)
FLIGHT = (1.0, 0.5, 0.0)


def masses(ratio: float, nx: int, B: float = 0.5) -> Problem:
    """A slab of gas `ratio` times heavier, particle by particle, flies through the box with its surroundings."""

    def start(x):
        rho = np.where(abs(x[:, 0] - 0.5) < 0.25, ratio, 1.0)
        return {"rho": rho, "P": 1.0, "v": FLIGHT, "B": [0.0, B, 0.0]}

    return Problem(BOX, jitter(hexagonal(BOX, nx), BOX, 0.05), start, 0.5, density=SumVolume())


def spacings(ratio: float, nx: int) -> Problem:
    """A tube of equal masses, rho and P `ratio` times higher on the left: spacing and h jump as much."""
    step = step_lattice((-0.5, 0.5), nx, (ratio, 1.0))

    def start(x):
        left = x[:, 0] < 0
        zero = np.zeros(len(x))
        B = np.stack([zero + 0.5, np.where(left, 0.5, -0.5), zero], axis=1)
        return {"rho": np.where(left, ratio, 1.0), "P": np.where(left, ratio, 1.0), "B": B, "mass": step.mass}

    walls = Boundary(x=Reflecting())
    return Problem(((step.box.lo[0], step.box.hi[0]),), step.positions, start, 0.1, boundary=walls)


def struck(ratio: float, nx: int) -> Problem:
    """A shock runs through light gas into gas `ratio` times heavier, particle by particle."""
    box = ((-0.5, 0.5),)

    def start(x):
        rho, P = np.where(x[:, 0] > 0.1, ratio, 1.0), np.where(x[:, 0] < -0.2, 100.0, 1.0)
        return {"rho": rho, "P": P, "B": [0.0, 0.5, 0.0]}

    walls = Boundary(x=Reflecting())
    return Problem(box, line(box, nx), start, 0.1, boundary=walls, density=SumVolume())


def pressures(ratio: float, nx: int) -> Problem:
    """A tube of one density, the pressure `ratio` times higher on the left."""
    box = ((-0.5, 0.5),)

    def start(x):
        return {"rho": 1.0, "P": np.where(x[:, 0] < 0, ratio, 1.0)}

    return Problem(box, line(box, nx), start, 0.1 / np.sqrt(ratio), boundary=Boundary(x=Reflecting()))


WALLED = Limits(energy=0.02, momentum=inf, close=0.02)  # walls take momentum

CASES = (
    Case("mass_ratio", "a slab of heavier particles flies through the box, density by volume", "ratio", masses,
         (8.0, 100.0), (1e3, 1e5), (48, 28)),
    Case("density_jump", "a shock runs into gas that is heavier, density by volume", "ratio", struck,
         (100.0, 1e4), (1e6, 1e8), (200, 100), WALLED),
    Case("h_ratio", "a magnetised tube of equal masses, rho and P jump together", "ratio", spacings,
         (10.0, 100.0), (200.0, 400.0), (400, 200), WALLED),
    Case("pressure_jump", "a tube of one density, the pressure jumps", "ratio", pressures,
         (1e3, 1e6, 3e10), (1e13, 1e16), (200, 100), WALLED),
)  # fmt: skip
