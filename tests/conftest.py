"""What the tests share: Taichi started once in f64 on two threads, and a disordered periodic set of particles."""

import os

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

from taichi_spmhd import runtime
from taichi_spmhd.density import SumMass
from taichi_spmhd.lattice import jitter, square
from taichi_spmhd.scene import Scene
from taichi_spmhd.simulation import Simulation

os.environ["MPLBACKEND"] = "Agg"  # no display
settings.register_profile(  # the same examples every time, as slow as they are: a simulation compiles for a second
    "same", derandomize=True, database=None, deadline=None, suppress_health_check=list(HealthCheck), print_blob=False
)
settings.load_profile("same")

BOX = (1.0, 1.25)  # of the disordered set, 20 x 25 particles


@pytest.fixture(scope="session", autouse=True)
def device():
    """Precision and threads of every test: one process cannot change them."""
    return runtime.init(arch="cpu", precision="f64", threads=2)


def chaos(x):
    """Random v, B, P and psi of order one, P positive, on unequal masses: nothing cancels by symmetry."""
    random = np.random.default_rng(1)
    return {
        "mass": random.uniform(0.8, 1.2, len(x)) / len(x),
        "rho": 0.8,
        "P": random.uniform(0.5, 2.0, len(x)),
        "v": random.normal(size=(len(x), 3)),
        "B": random.normal(size=(len(x), 3)),
        "psi": random.normal(size=len(x)),
    }


def disordered_scene(*terms, **changes) -> Scene:
    """500 particles 0.2 spacings off a square lattice, cubic spline, h to 1e-14."""
    x = jitter(square(BOX, 20), BOX, 0.2, seed=3)
    read = {"psi", "B"} & {name for term in terms for name in (*term.reads, *term.makes, *term.keeps)}
    left_out = {"psi", "B"} - read
    start = changes.pop("start", chaos)

    def given(x):
        return {k: v for k, v in start(x).items() if k not in left_out}

    return Scene(
        **{"box": BOX, "positions": x, "density": SumMass(tolerance=1e-14), **changes, "start": given}, terms=terms
    )


@pytest.fixture(scope="session")
def disordered():
    """disordered(*terms) -> Simulation at its start; one per set of terms, so do not step it."""
    built = {}

    def at_start(*terms) -> Simulation:
        if terms not in built:
            built[terms] = Simulation(disordered_scene(*terms))
            built[terms].begin()
        return built[terms]

    yield at_start
    for sim in built.values():
        sim.close()


@pytest.fixture
def simulate():
    """simulate(scene) -> Simulation, closed when the test ends."""
    built = []

    def start(scene) -> Simulation:
        built.append(Simulation(scene))
        return built[-1]

    yield start
    for sim in built:
        sim.close()
