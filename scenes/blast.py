"""Blast wave in a gas without a field: a hot disc drives a circular shock.

Lecture pp. 7-11. rho = 1; P = 10 inside r = 0.1, 0.1 outside. At t = 0.2 the shock stands at r = 0.441 and the contact
at r = 0.279 (grid run, Athena++ 512^2). No magnetic field is listed, so none is stored or computed. scheme=godunov has
no artificial dissipation: shocks heat through Riemann problems, and the energy is kept to 1e-15 (standard: 4e-5). It
costs about 15 s on two cores.

    spmhd run blast --set nx=64
    spmhd run blast --set scheme=godunov
"""

import numpy as np

from taichi_spmhd import STIRRED, Adiabatic, Picture, Scene, Scheme, hexagonal, in_scheme
from taichi_spmhd.terms import Conductivity, Pressure, Viscosity

BOX = ((-0.5, 0.5), (-0.5, 0.5))
RADIUS, P_IN, P_OUT = 0.1, 10.0, 0.1


def start(x):
    """The hot disc; x has shape (N, 2)."""
    return {"rho": 1.0, "P": np.where((x**2).sum(axis=1) < RADIUS**2, P_IN, P_OUT)}


def scenes(nx: int = 128, t_end: float = 0.2, scheme: Scheme = "standard"):
    """The blast with artificial viscosity and conductivity."""
    scene = Scene(
        box=BOX,
        positions=hexagonal(BOX, nx),
        start=start,
        eos=Adiabatic(5 / 3),
        terms=(Pressure(), Viscosity(), Conductivity()),
        t_end=t_end,
        picture=Picture("rho", limits=(0.0, 3.0), draw="sph"),
    )
    return in_scheme({"blast": scene}, scheme, **STIRRED)
