"""Diagnostics: each number against a case in which it is known."""

import json

import numpy as np
import pytest
from conftest import disordered_scene
from test_terms import Reference, cubic, dot

from taichi_spmhd.boundary import Boundary, Open, Periodic, Reflecting
from taichi_spmhd.diagnostics import (
    COLUMNS,
    clumping,
    div_B,
    energies,
    errors,
    first_peak,
    history_row,
    interpolate,
    momentum,
    nearest_gaps,
    predicted,
    summary,
)
from taichi_spmhd.eos import Isothermal
from taichi_spmhd.errors import InputError
from taichi_spmhd.kernels import QuinticSpline, WendlandC4
from taichi_spmhd.lattice import hexagonal, jitter, square
from taichi_spmhd.scene import Scene
from taichi_spmhd.stepper import Heun
from taichi_spmhd.terms import Cleaning, DivBSource, Induction, Pressure, Stress, Viscosity

MHD = (Stress(), Induction())


def hydro(x, box, **changes):
    start = {"rho": 1.0} if isinstance(changes.get("eos"), Isothermal) else {"rho": 1.0, "P": 1.0}
    return Scene(**{"box": box, "positions": x, "start": lambda x: start, "terms": (Pressure(),), **changes})


def test_the_hexagonal_lattice_has_gaps_of_1_075_spacings_and_no_close_pairs(simulate):
    box = (1.0, np.sqrt(3.0))
    sim = simulate(hydro(hexagonal(box, 12), box))
    found = clumping(sim)
    exact = np.sqrt(2 / np.sqrt(3))  # dx over (sqrt(3)/2 dx^2)^(1/2); the summed rho is within 1 % of m/area
    assert found["smallest_gap"] == pytest.approx(exact, rel=0.01) and found["mean_gap"] == pytest.approx(
        exact, rel=0.01
    )
    assert found["close_pairs"] == 0


def test_gaps_equal_a_search_over_all_pairs_in_the_callers_order(disordered):
    sim = disordered(*MHD)
    c = sim.columns()
    size = np.array(sim.scene.box.size)
    d = c["x"][:, None] - c["x"][None]
    apart = np.sort(np.linalg.norm(d - size * np.round(d / size), axis=2), axis=1)
    assert nearest_gaps(sim) == pytest.approx(apart[:, 1] * np.sqrt(c["rho"] / c["m"]), rel=1e-12)


def test_a_particle_and_its_mirror_image_are_no_pair_and_lonely_ones_keep_the_numbers_finite(simulate):
    wall = Boundary(x=Reflecting(), y=Periodic())
    x = square((1.0, 1.0), 10)
    x[:, 0] = 0.005 + 0.99 * (x[:, 0] - 0.05) / 0.9  # the first column 0.005 from the wall, 0.01 from its image
    sim = simulate(hydro(x, (1.0, 1.0), boundary=wall))
    assert nearest_gaps(sim).min() > 0.5
    pair = simulate(hydro([[0.2], [0.8]], (1.0,), boundary=Boundary(x=Open())))
    assert all(np.isfinite(value) for value in (*clumping(pair).values(), first_peak(pair)))


def test_div_B_is_the_difference_operator_over_the_field(disordered):
    sim = disordered(*MHD, Cleaning(0.4, 1.1))
    c = sim.columns()
    s = Reference(c, sim.scene.box.size)
    Bi, Bj = s.along(c["B"])
    expected = c["h"] * abs(s.rho * ((Bi - Bj) * s.Gi).sum(1)) / np.linalg.norm(c["B"], axis=1)
    assert abs(div_B(sim) - expected).max() <= 1e-12 * expected.max()


@pytest.mark.parametrize("B", [(1.0, 0.5, -0.3), (0.0, 0.0, 0.0)])
def test_div_B_of_a_uniform_field_is_zero_on_any_particles(simulate, B):
    x = jitter(square((1.0, 1.0), 12), (1.0, 1.0), 0.2)
    start = {"rho": 1.0, "P": 1.0, "B": np.array(B)}
    sim = simulate(Scene(box=(1.0, 1.0), positions=x, start=lambda x: start, terms=MHD))
    # b = B/rho and back: round-off of 1e-16 over a few tenths of a spacing
    assert summary(sim)["div_B"]["max"] < 1e-14


