"""What is measured: gas that moves through a periodic box at Mach 0.3-0.5, with and without a magnetic field."""

import difflib
from itertools import product

import numpy as np

from ..errors import InputError
from ..lattice import cubic, jitter, square
from ..scene import Scene
from ..schemes import with_scheme
from ..terms import Cleaning, Conductivity, DivBSource, Induction, Pressure, Resistivity, Stress, Viscosity

GASES = ("mhd", "hydro", "godunov")  # godunov: MHD by Riemann problems
CASES = tuple(f"{gas}{dim}d_{precision}" for precision, gas, dim in product(("f64", "f32"), GASES, (3, 2)))
SIZES = {"3d": 32, "2d": 180}  # particles along an axis
QUICK = {"3d": 20, "2d": 64}
LARGE = {"3d": (31, 100), "2d": (173, 1000)}  # 3 10^4 and 10^6 particles
MHD = (Stress(), Induction(), DivBSource(0.5), Viscosity(), Conductivity(), Resistivity(), Cleaning())
HYDRO = (Pressure(), Viscosity(), Conductivity())


def known(cases) -> tuple[str, ...]:
    """The cases asked for, all where none are. Raises InputError for an unknown one."""
    for case in cases or ():
        if case not in CASES:
            near = difflib.get_close_matches(case, CASES, 1)
            meant = f"did you mean {near[0]}?" if near else f"there are {', '.join(CASES)}"
            raise InputError(f"--cases: unknown case {case!r}; {meant}")
    return tuple(case for case in CASES if not cases or case in cases)


def sizes(given, quick: bool) -> dict[str, int]:
    """{"2d": nx, "3d": nx} from words like 2d=180. Raises InputError for what is not of that form."""
    found = dict(QUICK if quick else SIZES)
    for word in given or ():
        axis, _, nx = word.partition("=")
        if axis not in found or not nx.isdigit() or int(nx) < 8:
            raise InputError(f"--sizes {word}: write 2d=NX or 3d=NX, particles along an axis, at least 8, as in 3d=32")
        found[axis] = int(nx)
    return found


def scene(case: str, nx: int) -> Scene:
    """nx^d particles 0.1 spacings off a lattice, vortices with v up to 0.4 c_s, beta above 2; cubic spline."""
    magnetic, dim = not case.startswith("hydro"), 3 if "3d" in case else 2
    box = (1.0,) * dim
    lattice = cubic(box, nx) if dim == 3 else square(box, nx)
    start = vortices if magnetic else without_field
    made = Scene(box=box, positions=jitter(lattice, box, 0.1, 1), start=start, terms=MHD if magnetic else HYDRO)
    return with_scheme(made, "godunov" if case.startswith("godunov") else "standard")


def vortices(x: np.ndarray) -> dict:
    """rho, P, v and B at positions x (N, d)."""
    k, still = 2 * np.pi, 0 * x[:, 0]
    v = 0.3 * np.stack([np.sin(k * x[:, 1]), np.sin(k * x[:, 0]), still], axis=1)
    B = 0.3 * np.stack([np.sin(k * x[:, 1]) + 1, np.sin(2 * k * x[:, 0]), still], axis=1)
    return {"rho": 1.0, "P": 0.6, "v": v, "B": B}


def without_field(x: np.ndarray) -> dict:
    """The same gas without B."""
    return {name: value for name, value in vortices(x).items() if name != "B"}
