"""Thermal energy where it is a small part of all: Dual beside Total, and steps that would take all of u."""

import numpy as np
import pytest

from taichi_spmhd import (
    Boundary,
    Dual,
    InputError,
    Open,
    RunError,
    Scene,
    Simulation,
    SumMass,
    TimeCentred,
    Total,
    hexagonal,
    jitter,
    load_scene,
)
from taichi_spmhd.diagnostics.ledger import drifts
from taichi_spmhd.terms import DivBSource, GodunovHydro, GodunovMHD, Induction

BOX = (1.0, 3**0.5 / 2)


def noisy(energy, beta: float, t_end: float = 0.3) -> Scene:
    """A uniform field, |B| = 1, in gas at rest on a lattice shaken by a tenth of a spacing."""
    return Scene(
        box=BOX,
        positions=jitter(hexagonal(BOX, 24), BOX, 0.1, seed=1),
        start=lambda x: {"rho": 1.0, "P": 0.5 * beta, "B": [0.6, 0.8, 0.0]},
        terms=(GodunovMHD(), Induction(), DivBSource(xi=0.75)),
        density=SumMass(slope="mean"),
        stepper=TimeCentred(),
        energy=energy,
        t_end=t_end,
    )


def test_at_a_low_beta_total_energy_runs_out_of_heat_and_dual_does_not():
    with Simulation(noisy(Total(), 1e-5)) as sim, pytest.raises(RunError, match="thermal energy"):
        sim.run()
    with Simulation(noisy(Dual(), 1e-5)) as sim:
        summary = sim.run().summary()
        assert sim["u"].min() > 0
        # u = 7.5e-6 at the start; noise of the stress moves the gas, of the heat only what is above 1e-3 B^2/2 is kept
        assert summary["energy_switches"] > 0.1 * summary["steps"] * len(sim)
        # what a switch adds to E is booked: the ledger is as exact as without
        found = drifts(sim)
        assert found["energy_drift"] == pytest.approx(found["energy_drift_predicted"], abs=1e-13)


@pytest.mark.slow
def test_where_heat_is_known_nothing_switches_and_all_is_as_with_total():
    with Simulation(noisy(Total(), 2.0, 0.1)) as total, Simulation(noisy(Dual(), 2.0, 0.1)) as dual:
        total.run()
        dual.run()
        assert dual.summary()["energy_switches"] == 0
        # each step E is set right by what rounding left
        assert dual["u"] == pytest.approx(total["u"], rel=1e-11)


def test_dual_is_for_scenes_with_a_field_and_its_threshold_a_share():
    scene = load_scene("sod", scheme="godunov")["sod"].but(energy=Dual())
    assert "E" not in {name for part in scene.parts for name in part.evolves}
    with pytest.raises(InputError, match="least"):
        Dual(least=2.0)


def test_a_step_that_would_take_all_heat_is_made_shorter():
    """Gas that flies apart as v = 30 x, sound speed 1: a step of 0.2 would leave u far below zero."""
    x = hexagonal(BOX, 16)
    scene = Scene(
        box=BOX,
        positions=x,
        start=lambda x: {"rho": 1.0, "P": 0.6, "v": 30 * np.column_stack([x - x.mean(axis=0), 0 * x[:, 0]])},
        terms=(GodunovHydro(),),
        density=SumMass(slope="own"),
        stepper=TimeCentred(),
        boundary=Boundary(x=Open(), y=Open()),
    )
    with Simulation(scene) as sim:
        sim.step(0.2)
        assert 0 < sim.dt < 0.1
        assert sim.time == sim.dt
        assert sim["u"].min() > 0
        assert sim.run(until=0.1).time == 0.1
