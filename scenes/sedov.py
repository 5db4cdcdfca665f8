"""Sedov's explosion: a shock whose radius is known exactly.

Sedov 1959: rho = 1, energy E = 1 within a kernel of the centre, hardly any pressure elsewhere. The shock is at
R = xi0 (E t^2/rho)^(1/(d+2)), exact.sedov_radius; the run ends where that is 0.4. Look at the thin shell, exactly
(gamma + 1)/(gamma - 1) = 4 times denser than the gas ahead, smeared here over a kernel. It costs about 10 s on two
cores.

    spmhd run sedov --set nx=64
    spmhd run sedov --set dim=3 nx=40
"""

from typing import Literal

import numpy as np

from taichi_spmhd import Adiabatic, InputError, Picture, QuinticSpline, Scene, close_packed, exact, hexagonal, jitter
from taichi_spmhd.terms import Conductivity, Pressure, Viscosity

HALF = 0.5
RADIUS = 0.4  # of the shock at the end
NOISE = 0.1  # of the positions, in spacings: on a perfect lattice the shock bulges along its rows
U_AHEAD = 1e-6  # of the gas ahead of the shock: cold


def scenes(nx: int = 100, dim: Literal[2, 3] = 2, gamma: float = 5 / 3, energy: float = 1.0, spread: float = 2.0):
    """spread: radius of the hot spot in smoothing lengths, over which the energy is smeared as in a kernel."""
    if not (energy > 0 and spread > 0):
        raise InputError(f"energy = {energy:g} and spread = {spread:g} must be positive, for example energy=1 spread=2")
    box = ((-HALF, HALF),) * dim
    x = jitter((hexagonal if dim == 2 else close_packed)(box, nx), box, NOISE)
    mass, kernel = 1 / len(x), QuinticSpline()
    share = np.exp(-(x**2).sum(axis=1) / (spread * kernel.h_fact * mass ** (1 / dim)) ** 2)
    u = U_AHEAD + energy * share / (mass * share.sum())
    scene = Scene(
        box=box,
        positions=x,
        start=lambda x: {"rho": 1.0, "mass": mass, "u": u},
        eos=Adiabatic(gamma),
        kernel=kernel,
        terms=(Pressure(), Viscosity(), Conductivity()),
        t_end=exact.sedov_time(RADIUS, gamma, dim, energy),
        exact=lambda x, t: exact.sedov(x, t, gamma, energy),
        measure="rho",
        picture=Picture("rho", limits=(0.0, 3.0), draw="sph" if dim == 2 else "particles"),
    )
    return {"sedov": scene}
