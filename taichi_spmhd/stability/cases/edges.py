"""Edges: free surfaces, and what is known to break divergence cleaning."""

import numpy as np

from ...boundary import Boundary
from ...lattice import hexagonal
from ...library import load_scene
from ..case import Case, Problem


def disc(time: float, nx: int) -> Problem:
    """A disc of magnetised gas flies apart into vacuum, for `time` of its crossing times of sound."""
    lattice = hexagonal(((-1.0, 1.0), (-1.0, 1.0)), nx)
    x = lattice[np.hypot(*lattice.T) < 0.8]
    given = {"rho": 1.0, "P": 0.6, "B": [0.0, 0.5, 0.0], "mass": 4.0 / len(lattice)}
    return Problem(((-1.0, 1.0),) * 2, x, lambda x: given, 0.8 * time, boundary=Boundary())


def peak(case: str, nx: int) -> Problem:
    """The scene divergence_peak: a bump of div B where cleaning has been seen to fail."""
    scene = load_scene("divergence_peak", nx=nx, case=case)["per-particle c_h"]
    extra = tuple(term for term in scene.terms if type(term).__name__ == "Hesitation")
    sides = tuple(zip(scene.box.lo, scene.box.hi, strict=True))
    return Problem(sides, scene.positions, scene.start, scene.t_end, boundary=scene.boundary, extra=extra)


CASES = (
    Case("free_surface", "a magnetised disc flies apart into vacuum", "crossing times", disc, (1.0, 3.0), (5.0, 10.0),
         (48, 24)),
    Case("divergence_peak", "a bump of div B: where dt, density or a surface jump", "where", peak,
         ("static", "localised", "density", "jump", "free"), (), (50, 30),
         quick=("density", "free")),
)  # fmt: skip
