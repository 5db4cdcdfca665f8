"""Brio & Wu's tube: a compound wave that codes find and theory shuns.

Brio & Wu 1988, JCP 75, 400: states rho 1, P 1, B_y 1 and 0.125, 0.1, -1, B_x = 0.75, gamma = 2, t = 0.1. From the
left: a fast rarefaction, the slow compound wave (a shock with a rarefaction behind it) where B_y passes zero, the
contact, a slow shock, a fast rarefaction. B_y could also turn through a rotation and a slow shock; codes that capture
shocks, on grids and with particles, give the compound wave (the peak of rho at x = -0.03), and so the reference of the
tests is a grid run of 8192 cells. With scheme=godunov B_x is not uniform by itself: at the contact it runs from 0.47 to
0.86, with cleaning from 0.745 to 0.753 there and 0.72 to 0.82 in all. It costs about 5 s on two cores.

    spmhd run brio_wu --set show=B_y
    spmhd run brio_wu --set scheme=godunov show=B_x
"""

from typing import Literal

import numpy as np

from taichi_spmhd import (
    Adiabatic,
    Boundary,
    Frozen,
    Periodic,
    Picture,
    QuinticSpline,
    Scene,
    Scheme,
    in_scheme,
    step_lattice,
)
from taichi_spmhd.terms import Cleaning, Conductivity, DivBSource, Induction, Resistivity, Stress, Viscosity

LEFT, RIGHT = (1.0, 1.0, 1.0), (0.125, 0.1, -1.0)  # rho, P, B_y
B_X, GAMMA = 0.75, 2.0
ROWS, END = 34, 0.1  # rows of the dense side in 2-D; thickness of the frozen ends
LIMITS = {
    "rho": (0.0, 1.1),
    "P": (0.0, 1.1),
    "v_x": (-0.4, 0.8),
    "v_y": (-1.8, 0.2),
    "B_x": (0.6, 0.9),
    "B_y": (-1.2, 1.2),
}


def scenes(
    nx: int = 800, dim: Literal[1, 2] = 1, xi: float = 0.5, show: Literal[tuple(LIMITS)] = "rho",
    scheme: Scheme = "standard",
):  # fmt: skip
    """nx: particles along x, both sides together; show: what is drawn."""
    lattice = step_lattice((-0.5 - END, 0.5 + END), nx, (LEFT[0], RIGHT[0]), rows=ROWS if dim == 2 else None)

    def start(x):
        rho, P, By = np.where(x[:, :1] < 0, LEFT, RIGHT).T
        B = np.stack([np.full(len(x), B_X), By, 0 * By], axis=1)
        return {"rho": rho, "P": P, "B": B, "mass": lattice.mass}

    member, _, axis = show.partition("_")
    bare = Scene(
        box=lattice.box,
        positions=lattice.positions,
        start=start,
        eos=Adiabatic(GAMMA),
        kernel=QuinticSpline(),
        boundary=Boundary(x=Frozen(END), y=Periodic()),
        terms=(Stress(), Induction(), DivBSource(xi=xi), Viscosity(), Conductivity(), Resistivity()),
        t_end=0.1,
        picture=Picture(member, axis="xyz".index(axis) if axis else None, limits=LIMITS[show]),
    )
    variants = {"without cleaning": bare, "with cleaning": bare.plus(Cleaning())}
    return in_scheme(variants, scheme)
