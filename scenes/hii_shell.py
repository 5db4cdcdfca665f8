"""An HII region drives a thin shell: P passes the contact where rho jumps.

Lecture p. 40; after Iwasaki, Tsuribe & Inutsuka 2011, simplified. Hot gas left of x = 0.2 (P = 1) pushes cold gas (rho
1, c 0.1) before it; both stay isothermal. The cold gas piles up a hundred times denser between its shock and the
contact, where rho jumps two thousandfold; the line is the thin-shell solution. The masses jump too. By volume no
particle feels that its neighbour is a thousand times heavier; by mass the last hot particles count heavy neighbours as
density of their own, and their pressure is twice what it should be. It costs about 100 s on two cores.

    spmhd run hii_shell --variant "density by volume"
"""

import numpy as np

from taichi_spmhd import (
    Boundary,
    Frozen,
    InputError,
    LocallyIsothermal,
    Picture,
    Reflecting,
    Scene,
    SumMass,
    SumVolume,
    exact,
    line,
)
from taichi_spmhd.terms import Pressure, Viscosity

LENGTH, X0, P_HOT = 1.2, 0.2, 1.0  # a wall at 0, frozen gas at the far end
COLD = (1.0, 0.1)  # rho, c
STILL = 8  # spacings of frozen gas


def scenes(nx: int = 84, finer: int = 50, c_hot: float = 5.0, t_end: float = 0.5):
    """nx: cold particles along the whole length. finer: how many times closer the hot ones stand at the start.

    The shell is compressed P/0.01 times and the hot gas expands: with finer = 100 the spacings of both stay equal at
    the contact, with 50 they differ by two, with 1 (masses as rho at the start, 100 times with c_hot=10) by a hundred.
    """
    if not (nx >= 24 and 1 <= finer <= 200 and 2 <= c_hot <= 50):
        raise InputError("hii_shell: nx must be at least 24, finer lie in 1..200 and c_hot in 2..50")
    hot = (P_HOT / c_hot**2, c_hot)
    few = round(nx * X0 / LENGTH)
    x = np.concatenate([line(((0.0, X0),), few * finer), line(((X0, LENGTH),), nx - few)])
    volume = np.where(x < X0, X0 / (few * finer), (LENGTH - X0) / (nx - few))[:, 0]

    def start(x):
        rho, cs = (np.where(x[:, 0] < X0, *sides) for sides in zip(hot, COLD, strict=True))
        return {"rho": rho, "cs": cs, "mass": rho * volume}

    by_volume = Scene(
        box=(LENGTH,),
        positions=x,
        start=start,
        eos=LocallyIsothermal(),
        density=SumVolume(),
        boundary=Boundary(x=(Reflecting(), Frozen(STILL * LENGTH / nx))),
        terms=(Pressure(), Viscosity()),
        t_end=t_end,
        exact=lambda x, t: exact.shell_profile(x, t, hot, COLD, X0),
        measure="P",
        picture=Picture("P", limits=(0.005, 2.0), log=True),
    )
    return {"density by volume": by_volume, "density by mass": by_volume.but(density=SumMass())}
