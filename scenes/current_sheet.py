"""Two bent current sheets decay; without xi the lattice breaks and the field is gone.

Hawley & Stone 1995; Gardiner & Stone 2005. B_y flips at x = 1/2 and 3/2, P = 0.1 (beta = 0.2), and v_x = 0.1 cos pi y
bends the sheets. No solution is known: a scheme must survive, and turn into heat what the field loses. With
resistivity the sheets widen evenly. Without it nothing reconnects on purpose: neighbours carry opposite fields side by
side, shuffled by the force that their div B exerts, and the ledger shows the energy this takes. At xi = 0 the tensile
instability stirs all of the gas, and resistivity eats nine tenths of the field. It costs about 60 s on two cores.

    spmhd run current_sheet --set nx=32
"""

import numpy as np

from taichi_spmhd import Adiabatic, Picture, QuinticSpline, Scene, hexagonal
from taichi_spmhd.terms import Conductivity, CullenDehnen, DivBSource, Induction, Resistivity, Stress

BOX = (2.0, 2.0)
P, B0, BEND = 0.1, 1.0, 0.1


def start(x):
    """B_y = -1 between the sheets, 1 outside; x has shape (N, 2)."""
    zero = np.zeros(len(x))
    B_y = np.where(np.abs(x[:, 0] - 1) < 0.5, -B0, B0)
    v_x = BEND * np.cos(np.pi * x[:, 1])
    return {"rho": 1.0, "P": P, "v": np.stack([v_x, zero, zero], axis=1), "B": np.stack([zero, B_y, zero], axis=1)}


def scenes(nx: int = 64, t_end: float = 5.0):
    """Without xi, without resistivity, and with both."""
    bare = Scene(
        box=BOX,
        positions=hexagonal(BOX, nx),
        start=start,
        eos=Adiabatic(5 / 3),
        kernel=QuinticSpline(),
        terms=(Stress(), Induction(), CullenDehnen(), Conductivity()),
        t_end=t_end,
        picture=Picture("B", axis=1, limits=(-1.2, 1.2), draw="nearest"),
    )
    cured = bare.plus(DivBSource(xi=0.5))
    return {
        "xi = 0": bare.plus(Resistivity()),
        "without resistivity": cured,
        "with resistivity": cured.plus(Resistivity()),
    }
