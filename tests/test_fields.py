"""Device memory comes back: more simulations in one process than Taichi can hold field trees."""

import pytest

from taichi_spmhd.lattice import square
from taichi_spmhd.particles import Particles
from taichi_spmhd.scene import Scene
from taichi_spmhd.simulation import Simulation
from taichi_spmhd.terms import Pressure

BOX = (1.0, 1.0)
MANY = 600  # Taichi 1.7.4 holds 511 field trees; the next one ends the process without a message


def still_gas() -> Scene:
    """144 particles at rest."""
    return Scene(box=BOX, positions=square(BOX, 12), start=lambda x: {"rho": 1.0, "P": 1.0}, terms=(Pressure(),))


def test_600_sets_of_fields_and_20_simulations_in_one_process_leave_room_for_one_that_runs():
    """A Simulation traces its kernels anew (0.1 s; 600 took 92 s), so here 600 are only particles, 20 are whole."""
    with Simulation(still_gas()) as sim:
        n, members, evolved = len(sim), sim.particles.members, sim.particles.evolved
    for _ in range(MANY):
        particles = Particles(n, 2, members, evolved)
        particles.finish()
        particles.close()
    for _ in range(20):
        with Simulation(still_gas()):
            pass
    with Simulation(still_gas()) as sim:
        sim.step()
        assert sim.steps == 1 and (sim["rho"] > 0).all()


@pytest.mark.slow
def test_600_whole_simulations_in_one_process():
    """About 1.5 minutes: every one places its fields, writes its start and is closed."""
    for _ in range(MANY):
        with Simulation(still_gas()) as sim:
            assert len(sim) == 144


def test_closing_twice_is_harmless():
    sim = Simulation(still_gas())
    sim.close()
    sim.close()
