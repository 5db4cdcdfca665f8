"""Blast waves in strong fields, explosions and implosions."""

import numpy as np

from ...boundary import Boundary
from ...lattice import close_packed, hexagonal
from ...library import load_scene
from ..case import SHOCKED, Case, Problem

RATIOS = {0.2: 1e2, 2e-2: 1e3, 2e-4: 1e5}  # of the pressures, by beta outside; below 2e-4 as there


def blast(beta: float, ratio: float, nx: int, dim: int = 2) -> Problem:
    """P = beta/2 in a field B = 1 along the diagonal, `ratio` times that within 0.125; sound crosses the box once."""
    box = ((-0.5, 0.5),) * dim
    field = np.array([1.0, 1.0, 0.0 if dim == 2 else 1.0]) / np.sqrt(dim)
    inside, outside = 0.5 * beta * ratio, 0.5 * beta

    def start(x):
        return {"rho": 1.0, "P": np.where((x**2).sum(axis=1) < 0.125**2, inside, outside), "B": field}

    x = (hexagonal if dim == 2 else close_packed)(box, nx)
    return Problem(box, x, start, 1 / np.sqrt(1 + 5 / 3 * inside))


def noh(P: float, nx: int) -> Problem:
    """Noh's implosion of cold gas with a field along z, which it squeezes with itself."""
    scene = load_scene("noh", nx=nx)["noh"]

    def start(x):
        return {**scene.start(x), "P": P, "B": [0.0, 0.0, 0.05]}

    return Problem(scene.box, scene.positions, start, 0.6, boundary=Boundary())


def sedov(u: float, nx: int) -> Problem:
    """Sedov's explosion into cold gas with a weak field along x."""
    scene = load_scene("sedov", nx=nx)["sedov"]

    def start(x):
        given = scene.start(x)
        return {**given, "u": given["u"] - given["u"].min() + u, "B": [0.1, 0.0, 0.0]}

    return Problem(scene.box, scene.positions, start, scene.t_end)


CASES = (
    Case("blast_beta", "a blast in a strong field, the pressures 1e2 to 1e5 apart", "beta outside",
         lambda beta, nx: blast(beta, RATIOS.get(beta, 1e5), nx), (0.2, 2e-2, 2e-4, 2e-6), (2e-8, 2e-12), (64, 32),
         SHOCKED),
    Case("blast_ratio", "a blast at beta = 0.2 outside, pressures further and further apart", "ratio",
         lambda ratio, nx: blast(0.2, ratio, nx), (1e2, 1e3, 1e4, 1e5), (1e7, 1e10), (64, 32), SHOCKED),
    Case("blast_3d", "a blast in three dimensions, pressures 100 apart", "beta outside",
         lambda beta, nx: blast(beta, 1e2, nx, 3), (0.2, 2e-2, 2e-4), (2e-6, 2e-8), (24, 14), SHOCKED),
    Case("noh", "Noh's implosion of cold gas with a field along z", "P", noh, (1e-3, 1e-6), (1e-9, 1e-15), (60, 32),
         SHOCKED),
    Case("sedov", "Sedov's explosion into cold gas with a weak field", "u ahead", sedov, (1e-3, 1e-6), (1e-9, 1e-15),
         (64, 32), SHOCKED),
)  # fmt: skip
