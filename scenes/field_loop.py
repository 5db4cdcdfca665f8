"""A weak field loop is carried along unchanged, unless noise lets resistivity eat it.

Gardiner & Stone 2005. A_z = 1e-3 (0.3 - r) in a gas that moves at (2, 1, 0.22), through the box in t = 1; beta is 2e6,
so the field is a passenger. Grid codes diffuse it at the centre and rim, and make B_z where div B is not zero.
Particles carry B/rho along: on the lattice nothing changes, and resistivity does nothing where neighbours move alike
(v_B = |v_ij x e|). Positions 5 % off the lattice stir the gas at less than 1 % of c_s: still nothing is lost without
resistivity, but a fifth of <B^2> in two crossings with it. It costs about 30 s on two cores.

    spmhd run field_loop --set nx=32 t_end=20
"""

import numpy as np

from taichi_spmhd import Adiabatic, Picture, QuinticSpline, Scene, hexagonal, jitter
from taichi_spmhd.terms import CullenDehnen, DivBSource, Induction, Resistivity, Stress

LOWER, SIZE = np.array([-1.0, -0.5]), np.array([2.0, 1.0])
BOX = ((-1.0, 1.0), (-0.5, 0.5))
VELOCITY = np.array([2.0, 1.0, 0.1 * np.sqrt(5)])
RADIUS, B0 = 0.3, 1e-3


def loop(x, t):
    """B of the loop after a time t; x has shape (N, 2)."""
    q = LOWER + np.mod(x - t * VELOCITY[:2] - LOWER, SIZE)
    r = np.hypot(q[:, 0], q[:, 1])
    strength = np.where(r < RADIUS, B0 / np.maximum(r, 1e-12), 0.0)
    return {"B": np.stack([-strength * q[:, 1], strength * q[:, 0], np.zeros_like(r)], axis=1)}


def scenes(nx: int = 64, noise: float = 0.05, seed: int = 0, t_end: float = 2.0):
    """A lattice, and positions with Gaussian noise (in spacings), without and with resistivity."""
    lattice = hexagonal(BOX, nx)
    bare = Scene(
        box=BOX,
        positions=jitter(lattice, BOX, noise, seed),
        start=lambda x: {"rho": 1.0, "P": 1.0, "v": VELOCITY, **loop(x, 0.0)},
        eos=Adiabatic(5 / 3),
        kernel=QuinticSpline(),
        terms=(Stress(), Induction(), DivBSource(xi=0.5), CullenDehnen()),
        t_end=t_end,
        exact=loop,
        measure="B_x",
        picture=Picture("B", limits=(0.0, 1.2e-3), draw="nearest"),
    )
    return {
        "lattice, with resistivity": bare.plus(Resistivity()).but(positions=lattice),
        "noise, without resistivity": bare,
        "noise, with resistivity": bare.plus(Resistivity()),
    }
