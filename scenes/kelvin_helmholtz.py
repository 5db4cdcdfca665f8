"""Kelvin-Helmholtz: a shear layer rolls up, and a field along the flow holds it straight.

Smooth layers after McNally et al. 2012 and Robertson et al. 2010: a band of rho = 2 moves at +1/2 through gas of
rho = 1 at -1/2, v_y = 0.1 sin 2 pi x. Without a field a billow a layer grows, by e in 0.58 while it is small. A weak
field along the flow is wound up instead: its energy doubles by t = 2, and the billow stays behind. A strong one,
v_A >= dv/2, stiffens the layer, and the wave only swings (Chandrasekhar 1961). scheme=godunov conducts no heat: at nx =
40 rho still spans 0.97..2.13 at t = 2 (standard: 1.06..2.06). It costs about 100 s on two cores.

    spmhd run kelvin_helmholtz --set nx=64
    spmhd run kelvin_helmholtz --set nx=64 scheme=godunov
"""

import numpy as np

from taichi_spmhd import (
    STIRRED,
    Adiabatic,
    InputError,
    Picture,
    QuinticSpline,
    Scene,
    Scheme,
    displaced,
    hexagonal,
    in_scheme,
)
from taichi_spmhd.terms import Conductivity, CullenDehnen, DivBSource, Induction, Pressure, Resistivity, Stress

BOX = (1.0, 1.0)
P, GAMMA = 2.5, 5 / 3
THICKNESS = 0.05  # of the layers at y = 1/4 and 3/4


def band(y):
    """0 outside and 1 inside 1/4 < y < 3/4, smooth; y of any shape."""
    return 1 / (1 + np.exp(-2 * (y - 0.25) / THICKNESS)) / (1 + np.exp(-2 * (0.75 - y) / THICKNESS))


def scenes(
    nx: int = 100, contrast: float = 2.0, amplitude: float = 0.1, weak: float = 0.2, strong: float = 0.8,
    t_end: float = 2.0, scheme: Scheme = "standard",
):  # fmt: skip
    """Without a field, with a weak and with a strong one. contrast: density of the band against the gas outside."""
    if not contrast > 0:
        raise InputError(f"contrast = {contrast} is a ratio of densities: give a number above 0, for instance 2")

    def rho(y):
        return 1 + (contrast - 1) * band(y)

    def start(x, B0):
        v = np.stack([band(x[:, 1]) - 0.5, amplitude * np.sin(2 * np.pi * x[:, 0]), np.zeros(len(x))], axis=1)
        return {"rho": rho(x[:, 1]), "mass": mass, "P": P, "v": v, **({"B": [B0, 0.0, 0.0]} if B0 else {})}

    positions = displaced(hexagonal(BOX, nx), BOX, rho, axis=1)
    mass = rho(np.linspace(0, 1, 1000, endpoint=False)).mean() / len(positions)
    magnetic = (Stress(), Induction(), DivBSource(xi=0.5), Resistivity())

    def scene(B0):
        return Scene(
            box=BOX,
            positions=positions,
            start=lambda x: start(x, B0),
            eos=Adiabatic(GAMMA),
            kernel=QuinticSpline(),
            terms=(*(magnetic if B0 else (Pressure(),)), CullenDehnen(), Conductivity()),
            t_end=t_end,
            picture=Picture("rho", limits=(0.9, 2.1), draw="sph"),
        )

    variants = {f"B = {B0:g}": scene(B0) for B0 in (0, weak, strong)}
    return in_scheme(variants, scheme, **STIRRED)
