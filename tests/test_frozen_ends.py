"""What frozen ends do to the gas is in the ledger: the drift of a tube with pistons is explained, not a bug."""

import pytest

from taichi_spmhd import Total, load_scene


@pytest.mark.parametrize(
    ("name", "variant", "numbers", "t_end"),
    [
        ("shock_tubes", "with cleaning", {"tube": "rj1a", "nx": 168}, 0.02),  # pistons at +-10, field and psi
        ("sod", "sod", {"nx": 100}, 0.05),  # ends at rest, a gas without a field
    ],
)
def test_the_drift_of_a_tube_is_what_its_ends_did(simulate, name, variant, numbers, t_end):
    sim = simulate(load_scene(name, **numbers)[variant].but(energy=Total(), t_end=t_end))
    s = sim.run().summary()
    # E and v follow the very rates that are booked: equal to the round-off of some 200 steps
    assert s["momentum_drift"] == pytest.approx(s["momentum_drift_predicted"], rel=1e-11)
    # what psi keeps at the ends is not booked: measured 3e-10 of E with cleaning, 3e-16 without
    assert s["energy_drift"] == pytest.approx(s["energy_drift_predicted"], abs=3e-8)
    assert s["momentum_drift"] > 0.01, "the ends must have pushed, or nothing was tested"


def test_with_u_evolved_what_is_left_of_the_drift_is_the_time_steps(simulate):
    s = simulate(load_scene("shock_tubes", tube="rj1a", nx=168)["without cleaning"].but(t_end=0.02)).run().summary()
    assert abs(s["energy_drift"]) > 5e-3
    # measured: 9 % of E came in over the whole run at nx = 200, all but 8e-5 of it foretold
    assert s["energy_drift"] == pytest.approx(s["energy_drift_predicted"], abs=5e-4)
