"""Noh's implosion: cold gas falls inwards and stops behind a shock.

Noh 1987, JCP 72, 78: rho = 1, v_r = -1, P = 1e-6, gamma = 5/3. Exact: behind R = t/3 the gas is at rest with rho = 16
(64 in 3-D), ahead of it rho = 1 + t/r (squared in 3-D). Look at the centre: viscosity heats too much there, and
conduction carries it away only slowly (wall heating). The gas is a disc with vacuum outside, whose edge stays ahead of
the shock. It costs about 15 s on two cores.

    spmhd run noh --set nx=100
"""

from typing import Literal

import numpy as np

from taichi_spmhd import Adiabatic, Boundary, Picture, QuinticSpline, Scene, close_packed, exact, hexagonal
from taichi_spmhd.terms import Conductivity, Pressure, Viscosity

RADIUS = 1.0  # of the gas at the start
GAMMA, P = 5 / 3, 1e-6


def scenes(nx: int = 100, dim: Literal[2, 3] = 2, t_end: float = 0.6):
    """nx: particles across the disc or ball."""
    box = ((-RADIUS, RADIUS),) * dim
    lattice = (hexagonal if dim == 2 else close_packed)(box, nx)
    mass = (2 * RADIUS) ** dim / len(lattice)
    x = lattice[np.linalg.norm(lattice, axis=1) < RADIUS]

    def start(x):
        return {**exact.noh(x, 0.0, GAMMA), "P": P, "mass": mass}

    scene = Scene(
        box=box,
        positions=x,
        start=start,
        eos=Adiabatic(GAMMA),
        kernel=QuinticSpline(),
        boundary=Boundary(),
        terms=(Pressure(), Viscosity(), Conductivity()),
        t_end=t_end,
        exact=lambda x, t: exact.noh(x, t, GAMMA),
        measure="rho",
        picture=Picture("rho", limits=(0.0, 18.0), draw="particles"),
    )
    return {"noh": scene}
