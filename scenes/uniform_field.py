"""A uniform field in a gas at rest: at xi = 0 the lattice tears itself up.

Nothing should happen, and with xi >= 1/2 nothing does. Lecture pp. 15-20; physics of the growth: omega^2 = k^2 W
[c_s^2 W + 2 (P + (xi - 1/2) B^2)/rho (1 - W)] for waves along B, W the kernel's Fourier transform. Unstable for xi <
(1 - beta)/2, growing by e every 0.8 dx/v_A at beta = 0.1. Nothing dissipates here, so that the growth can be measured.
It costs about 5 s on two cores.

    spmhd run uniform_field --set beta=0.1 xi=0.5
"""

from typing import Literal

import numpy as np

from taichi_spmhd import Adiabatic, Picture, Scene, hexagonal, jitter, square
from taichi_spmhd.terms import DivBSource, Induction, Stress

B0 = 1.0  # with rho = 1 the Alfven speed is 1


def scenes(
    nx: int = 32,
    beta: float = 0.1,
    xi: float = 0.0,
    angle: float = 0.0,
    lattice: Literal["hexagonal", "square"] = "hexagonal",
    noise: float = 1e-3,
    seed: int = 0,
    duration: float = 15.0,
):
    """angle: of B against the rows, degrees; noise: of the positions, in spacings; duration: in dx/v_A."""
    dx = 1.0 / nx
    rows = 2 * round(nx / np.sqrt(3))
    box = (1.0, rows * np.sqrt(0.75) * dx) if lattice == "hexagonal" else (1.0, 1.0)
    positions = (hexagonal if lattice == "hexagonal" else square)(box, nx)
    field = B0 * np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle)), 0.0])
    scene = Scene(
        box=box,
        positions=jitter(positions, box, noise, seed) if noise else positions,
        start=lambda x: {"rho": 1.0, "P": 0.5 * beta * B0**2, "B": field},
        eos=Adiabatic(5 / 3),
        terms=(Stress(), Induction(), *((DivBSource(xi=xi),) if xi else ())),
        t_end=duration * dx / B0,
        picture=Picture("rho", limits=(0.5, 2.0), draw="particles", gaps=True),
    )
    return {f"xi = {xi:g}": scene}
