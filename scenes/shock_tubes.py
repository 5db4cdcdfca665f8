"""MHD shock tubes: up to seven waves, beside the exact solution.

Lecture pp. 31-33; Ryu & Jones 1995 (rj1a ... rj4d are their numbers), Dai & Woodward 1994, Balsara 1998. The default,
rj1a, is the lecture's colliding flow: gas at v_x = +-10 ends in two fast shocks, a slow rarefaction and a slow shock.
Look at v_y behind the right shock, exactly -0.388: it is off by 0.4, 4 and 8 % with xi = 0, 1/2 and 1, since the div B
source does not conserve momentum. xi = 1/2 is the least that is stable whatever beta (0.5 in the gas from the right,
where xi = 0 is not). In 1-D B_x stays uniform by itself. dim=2 is a hexagonal strip, periodic across: squeezed by the
shocks its particles rearrange and B_x jumps by 9 % behind the right one, of which cleaning with f_clean=3 leaves 3 %.
scheme=godunov comes closer in v_y, 1 and 5 % at xi = 1/2 and 1, but B_x is not uniform by itself: 1.8 % low there. It
costs about 20 s on two cores.

    spmhd run shock_tubes --set tube=rj2a show=B_y
    spmhd run shock_tubes --set scheme=godunov show=B_x
    spmhd run shock_tubes --set dim=2 nx=300 f_clean=3 show=B_x
"""

from math import ceil, sqrt
from typing import Literal

import numpy as np

from taichi_spmhd import (
    Adiabatic,
    Boundary,
    Frozen,
    InputError,
    Isothermal,
    Periodic,
    Picture,
    QuinticSpline,
    Scene,
    Scheme,
    Study,
    exact,
    in_scheme,
    step_lattice,
)
from taichi_spmhd.terms import (
    Cleaning,
    Conductivity,
    ConstantCleaning,
    DivBSource,
    Induction,
    Resistivity,
    Stress,
    Viscosity,
)

HALF = 0.5  # the waves stay within |x| < 1/2
END = 0.1  # thickness of the frozen ends, which move with their gas
STUDY = Study(  # for `spmhd cost`; in 1-D there is nothing to clean
    {"nx": (400, 800, 1600), "kernel": ("cubic", "quintic", "wendland_c4")},
    variants=("without cleaning",),
)
COLUMNS = {"rho": 0, "P": 1, "v_x": 2, "v_y": 3, "v_z": 4, "B_y": 5, "B_z": 6}  # of a state


def scenes(
    tube: Literal[
        "rj1a", "rj1b", "rj2a", "rj2b", "rj3a", "rj3b", "rj4a", "rj4b", "rj4c", "rj4d", "mach25", "isothermal"
    ] = "rj1a",
    nx: int = 600,
    dim: Literal[1, 2] = 1,
    xi: float = 0.5,
    f_clean: float = 1.0,
    show: Literal["rho", "P", "v_x", "v_y", "v_z", "B_x", "B_y", "B_z"] = "v_y",
    scheme: Scheme = "standard",
):
    """nx: particles along x, both sides together; f_clean: how much faster cleaning is; show: what is drawn."""
    known = exact.TUBES[tube]
    lattice, ends = pipe(known, nx, dim)
    hot = known.gamma > 1
    bare = Scene(
        box=lattice.box,
        positions=lattice.positions,
        start=start(known, lattice.mass),
        eos=Adiabatic(known.gamma) if hot else Isothermal(1.0),
        kernel=QuinticSpline(),
        boundary=Boundary(x=ends, y=Periodic()),
        terms=(
            Stress(),
            Induction(),
            DivBSource(xi=xi),
            Viscosity(),
            Resistivity(),
            *((Conductivity(),) if hot else ()),
        ),
        t_end=known.t,
        exact=(lambda x, t: exact.mhd_tube(x, t, tube)) if known.waves else None,
        measure="rho",
        picture=picture(known, show),
    )
    return in_scheme(variants(bare, f_clean), scheme, slope="own")


def variants(bare: Scene, f_clean: float) -> dict:
    """The tube with every way of cleaning div B."""
    return {
        "without cleaning": bare,
        "constant c_h": bare.plus(ConstantCleaning(f_clean=f_clean)),
        "with cleaning": bare.plus(Cleaning(f_clean=f_clean)),
    }


def pipe(tube: exact.Tube, nx: int, dim: int):
    """Lattice and frozen ends: where gas flows in, as much longer as the end will travel."""
    left, right = tube.states[0], tube.states[-1]
    reach = (-HALF - END - max(left[2], 0) * tube.t, HALF + END + max(-right[2], 0) * tube.t)
    contrast = max(left[0], right[0]) / min(left[0], right[0])
    rows = 2 * ceil(6 * sqrt(contrast))  # the thin side needs two supports too
    lattice = step_lattice(reach, nx, (left[0], right[0]), rows=rows if dim == 2 else None)
    thin = QuinticSpline().support * (lattice.mass / min(left[0], right[0])) ** (1 / dim)
    if 2 * thin > END:
        raise InputError(
            f"nx = {nx}: the frozen ends are thinner than two supports; give nx={ceil(2 * thin / END * nx)}"
        )
    return lattice, Frozen(END)


def start(tube: exact.Tube, mass: float):
    """The two outer states; x has shape (N, d)."""

    def opening(x):
        rho, P, vx, vy, vz, By, Bz = np.where(x[:, :1] < 0, tube.states[0], tube.states[-1]).T
        v, B = np.stack([vx, vy, vz], axis=1), np.stack([np.full(len(x), tube.B_x), By, Bz], axis=1)
        return {"rho": rho, "v": v, "B": B, "mass": mass} | ({"P": P} if tube.gamma > 1 else {})

    return opening


def picture(tube: exact.Tube, show: str) -> Picture:
    """One quantity, with room for all its states."""
    known = [0.8 * tube.B_x, 1.2 * tube.B_x] if show == "B_x" else [state[COLUMNS[show]] for state in tube.states]
    room = 0.15 * (max(known) - min(known)) or 0.1
    member, _, axis = show.partition("_")
    return Picture(member, axis="xyz".index(axis) if axis else None, limits=(min(known) - room, max(known) + room))
