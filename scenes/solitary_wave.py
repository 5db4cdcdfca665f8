"""A sound pulse along a strong field: c_s at xi = 1/2, ripples at xi = 1.

Lecture p. 20; Iwasaki 2015, section 5.1. Sound along B does not feel the field: a Gaussian pulse of v_x splits into two
halves that keep their shape and run at +-c_s. At beta = 0.1 xi = 1/2 does so within two percent. With xi = 1 the stress
along B is P + B^2/2 instead of P, and waves of a few spacings run up to 2.4 times too fast: a train of ripples ahead of
the pulse. With xi = 0 it is P - B^2/2 < 0 and the gas clumps. Nothing dissipates, but for the viscosity that lets
xi = 0 survive. scheme=godunov shows what a limiter costs: at length=0.4 it clips 5 % off the crests (nx = 256: 0.3 %),
and with xi = 0, left out, it would clump until its heat ran out. It costs about 10 s on two cores.

    spmhd run solitary_wave --set beta=0.01
    spmhd run solitary_wave --set scheme=godunov length=0.4
"""

from math import sqrt

from taichi_spmhd import (
    Adiabatic,
    InputError,
    Picture,
    QuinticSpline,
    Scene,
    Scheme,
    Study,
    exact,
    hexagonal,
    in_scheme,
)
from taichi_spmhd.terms import DivBSource, Induction, Stress, Viscosity

HALF, ROWS = 4.0, 20  # half the length of the box; rows across, room for the kernels of clumped gas
RHO, P, GAMMA = 1.0, 1.0, 5 / 3


# For `spmhd cost`: one and the same pulse, better resolved by more particles.
STUDY = Study(
    {"length": (0.4,), "nx": (64, 128, 256), "kernel": ("cubic", "quintic", "wendland_c4")},
    variants=("xi = 1/2", "xi = 1"),
)


def scenes(
    nx: int = 128,
    beta: float = 0.1,
    amplitude: float = 0.01,
    width: float = 3.0,
    length: float = 0.0,
    t_end: float = 0.6,
    scheme: Scheme = "standard",
):
    """amplitude: of the pulse in v_x; width: exp(-(x/w)^2), w in smoothing lengths; beta = 2P/B^2; length: w itself,
    where it is to stay the same at every nx (0: take width)."""
    check(beta, width, length)
    dx, kernel = 2 * HALF / nx, QuinticSpline()
    box = ((-HALF, HALF), (0.0, ROWS * sqrt(0.75) * dx))
    w = length or width * kernel.h_fact * sqrt(sqrt(0.75)) * dx  # h = h_fact sqrt(m/rho) of a hexagonal lattice
    B0 = sqrt(2 * P / beta)

    def pulse(x, t):
        return exact.sound_pulse(x, t, amplitude, w, RHO, P, GAMMA, B0, period=2 * HALF)

    colours = abs(amplitude) or 0.01
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
        picture=Picture("v", axis=0, limits=(-0.6 * colours, 1.1 * colours)),
    )
    return in_scheme(variants(bare, scheme), scheme)


def check(beta: float, width: float, length: float) -> None:
    """Raises InputError for a pulse that cannot be."""
    if not (beta > 0 and width > 0 and length >= 0):
        raise InputError(
            f"beta = {beta:g}, width = {width:g} must be positive, for example beta=0.1 width=3; length >= 0"
        )


def variants(bare: Scene, scheme: Scheme) -> dict:
    """With each xi; Godunov's scheme without xi = 0, which clumps until its heat has run out."""
    cures = {"xi = 1/2": bare.plus(DivBSource(xi=0.5)), "xi = 1": bare.plus(DivBSource(xi=1.0))}
    return cures if scheme == "godunov" else {"xi = 0": bare.plus(Viscosity()), **cures}
