"""Shocks against exact solutions and against grid runs nobody of this project made."""

from pathlib import Path

import numpy as np
import pytest

from taichi_spmhd import Simulation, exact, load_scene

REFERENCE = Path(__file__).parent / "reference"


@pytest.mark.parametrize(("dim", "nx", "within"), [(1, 450, 0.02), pytest.param(2, 300, 0.03, marks=pytest.mark.slow)])
def test_the_plateaus_of_sod_are_right(dim, nx, within):
    # 1-D: measured 0.3 %. In the strip the shock squeezes the lattice along x alone, and the sum over a squeezed
    # lattice reads 2.4 % low behind the shock at any nx; all else is within 1 %
    scene = load_scene("sod", dim=dim, nx=nx)["sod"]
    with Simulation(scene) as sim:
        sim.run()
        x, rho, P, v = sim["x"][:, 0], sim["rho"], sim["P"], sim["v"][:, 0]
    star = exact.star_state()  # P 0.30313, v 0.92745, rho 0.42632 and 0.26557 (Toro)
    left, right = (x > 0.03) & (x < 0.15), (x > 0.215) & (x < 0.315)  # between tail and contact, contact and shock
    both = left | right
    assert np.median(rho[left]) == pytest.approx(star.rho_left, rel=within)
    assert np.median(rho[right]) == pytest.approx(star.rho_right, rel=within)
    assert np.median(P[both]) == pytest.approx(star.P, rel=within)
    assert np.median(v[both]) == pytest.approx(star.v, rel=within)


def test_the_blast_reaches_the_radius_of_the_grid_run():
    # radius where the mean density falls through half of its peak, outside the peak; Athena++ 512^2 at t = 0.2
    grid = np.load(REFERENCE / "blast_hydro_t0.20_radial.npz")
    scene = load_scene("blast", nx=128)["blast"]
    with Simulation(scene) as sim:
        sim.run()
        r, rho = np.linalg.norm(sim["x"], axis=1), sim["rho"]
    bins = np.arange(0.3, 0.5, 0.005)
    mean = np.array([rho[(r >= a) & (r < a + 0.005)].mean() for a in bins])
    ours, theirs = front(bins + 0.0025, mean), front(grid["r"], grid["rho"])
    assert theirs == pytest.approx(0.441, abs=0.004)
    assert ours == pytest.approx(theirs, rel=0.02)


def front(r, rho) -> float:
    """Outermost radius at which the density passes the middle between its peak and the gas ahead, rho = 1."""
    k = np.argmax(np.where(r > 0.3, rho, 0))
    outside = np.nonzero(rho[k:] < 0.5 * (rho[k] + 1))[0][0] + k
    fraction = (rho[outside - 1] - 0.5 * (rho[k] + 1)) / (rho[outside - 1] - rho[outside])
    return float(r[outside - 1] + fraction * (r[outside] - r[outside - 1]))


@pytest.mark.slow
def test_orszag_tang_agrees_with_the_grid_run():
    # Athena++ 512^2 in means of 128^2 cells. Measured .066 .113 .164 .113; a 128^2 grid run has .025 .038 .070 .048
    with Simulation(load_scene("orszag_tang", nx=128)["with cleaning"]) as sim:
        sim.run()
        summary = sim.summary()
    error = summary["errors"]
    assert summary["floors"] == 0
    assert error["rho"] <= 0.075
    assert error["P"] <= 0.125
    assert error["v"] <= 0.195
    assert error["B"] <= 0.135


@pytest.mark.slow
def test_cleaning_lowers_div_B_in_orszag_tang():
    found = {}
    for label, scene in load_scene("orszag_tang", nx=96).items():
        with Simulation(scene) as sim:
            found[label] = sim.run().summary()["div_B"]
    assert found["with cleaning"]["mean"] < 0.6 * found["without cleaning"]["mean"]


@pytest.mark.slow
def test_the_magnetised_blast_agrees_with_the_grid_run():
    # measured with this scene .049 .083 .20 .033; the gates leave a fifth
    with Simulation(load_scene("mhd_blast", nx=128)["with cleaning"]) as sim:
        sim.run()
        error = sim.summary()["errors"]
    assert error["rho"] <= 0.06
    assert error["P"] <= 0.10
    assert error["v"] <= 0.24
    assert error["B"] <= 0.04
