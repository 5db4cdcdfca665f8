"""A sound pulse along a strong field: xi = 1/2 carries it at c_s, xi = 1 breaks it into short fast waves.

Lecture p. 20; Iwasaki 2015, section 5.1. Sound along B does not feel the field: a Gaussian pulse of v_x splits into two
halves that keep their shape and run at +-c_s. At beta = 0.1 xi = 1/2 does so within a percent. With xi = 1 the stress
along B is P + B^2/2 instead of P, and waves of a few spacings run up to 2.4 times too fast: a train of ripples ahead of
the pulse. With xi = 0 it is negative and the gas clumps. Nothing dissipates, but for the viscosity that lets xi = 0 survive. It costs about 10 s on two cores.

    spmhd run solitary_wave --set nx=192 beta=0.01
"""

from math import sqrt

from taichi_spmhd import Adiabatic, Picture, QuinticSpline, Scene, exact, hexagonal
from taichi_spmhd.terms import DivBSource, Induction, Stress, Viscosity

HALF, ROWS = 2.0, 16  # half the length of the box; rows across: room for the kernels of clumped gas
RHO, P, GAMMA = 1.0, 1.0, 5 / 3
C_S = sqrt(GAMMA * P / RHO)


def scenes(nx: int = 96, beta: float = 0.1, amplitude: float = 0.01, width: float = 3.0, t_end: float = 0.6):
    """amplitude: of the pulse in v_x; width: exp(-(x/w)^2) with w in smoothing lengths; beta = 2P/B^2."""
    dx = 2 * HALF / nx
    box = ((-HALF, HALF), (0.0, ROWS * sqrt(0.75) * dx))
    kernel = QuinticSpline()
    w = width * kernel.h_fact * sqrt(sqrt(0.75)) * dx  # h = h_fact sqrt(m/rho) of a hexagonal lattice
    B0 = sqrt(2 * P / beta)

    def pulse(x, t):
        return exact.sound_pulse(x, t, amplitude, w, RHO, P, GAMMA, B0, period=2 * HALF)

    bare = Scene(
        box=box,
        positions=hexagonal(box, nx),
        start=lambda x: pulse(x, 0.0),
        eos=Adiabatic(GAMMA),
        kernel=kernel,
        terms=(Stress(), Induction()),
        t_end=t_end,
        exact=pulse,
        measure="v_x",
        picture=Picture("v", axis=0, limits=(-0.7 * amplitude, 1.1 * amplitude)),
    )
    return {
        "xi = 0": bare.plus(Viscosity()),  # clumps fall onto each other: without it the run ends there
        "xi = 1/2": bare.plus(DivBSource(xi=0.5)),
        "xi = 1": bare.plus(DivBSource(xi=1.0)),
    }
