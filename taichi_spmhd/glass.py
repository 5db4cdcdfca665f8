"""Glasses: particles pushed apart until their summed density is even, without a lattice's rows.

Shocks and shear leave lattices in such a state; a start from one has no direction that is better than another.
"""

import numpy as np

from .box import as_box
from .density import SumMass
from .eos import Isothermal
from .errors import InputError
from .kernels import WendlandC4
from .lattice import centres, jitter, whole, wrapped

UNEVEN = 0.01  # spread of the density of what has settled: 0.2 to 0.3 % is usual
ROUNDS, PUSH, DISORDER = 800, 0.2, 0.35  # of pushing; dt^2 c^2/dx^2 of each; of the start, in spacings


def glass(box, nx: int, kernel=None, seed: int = 0) -> np.ndarray:
    """About nx particles along x, pushed along -grad P of an isothermal gas until they lie evenly; shape (N, d).

    kernel: the one whose density becomes even (default WendlandC4). The same seed gives the same bits. It starts Taichi
    if nobody has. Raises InputError for a box narrower than two supports of the kernel.
    """
    from .scene import Scene
    from .simulation import Simulation
    from .terms import Pressure

    box, kernel = as_box(box), kernel or WendlandC4()
    x = jitter(centres(box, whole("nx", nx, 4)), box, DISORDER, whole("seed", seed, 0))
    volume = box.volume / len(x)
    start = {"rho": 1.0, "mass": volume}
    scene = Scene(box=box, positions=x, start=lambda x: start, terms=(Pressure(),), eos=Isothermal(1.0), kernel=kernel,
                  density=SumMass(1e-6))  # fmt: skip
    with Simulation(scene) as sim:
        sim.begin()
        for _ in range(ROUNDS):
            push(sim, volume)
        relaxed, rho = (sim.particles.read()[name] for name in ("x", "rho"))
    if not rho.std() < UNEVEN * rho.mean():
        raise InputError("glass: the particles did not settle; take another seed, or more of them")
    return wrapped(relaxed, box)


def push(sim, volume: float) -> None:
    """x += PUSH dx^2 dv/dt / c^2, a tenth of a spacing dx at most: longer steps would overshoot the shortest waves."""
    p, dx = sim.particles, volume ** (1 / sim.dim)
    step, longest = PUSH * dx**2 * p.rates()["v"][:, : sim.dim], 0.1 * dx
    step *= longest / np.maximum(longest, np.linalg.norm(step, axis=1, keepdims=True))
    table, ids = p.table()
    p.by_name(table, p.layout)["x"][:] += step
    p.admit(table, ids)
    sim.rhs.evaluate(0.0, 0.0)