def test_energies_and_momentum_are_the_sums_over_the_start(disordered):
    sim = disordered(*MHD, Cleaning(0.4, 1.1))
    c, given = sim.columns(), sim.scene.start(sim.scene.positions)
    m, now = given["mass"], energies(sim)
    assert now["E_kin"] == pytest.approx(0.5 * (m * dot(given["v"], given["v"])).sum(), rel=1e-12)
    assert now["E_int"] == pytest.approx((m * given["P"] / c["rho"]).sum() / (2 / 3), rel=1e-12)
    assert now["E_mag"] == pytest.approx((m * dot(given["B"], given["B"]) / (2 * c["rho"])).sum(), rel=1e-12)
    assert now["E_clean"] > 0 and now["E_tot"] == pytest.approx(sum(v for k, v in now.items() if k != "E_tot"))
    assert momentum(sim) == pytest.approx((m[:, None] * given["v"]).sum(0), rel=1e-12)


def test_the_drift_of_a_run_is_the_predicted_one(simulate):
    """Momentum to round-off, since both are integrated alike; energy to the error of the time steps."""
    x = jitter(square((1.0, 1.0), 16), (1.0, 1.0), 0.1)

    def start(x):
        v = 0.3 * np.stack([np.sin(2 * np.pi * x[:, 1]), 0 * x[:, 0], 0 * x[:, 0]], axis=1)
        return {"rho": 1.0, "P": 0.5, "v": v + np.array([0.5, 0.2, 0.1]), "B": np.array([1.0, 0.4, 0.3])}

    scene = Scene(
        box=(1.0, 1.0), positions=x, start=start, terms=(*MHD, DivBSource(1.0), Viscosity()), stepper=Heun(cour=0.1)
    )
    sim = simulate(scene)
    sim.begin()
    for _ in range(60):
        sim.step()
    energy, push = predicted(sim)
    assert momentum(sim) - sim.ledger.p0 == pytest.approx(push, rel=1e-9, abs=1e-15)
    found = summary(sim)
    assert (
        found["momentum_drift"] == pytest.approx(found["momentum_drift_predicted"], rel=1e-9)
        and found["momentum_drift"] > 0
    )
    drift = energies(sim)["E_tot"] - sim.ledger.E0
    assert abs(energy) > 1e-6 and drift == pytest.approx(energy, rel=0.02)
    assert found["energy_drift"] == pytest.approx(drift / sim.ledger.E0)


def test_an_isothermal_gas_keeps_its_free_energy(simulate):
    """A sound wave of 10 %: kinetic energy comes from c^2 ln(rho); E_tot moves by the time step's error alone."""
    x = square((1.0, 0.5), 24)
    x[:, 0] += 0.1 / (2 * np.pi) * np.cos(2 * np.pi * x[:, 0])
    sim = simulate(hydro(x, (1.0, 0.5), eos=Isothermal(1.0), stepper=Heun()))
    E0 = energies(sim)
    sim.run(until=0.25)
    E = energies(sim)
    assert E["E_kin"] > 1e-3 and abs(E["E_tot"] - E0["E_tot"]) < 1e-3 * E["E_kin"]


def test_errors_are_normalised_by_component_and_by_the_vector_where_it_is_zero(disordered, simulate):
    sim = disordered(*MHD)
    assert errors(sim) == {}
    B, rho = sim["B"], sim["rho"]
    exact = {"rho": 1.1 * rho, "B": B * [1.0, 2.0, 0.0], "v": np.zeros(3)}
    sim = simulate(disordered_scene(*MHD, exact=lambda x, t: exact))
    found = errors(sim)
    assert found["rho"] == pytest.approx(0.1 / 1.1) and found["B_y"] == pytest.approx(0.5)
    assert found["B_x"] < 1e-12
    size = np.linalg.norm(exact["B"], axis=1).mean()
    assert found["B_z"] == pytest.approx(abs(B[:, 2]).mean() / size)
    assert not any(name.startswith("v") for name in found), "nothing to compare a vanishing vector with"


def brute(c, name, points, box, kernel):
    """The same sums over all particles and the nearest images."""
    apart = points[:, None] - c["x"][None]
    apart -= np.array(box) * np.round(apart / np.array(box))
    weight = c["m"] / c["rho"] * kernel(np.linalg.norm(apart, axis=-1) / c["h"]) / c["h"] ** 2
    return (weight @ c[name].reshape(len(c["h"]), -1)) / weight.sum(1)[:, None]


def quintic(q):
    return sum(k * np.maximum(s - q, 0) ** 5 for k, s in ((1, 3), (-6, 2), (15, 1)))


