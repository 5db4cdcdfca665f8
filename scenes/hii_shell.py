"""An HII region drives a thin shell: P runs smoothly through the contact at which rho jumps ten thousandfold.

Lecture p. 40; Iwasaki, Tsuribe & Inutsuka 2011, simplified. Hot gas (rho 0.01, c 10) left of x = 0.2 pushes cold gas (1,
0.1) before it; both stay isothermal, so the cold gas piles up behind its shock a hundred times denser. One spacing
everywhere: the masses jump a hundredfold, and so does rho, while P is continuous. By volume the contact follows the
thin-shell solution (the line). By mass the last hot particle counts a heavy neighbour as its own density: fifty times
too high a pressure tears a hole. It costs about 20 s on two cores.

    spmhd run hii_shell
"""

from typing import Literal

import numpy as np

from taichi_spmhd import (
    Boundary,
    Frozen,
    LocallyIsothermal,
    Periodic,
    Picture,
    Reflecting,
    Scene,
    SumMass,
    SumVolume,
    exact,
    hexagonal,
    line,
)
from taichi_spmhd.terms import Pressure, Viscosity

LENGTH, X0 = 1.2, 0.2  # a wall at 0, frozen gas at the far end
HOT, COLD = (0.01, 10.0), (1.0, 0.1)  # rho, c
ROWS = 12  # of the strip: two supports of the expanded hot gas must fit


def scenes(nx: int = 360, dim: Literal[1, 2] = 1, t_end: float = 0.5):
    """nx: particles along x; dim=2: a strip, periodic across."""
    dx = LENGTH / nx
    box = (LENGTH,) if dim == 1 else (LENGTH, np.sqrt(0.75) * dx * ROWS)

    def start(x):
        hot = x[:, 0] < X0
        return {"rho": np.where(hot, HOT[0], COLD[0]), "cs": np.where(hot, HOT[1], COLD[1])}

    by_volume = Scene(
        box=box,
        positions=line(box, nx) if dim == 1 else hexagonal(box, nx),
        start=start,
        eos=LocallyIsothermal(),
        density=SumVolume(),
        boundary=Boundary(x=(Reflecting(), Frozen(8 * dx)), y=Periodic()),
        terms=(Pressure(), Viscosity()),
        t_end=t_end,
        exact=lambda x, t: exact.shell_profile(x, t, HOT, COLD, X0),
        measure="P",
        picture=Picture("P", limits=(0.005, 2.0), log=True),
    )
    return {"density by volume": by_volume, "density by mass": by_volume.but(density=SumMass())}
