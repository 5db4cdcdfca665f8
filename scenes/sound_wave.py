"""A linear sound wave: what is wrong after one period is the scheme's own.

Amplitude 1e-4, c_s = 1, period 1, no dissipation. The error falls with 1/N^2 until the kernel's bias shows; the
quintic spline keeps falling, the cubic does not. It costs about 2 s on two cores.

    spmhd run sound_wave --set nx=64
"""

import numpy as np

from taichi_spmhd import Adiabatic, Boundary, Periodic, Picture, QuinticSpline, Scene, SumMass, displaced, exact, line
from taichi_spmhd.terms import Pressure

BOX = (1.0,)


def scenes(nx: int = 64, amplitude: float = 1e-4, t_end: float = 1.0):
    """nx: particles a wavelength."""
    colours = 1.2 * abs(amplitude) or 1e-4
    scene = Scene(
        box=BOX,
        positions=displaced(line(BOX, nx), BOX, lambda x: 1 + amplitude * np.sin(2 * np.pi * x)),
        start=lambda x: {"mass": 1.0 / nx, **exact.sound_wave(x, 0.0, amplitude)},
        eos=Adiabatic(5 / 3),
        kernel=QuinticSpline(),
        density=SumMass(tolerance=1e-10),
        boundary=Boundary(x=Periodic()),
        terms=(Pressure(),),
        t_end=t_end,
        exact=lambda x, t: exact.sound_wave(x, t, amplitude),
        measure="v_x",
        picture=Picture("v", axis=0, limits=(-colours, colours)),
    )
    return {"sound wave": scene}
