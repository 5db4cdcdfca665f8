"""The rotor keeps the symmetry of half a turn, its angular momentum, and a positive pressure."""

import numpy as np
import pytest

from taichi_spmhd import Simulation, load_scene


def partners(x) -> tuple[np.ndarray, np.ndarray]:
    """Indices a, b with x[b] = -x[a] for a set that is symmetric under half a turn."""

    def order(x):
        return np.lexsort(np.round(x.T * 1e9))

    return order(x), order(-x)


def angular_momentum(c) -> float:
    """sum m (x v_y - y v_x)"""
    return float((c["m"] * (c["x"][:, 0] * c["v"][:, 1] - c["x"][:, 1] * c["v"][:, 0])).sum())


def expected_angular_momentum() -> float:
    """The integral of 2 pi r^2 rho v: rho = 1 + 9 f, v = 20 r in the disc and 2 f around it."""
    r = (np.arange(23000) + 0.5) * 0.115 / 23000
    f = np.clip((0.115 - r) / 0.015, 0, 1)
    return float((2 * np.pi * r**2 * (1 + 9 * f) * np.where(r < 0.1, 20 * r, 2 * f)).sum() * 0.115 / 23000)


def test_the_particles_carry_the_mass_and_the_spin_of_the_disc():
    # mass 1 + 9 (area of the disc + integral of f) to 3e-4; the spin is .9 and .2 % low at nx = 64 and 128
    for nx, within in ((64, 0.015), (128, 0.004)):
        scene = load_scene("rotor", nx=nx)["with cleaning"]
        c = {**scene.start(scene.positions), "x": scene.positions}
        c["m"] = np.full(len(scene.positions), c["mass"])
        assert c["m"].sum() == pytest.approx(1 + 9 * np.pi * 0.011575, rel=1e-3)
        assert angular_momentum(c) == pytest.approx(expected_angular_momentum(), rel=within)


def test_half_a_turn_changes_nothing():
    scene = load_scene("rotor", nx=24, t_end=0.05)["with cleaning"]
    a, b = partners(scene.positions)
    assert abs(scene.positions[a] + scene.positions[b]).max() < 1e-14
    with Simulation(scene) as sim:
        c = sim.run().columns()
    # round-off grows with the flow; measured at nx = 32: 2e-13 to 7e-11
    for name, sign in {"x": -1, "v": -1, "B": 1, "rho": 1, "P": 1}.items():
        assert abs(c[name][a] - sign * c[name][b]).max() < 1e-8, name


@pytest.mark.slow
@pytest.mark.parametrize("label", ["without cleaning", "with cleaning"])
def test_the_rotor_ends_with_its_angular_momentum_and_the_field_that_grid_codes_find(label):
    # nothing has reached the edge by t = 0.15, so angular momentum is constant but for what div B does.
    # Measured at nx = 50: + 1.5 % without, - 0.2 % with cleaning (- 0.6 % at nx = 64)
    with Simulation(load_scene("rotor", nx=50)[label]) as sim:
        at_start = angular_momentum(sim.columns())
        sim.run()
        c, floors = sim.columns(), sim.floors
    assert angular_momentum(c) == pytest.approx(at_start, rel=0.025 if label == "without cleaning" else 0.01)
    assert floors == 0 and 0 < c["P"].min() < 0.1  # measured 0.040, at nx = 100 too: resolved, not floored
    pressure = 0.5 * (c["B"] ** 2).sum(axis=1)
    # grid codes find a largest B^2/2 of 2.5 to 2.7 (Toth 2000); measured 2.86 and 2.92, at nx = 100 2.76 and 2.75
    assert 2.4 < np.percentile(pressure, 99.9) < 3.1
    assert pressure.min() < 0.2  # the field is swept out of the arms' inner side; measured 0.05 and 0.07
