"""Sod's shock tube: a rarefaction, a contact and a shock.

Sod 1978; states 1, 0, 1 and 0.125, 0, 0.1, gamma = 1.4, t = 0.2. Exact plateaus: P = 0.30313, v = 0.92745, rho =
0.42632 and 0.26557. dim=2 is a strip, periodic across. Equal masses: the dense side has 8 times as many particles a
length. scheme=godunov has no viscosity or conductivity: rho errs by 0.7 % (standard: 0.6), and the ledger's energy is
exact for any step. It costs about 3 s on two cores.

    spmhd run sod
    spmhd run sod --set scheme=godunov
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
    Study,
    exact,
    in_scheme,
    step_lattice,
)
from taichi_spmhd.terms import Conductivity, Pressure, Viscosity

LEFT, RIGHT, GAMMA = (1.0, 0.0, 1.0), (0.125, 0.0, 0.1), 1.4  # rho, v, P
ROWS = 24  # of the dense side in 2-D: 16 would be narrower than two kernel supports on the thin side
SUPPORTS = 4  # thickness of the frozen ends in supports of the thin side
STUDY = Study(  # for `spmhd cost`
    {
        "nx": (225, 450, 900, 1800),
        "kernel": ("cubic", "quintic", "wendland_c4"),
        "scheme": ("standard", "godunov"),
    }
)


def scenes(nx: int = 450, dim: Literal[1, 2] = 1, t_end: float = 0.2, scheme: Scheme = "standard"):
    """nx: particles along x, both sides together."""
    lattice = step_lattice((-0.5, 0.5), nx, (LEFT[0], RIGHT[0]), rows=None if dim == 1 else ROWS)
    kernel = QuinticSpline()
    thin = kernel.support * kernel.h_fact * (lattice.mass / RIGHT[0]) ** (1 / dim)
    ends = Frozen(min(SUPPORTS * thin, 0.12))

    def start(x):
        left = x[:, 0] < 0
        return {
            "rho": np.where(left, LEFT[0], RIGHT[0]),
            "P": np.where(left, LEFT[2], RIGHT[2]),
            "mass": lattice.mass,
        }

    scene = Scene(
        box=lattice.box,
        positions=lattice.positions,
        start=start,
        eos=Adiabatic(GAMMA),
        kernel=kernel,
        boundary=Boundary(x=ends, y=Periodic()),
        terms=(Pressure(), Viscosity(), Conductivity()),
        t_end=t_end,
        exact=lambda x, t: exact.sod(x, t, LEFT, RIGHT, GAMMA),
        measure="rho",
        picture=Picture("rho", limits=(0.0, 1.1)),
    )
    return in_scheme({"sod": scene}, scheme, slope="own")
