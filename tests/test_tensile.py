"""The tensile instability: how fast it grows, what xi does to it, and that the frame shows it."""

import numpy as np
import pytest

from taichi_spmhd import CubicSpline, Simulation, SumMass, WendlandC4, hexagonal, load_scene, square
from taichi_spmhd.render import Panels, columns
from taichi_spmhd.render.colours import BACKGROUND

NX = 32
FIT = np.arange(5, 9.01, 0.5) / NX  # t v_A/dx = 5..9: after the slow modes have gone, before it saturates


def growth_rate(scene) -> float:
    """Slope of ln rms(v_x) in units of v_A/dx."""
    speeds = []
    with Simulation(scene) as sim:
        for t in FIT:
            speeds.append(np.sqrt((sim.run(t)["v"][:, 0] ** 2).mean()))
    return float(np.polyfit(FIT * NX, np.log(speeds), 1)[0])


@pytest.mark.parametrize(("kernel", "analytic"), [(CubicSpline(), 1.29), (WendlandC4(), 1.28)])
def test_the_instability_grows_as_fast_as_linear_theory_says(kernel, analytic):
    # fastest mode of the linearised operator, hexagonal lattice, beta = 0.1. The fit sees the mean over many modes, so
    # a little less: measured 1.237 and 1.214. 10 % is what this recipe can tell.
    scene = load_scene("uniform_field", nx=NX, beta=0.1, noise=1e-6)["xi = 0"]
    assert growth_rate(scene.but(kernel=kernel, density=SumMass(1e-8))) == pytest.approx(analytic, rel=0.1)


@pytest.mark.parametrize("xi", [0.5, 1.0])
@pytest.mark.parametrize(("kernel", "lattice"), [(WendlandC4(), "hexagonal"), (CubicSpline(), "square")])
def test_with_xi_a_noisy_lattice_keeps_its_noise(kernel, lattice, xi):
    # 30 dx/v_A are 38 e-foldings of the unstable case; a stable lattice only oscillates about its start (measured <=
    # 1.03)
    scene = load_scene("uniform_field", nx=NX, beta=0.1, xi=xi, lattice=lattice)[f"xi = {xi:g}"].but(kernel=kernel)
    regular = (hexagonal if lattice == "hexagonal" else square)(scene.box, NX)

    def displacement(x):
        d = x - regular
        d -= np.array(scene.box.size) * np.round(d / np.array(scene.box.size))
        return np.sqrt(((d - d.mean(axis=0)) ** 2).sum(axis=1).mean())

    with Simulation(scene) as sim:
        worst = max(displacement(sim.run(t / NX)["x"]) for t in (5, 10, 15, 20, 25, 30))
    assert worst < 3 * displacement(scene.positions)


@pytest.fixture(scope="module")
def alfven():
    """The main job: {label: (summary at its end, field of the frame at t = 0.5)}."""
    out = {}
    for label, scene in load_scene("alfven_tensile").items():
        with Simulation(scene) as sim:
            panels = Panels([label], scene.box, scene.picture, periodic=scene.boundary.periodic)
            frame = panels.frame(0.5, {label: columns(sim.run(0.5), scene.picture)})
            field = panels.layout.fields[0]
            out[label] = sim.run().summary(), frame[field.top : field.bottom, field.left : field.right]
    return out


def test_clumps_at_xi_0_and_not_at_xi_half_or_1(alfven):
    # hexagonal start: 1.075; clumps leave about half of that (measured 0.61 to 0.62, whatever the round-off)
    assert alfven["xi = 0"][0]["mean_gap"] < 0.65
    for label in ("xi = 1/2", "xi = 1"):
        assert alfven[label][0]["mean_gap"] > 1.0
        assert alfven[label][0]["close_pairs"] == 0


def test_the_measures_of_the_instability_tell_the_variants_apart(alfven):
    torn = alfven["xi = 0"][0]
    # measured 3.1 after clumping (47 while it goes on) against 0.002 and 0.009: B S must be small beside J x B
    assert torn["div_B_force"] > 0.5
    assert torn["negative_pairs"] > 0  # measured 0.04: what is left once the clumps have raised the pressure
    for label in ("xi = 1/2", "xi = 1"):
        assert alfven[label][0]["div_B_force"] < 0.05
        assert alfven[label][0]["negative_pairs"] == 0  # P + (xi - 1/2) B^2 > 0
        assert alfven[label][0]["first_peak"] == pytest.approx(1.07, abs=0.03)  # the hexagonal lattice


@pytest.mark.slow
def test_while_it_grows_neighbours_line_up_with_the_field():
    # hexagonal lattice, rows along B: 2/3 for six equal neighbours. Measured 0.93 at t v_A/dx = 4.5, when the gaps are
    # 1.0 in the mean; 0.65 again later, when all order is gone
    with Simulation(load_scene("uniform_field", nx=NX)["xi = 0"]) as sim:
        before, after = sim.summary()["anisotropy"], sim.run(4.5 / NX).summary()["anisotropy"]
    assert before == pytest.approx(2 / 3, abs=0.03)
    assert after > 0.85


def dark(image) -> float:
    """Share of the pixels of a panel that no particle covers."""
    return float((np.abs(image.astype(int) - np.array(BACKGROUND)).max(axis=2) < 12).mean())


def test_the_frame_has_dark_gaps_at_xi_0_and_none_at_xi_half(alfven):
    # discs of 0.57 spacings cover all but the corners of a hexagonal cell; sheets leave broad stripes. Measured 0.31
    # and 0.006
    assert dark(alfven["xi = 0"][1]) > 0.2
    assert dark(alfven["xi = 1/2"][1]) < 0.03
    assert dark(alfven["xi = 1"][1]) < 0.03


def test_what_xi_costs_in_momentum_and_energy_is_predicted(alfven):
    summary = alfven["xi = 1"][0]
    # momentum: integrated by the same stepper as v, so equal to round-off of the sums
    assert summary["momentum_drift"] == pytest.approx(summary["momentum_drift_predicted"], rel=1e-6)
    # energy: the rest is the time step's error, second order in dt, 1e-4 of E at nx = 32
    assert abs(summary["energy_drift"] - summary["energy_drift_predicted"]) < 1e-4


def test_xi_0_conserves_momentum_to_round_off(alfven):
    assert alfven["xi = 0"][0]["momentum_drift"] < 1e-12
