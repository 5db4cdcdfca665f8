"""An HII region drives a thin shell: P passes the contact where rho jumps.

Lecture p. 40; after Iwasaki, Tsuribe & Inutsuka 2011, simplified. Hot gas left of x = 0.2 (P = 1) pushes cold gas (rho
1, c 0.1) before it; both stay isothermal. The cold gas piles up a hundred times denser between its shock and the
contact, where rho jumps two thousandfold; the line is the thin-shell solution. The masses jump too. By volume no
particle feels that its neighbour is a thousand times heavier; by mass the last hot particles count heavy neighbours as
density of their own, and their pressure is twice what it should be: 1.95 at t = 0.5, but 0.84 with scheme=godunov. By
volume it is 1.20 and 1.12. It costs about 120 s on two cores.

    spmhd run hii_shell --variant "density by volume"
    spmhd run hii_shell --set scheme=godunov
"""

from typing import Literal

import numpy as np

from taichi_spmhd import (
    Boundary,
    Frozen,
    Heun,
    InputError,
    LocallyIsothermal,
    Periodic,
    Picture,
    QuinticSpline,
    Reflecting,
    Scene,
    Scheme,
    SumMass,
    SumVolume,
    exact,
    hexagonal,
    in_scheme,
    line,
)
from taichi_spmhd.box import as_box
from taichi_spmhd.terms import Pressure, Viscosity

LENGTH, X0, P_HOT = 1.2, 0.2, 1.0  # a wall at 0, frozen gas at the far end
COLD = (1.0, 0.1)  # rho, c
STILL = 8  # spacings of frozen gas
ROWS = 12  # of the strip: two supports of the expanded hot gas must fit
FINER = {1: 50, 2: 1}


def scenes(
    nx: int = 48, finer: int = 0, c_hot: float = 5.0, dim: Literal[1, 2] = 1, t_end: float = 0.5,
    scheme: Scheme = "standard",
):  # fmt: skip
    """nx: cold particles along the whole length. finer: how many times closer the hot ones stand at the start.

    The shell is compressed P/0.01 times and the hot gas expands: with finer = 100 the spacings on both sides of the
    contact stay equal, with 50 (default) they differ by two, with 1 (the lattice is the same on both sides) by a
    hundred, and the particles at the contact feel that. dim=2 is a strip, periodic across, with finer = 1: the contact
    keeps its place to 4 %, but the shell's rows, squeezed along x alone, buckle and their pressure reads low.
    """
    finer = finer or FINER[dim]
    if not (nx >= 24 and 1 <= finer <= 200 and 2 <= c_hot <= 50):
        raise InputError("hii_shell: nx must be at least 24, finer lie in 1..200 and c_hot in 2..50")
    hot = (P_HOT / c_hot**2, c_hot)
    box, sides = tube(nx, finer, dim)
    shares = np.repeat([X0 / len(sides[0]), (LENGTH - X0) / len(sides[1])], [len(side) for side in sides])

    def start(x):
        rho, cs = (np.where(x[:, 0] < X0, *both) for both in zip(hot, COLD, strict=True))
        return {"rho": rho, "cs": cs, "mass": rho * shares * box.volume / LENGTH}

    by_volume = Scene(
        box=box,
        positions=np.concatenate(sides),
        start=start,
        eos=LocallyIsothermal(),
        density=SumVolume(),
        boundary=Boundary(x=(Reflecting(), Frozen(STILL * LENGTH / nx)), y=Periodic()),
        terms=(Pressure(), Viscosity()),
        t_end=t_end,
        exact=lambda x, t: exact.shell_profile(x, t, hot, COLD, X0),
        measure="P",
        picture=Picture("P", limits=(0.008, 2.0), log=True),
    )
    variants = {
        "density by volume": by_volume,
        "density by mass": by_volume.but(density=SumMass(), stepper=Heun()),  # less is lost
    }
    return in_scheme(variants, scheme, slope="own", kernel=QuinticSpline())


def tube(nx: int, finer: int, dim: int) -> tuple:
    """The box, and the positions on the hot and on the cold side."""
    few, across = round(nx * X0 / LENGTH), () if dim == 1 else ((0.0, np.sqrt(0.75) * LENGTH / nx * ROWS),)
    lattice = line if dim == 1 else hexagonal
    sides = lattice(((0.0, X0), *across), few * finer), lattice(((X0, LENGTH), *across), nx - few)
    return as_box(((0.0, LENGTH), *across)), sides