@pytest.mark.parametrize(
    "kernel, f", [(None, lambda q: cubic(q)[0]), (QuinticSpline(), quintic)], ids=["own", "quintic"]
)
def test_samples_equal_the_sums_over_all_particles(disordered, kernel, f):
    sim, random = disordered(*MHD), np.random.default_rng(6)
    box = sim.scene.box.size
    points = random.uniform(size=(200, 2)) * box
    for name in ("B", "rho"):
        expected = brute(sim.columns(), name, points, box, f).squeeze()
        assert interpolate(sim, name, points, kernel) == pytest.approx(expected, rel=1e-11, abs=1e-12)
    copies = points + np.array([3 * box[0], -box[1]])
    assert sim.sample("rho", copies) == pytest.approx(sim.sample("rho", points), rel=1e-9)


def test_samples_hold_for_any_ratio_of_h_and_are_nan_in_the_void(simulate):
    random = np.random.default_rng(4)
    r, angle = 0.45 * 0.02 ** random.uniform(size=600), 2 * np.pi * random.uniform(size=600)
    x = 0.5 + r[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    scene = hydro(x, (1.0, 1.0), boundary=Boundary(), start=lambda x: {"mass": 1.0, "P": 1.0})
    sim = simulate(scene)
    points = np.concatenate([x[:200] + 0.003, random.uniform(0.2, 0.8, (200, 2))])
    expected = brute(sim.columns(), "x", points, (1e9, 1e9), lambda q: cubic(q)[0])
    assert sim.sample("x", points) == pytest.approx(expected, rel=1e-11)
    assert np.isnan(sim.sample("rho", np.array([[50.0, -1e7]]))).all()


def test_a_box_narrower_than_the_sampling_kernel_counts_every_image(simulate):
    """Five spacings high, a quintic of 3.6 on each side: two images of one particle reach the same point."""
    box = (1.0, 0.25)
    sim = simulate(hydro(square(box, 20), box))
    points = sim["x"][:7] + 0.01
    c = sim.columns()
    tall = {name: np.concatenate([values] * 3) for name, values in c.items()}
    tall["x"] = np.concatenate([c["x"] + [0, k * 0.25] for k in (-1, 0, 1)])
    expected = brute(tall, "x", points, (1.0, 1e9), quintic)
    assert interpolate(sim, "rho", points, QuinticSpline()) == pytest.approx(c["rho"][0])
    assert expected.shape == (7, 2)  # positions are not periodic; a periodic function of them is
    tall["wave"] = np.cos(2 * np.pi * tall["x"][:, 1] / 0.25)
    sim.columns = lambda: {**c, "wave": np.cos(2 * np.pi * c["x"][:, 1] / 0.25)}
    waves = brute(tall, "wave", points, (1.0, 1e9), quintic)[:, 0]
    assert interpolate(sim, "wave", points, QuinticSpline()) == pytest.approx(waves, rel=1e-10)


def test_sampling_refuses_what_it_cannot_do(disordered):
    sim = disordered(*MHD)
    with pytest.raises(KeyError, match="no member 'colour'"):
        sim.sample("colour", np.zeros((1, 2)))
    with pytest.raises(InputError, match=r"give \(M, 2\)"):
        sim.sample("rho", np.zeros((1, 3)))


def test_the_summary_says_what_the_interface_promises_and_fits_in_json(disordered):
    sim = disordered(*MHD, DivBSource(xi=0.5))
    found = summary(sim)
    names = (
        "particles t steps seconds seconds_compile updates_per_s terms members evolved bytes_per_particle smallest_gap "
        "mean_gap close_pairs first_peak energy_drift energy_drift_predicted momentum_drift momentum_drift_predicted "
        "div_B div_B_force anisotropy negative_pairs floors"
    )
    assert list(found) == names.split()
    assert found["terms"] == ["Stress()", "Induction()", "DivBSource(xi=0.5)"]
    assert json.loads(json.dumps(found, allow_nan=False)) == found
    assert found["energy_drift"] == 0 and found["momentum_drift"] == 0, "nothing has moved yet"


def test_a_hydro_scene_has_no_div_B_and_its_history_row_is_complete(simulate):
    sim = simulate(hydro(square((1.0, 1.0), 12), (1.0, 1.0), kernel=WendlandC4()))
    sim.step()
    assert not {"div_B", "div_B_force", "anisotropy", "negative_pairs"} & set(summary(sim))
    assert not {"B", "b", "psi"} & set(summary(sim)["members"])
    row = history_row(sim)
    assert tuple(row) == COLUMNS and row["step"] == 1
    assert all(np.isfinite(value) for value in row.values()) and row["E_mag"] == row["div_B_max"] == 0
    assert row["anisotropy"] == row["negative_pairs"] == row["div_B_force"] == 0 and row["first_peak"] > 0.9
    json.dumps(row, allow_nan=False)
