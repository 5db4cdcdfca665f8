"""Unequal masses: by mass a gap opens at the contact, by volume none.

Lecture pp. 38-39; Hu & Adams 2006. rho = 1 outside and `ratio` in the middle, P = 1 everywhere: nothing should happen.
The spacing is the same everywhere, so the masses jump with rho. The lattice starts jittered by a tenth of a spacing and
flies at (1, 1/2) twice across the box. By mass a light particle at the contact counts its heavy neighbours as density
of its own: its pressure is too high, a heavy one's too low, they part, the first row of heavy particles closes up and
the gas is stirred. After two crossings P is still 32 % off there; with scheme=godunov, whose P* is shared by both
particles of a pair, 2.4 % by mass and 0.3 % by volume. It costs about 20 s on two cores.

    spmhd run contact_gap --set ratio=10
    spmhd run contact_gap --set scheme=godunov
"""

import numpy as np

from taichi_spmhd import (
    InputError,
    Picture,
    Scene,
    Scheme,
    SumMass,
    SumVolume,
    WendlandC4,
    hexagonal,
    in_scheme,
    jitter,
)
from taichi_spmhd.terms import Pressure, Viscosity

BOX = (1.0, 0.25)
GAMMA, P, FLIGHT = 5 / 3, 1.0, (1.0, 0.5, 0.0)
NOISE = 0.1  # of the positions, in spacings: a perfect lattice at rest proves nothing


def scenes(nx: int = 64, ratio: float = 4.0, t_end: float = 2.0, seed: int = 0, scheme: Scheme = "standard"):
    """ratio: of the densities and of the masses."""
    if not 1 <= ratio <= 1000:
        raise InputError(f"ratio = {ratio} must lie in 1..1000: how much denser the gas in the middle is")

    def start(x):
        rho = np.where(abs(x[:, 0] - 0.5) < 0.25, ratio, 1.0)
        return {"rho": rho, "u": P / ((GAMMA - 1) * rho), "v": FLIGHT}

    by_mass = Scene(
        box=BOX,
        positions=jitter(hexagonal(BOX, nx), BOX, NOISE, seed),
        start=start,
        kernel=WendlandC4(),
        density=SumMass(),
        terms=(Pressure(), Viscosity()),
        t_end=t_end,
        picture=Picture("rho", limits=(0.5, 1.25 * ratio), colours="cool", width=1000),
    )
    variants = {"density by mass": by_mass, "density by volume": by_mass.but(density=SumVolume())}
    return in_scheme(variants, scheme, slope="own")
