"""Alfven wave: particles clump along B unless the div B force is removed.

Circularly polarised, at 30 degrees to the x axis (lecture pp. 15-20; Toth 2000). P = 0.1 and B = 1, so P - B^2/2 < 0:
neighbours along the field attract each other, the tensile instability. xi = 0 shows it from t about 0.4: rows of
particles draw together into sheets perpendicular to B. xi = 1/2 and xi = 1 cure it. Smaller beta clumps harder. The
wave has no shocks: a weak viscosity is enough. scheme=godunov has no viscosity at all and tells the same story: with
xi = 1/2 B errs by 2.1e-3 after a period (5e-4 at nx = 64). It costs about 10 s on two cores.

    spmhd run scenes/alfven_tensile.py
    spmhd run alfven_tensile --set scheme=godunov
"""

import numpy as np

from taichi_spmhd import (
    Adiabatic,
    Anchor,
    Picture,
    QuinticSpline,
    Scene,
    Scheme,
    Study,
    exact,
    hexagonal,
    in_scheme,
    jitter,
)
from taichi_spmhd.terms import DivBSource, Induction, Resistivity, Stress, Viscosity

ANGLE = np.radians(30)  # wave vector and mean field against the x axis
BOX = (1 / np.cos(ANGLE), 1 / np.sin(ANGLE))  # one wavelength fits each side
NOISE = 1e-7  # of the positions, in spacings: a perfect lattice would clump in perfect rows, at the mercy of round-off
B_PARALLEL = 1.0  # v_A = 1: the wave comes back to its start after t = 1

# For `spmhd cost`. One period; the other codes' resolutions are cells or spacings of their own, their seconds those of
# one thread of their own machine. Only the particle code's wave is this one to the letter; the grid code's runs at 63
# degrees to its rows of cells and its error is the root of the sum over components of squared L1 norms.
STUDY = Study(
    {"nx": (16, 32, 64), "kernel": ("cubic", "quintic", "wendland_c6"), "precision": ("f64", "f32")},
    variants=("xi = 1/2",),
    error="B",
    anchors=(
        Anchor(
            "SPMHD in Fortran (other machine)",
            ((32, 1.1, 4.4e-3), (64, 9.1, 1.05e-3), (128, 68.0, 2.2e-4)),
            "an established SPMHD code in Fortran, spacings a wavelength, one thread of an AVX-512 core (AMD Zen 5)",
        ),
        Anchor(
            "grid code Athena++ (other machine)",
            (
                (16, 1.512e-3, 4.22e-2),
                (32, 8.939e-3, 1.00e-2),
                (64, 5.733e-2, 3.30e-3),
                (128, 0.4442, 7.97e-4),
                (256, 3.598, 1.86e-4),
            ),
            "Athena++ (HLLD, constrained transport, PLM, VL2, CFL 0.4), N x N/2 cells, one thread, wave at 63 degrees",
        ),
    ),
)


def scenes(nx: int = 32, beta: float = 0.2, amplitude: float = 0.1, t_end: float = 1.0, scheme: Scheme = "standard"):
    """The same wave, without and with the remedy. beta = 2P/B^2 of the mean field."""

    def wave(x, t):
        return exact.alfven_wave(
            x, t, exact.direction(ANGLE), amplitude, pressure=0.5 * beta * B_PARALLEL**2, B_parallel=B_PARALLEL
        )

    colours = 1.2 * abs(amplitude) or 0.1
    bare = Scene(
        box=BOX,
        positions=jitter(hexagonal(BOX, nx), BOX, NOISE, seed=0),
        start=lambda x: wave(x, 0.0),
        eos=Adiabatic(5 / 3),
        terms=(Stress(), Induction(), Viscosity(alpha=0.1, beta=0.0), Resistivity()),
        t_end=t_end,
        exact=wave,
        measure="B_z",
        picture=Picture("B", axis=2, limits=(-colours, colours), draw="particles", gaps=True),
    )
    variants = {
        "xi = 0": bare,
        "xi = 1/2": bare.plus(DivBSource(xi=0.5)),
        "xi = 1": bare.plus(DivBSource(xi=1.0)),
    }
    return in_scheme(variants, scheme, kernel=QuinticSpline(h_fact=0.9), cour=0.4)
