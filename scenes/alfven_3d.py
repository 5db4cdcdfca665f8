"""The Alfven wave in three dimensions: it clumps without xi there too.

Circularly polarised, oblique to every axis. Lecture pp. 15-20; Gardiner & Stone 2008. As alfven_tensile: xi = 0 clumps
into sheets across B, xi = 1/2 does not. The picture is a slice through the middle. It costs about 15 s on two cores.

    spmhd run alfven_3d --set nx=32
"""

import numpy as np

from taichi_spmhd import Adiabatic, Picture, Scene, close_packed, exact
from taichi_spmhd.terms import DivBSource, Induction, Resistivity, Stress, Viscosity

BOX = ((-1.5, 1.5), (-0.75, 0.75), (-0.75, 0.75))  # one wavelength along the diagonal
K_HAT = exact.direction(np.arcsin(2 / np.sqrt(5)), np.arcsin(2 / 3))  # (1, 2, 2)/3


def scenes(nx: int = 32, beta: float = 0.2, amplitude: float = 0.1, t_end: float = 1.0):
    """The same wave, without and with the remedy. nx: particles along the longest side."""

    def wave(x, t):
        return exact.alfven_wave(x, t, K_HAT, amplitude, pressure=0.5 * beta)

    bare = Scene(
        box=BOX,
        positions=close_packed(BOX, nx),
        start=lambda x: wave(x, 0.0),
        eos=Adiabatic(5 / 3),
        terms=(Stress(), Induction(), Viscosity(alpha=0.1, beta=0.0), Resistivity()),
        t_end=t_end,
        exact=wave,
        measure="B_z",
        picture=Picture("B", axis=2, draw="particles", gaps=True),
    )
    return {"xi = 0": bare, "xi = 1/2": bare.plus(DivBSource(xi=0.5))}
