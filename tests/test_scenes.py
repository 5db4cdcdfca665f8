"""Every scene that ships runs, at a small size: one variant in the default tests, all of them in the slow ones."""

import numpy as np
import pytest

from taichi_spmhd import Simulation, load_scene
from taichi_spmhd.library import parameters_of, shipped
from taichi_spmhd.terms import ConstantCleaning
from taichi_spmhd.terms.godunov import Godunov

SMALL = {  # parameters that make a scene quick, and what it must have kept
    "alfven_tensile": {"nx": 12, "t_end": 0.1},
    "alfven_3d": {"nx": 16, "t_end": 0.2},
    "tensile_cures": {"nx": 12, "t_end": 0.1},
    "uniform_field": {"nx": 16, "duration": 2.0},
    "frozen_field": {"nx": 24, "t_end": 0.1},
    "orszag_tang": {"nx": 32, "t_end": 0.1},
    "blast": {"nx": 32, "t_end": 0.03},
    "current_sheet": {"nx": 16, "t_end": 0.5},
    "density_evolution": {"nx": 32, "t_end": 0.03},
    "field_loop": {"nx": 20, "t_end": 0.25},
    "kelvin_helmholtz": {"nx": 20, "t_end": 0.2},
    "divergence_peak": {"nx": 16, "case": "jump", "t_end": 0.1},
    "mhd_blast": {"nx": 32, "t_end": 0.03},
    "rotor": {"nx": 24, "t_end": 0.03},
    "sod": {"nx": 150, "t_end": 0.05},
    "shock_tubes": {"tube": "rj4a", "nx": 240},  # at rest at both ends, so the frozen ends do no work
    "sedov": {"nx": 32},
    "noh": {"nx": 24, "t_end": 0.3},
    "brio_wu": {"nx": 200},
    "solitary_wave": {"nx": 48, "t_end": 0.2},
    "sound_wave": {"nx": 16, "t_end": 0.2},
    "contact_gap": {"nx": 32, "t_end": 0.1},
    "hii_shell": {"nx": 48, "finer": 2, "t_end": 0.05},
}

GODUNOV = {  # scenes with a parameter `scheme`, and what makes their runs quicker still
    "alfven_tensile": {},
    "blast": {},
    "brio_wu": {"nx": 120},
    "contact_gap": {},
    "hii_shell": {},
    "kelvin_helmholtz": {"weak": 0.0, "strong": 0.0},
    "mhd_blast": {"t_end": 0.01},
    "orszag_tang": {"t_end": 0.02},
    "rotor": {"t_end": 0.01},
    "shock_tubes": {},
    "sod": {},
    "solitary_wave": {"t_end": 0.05},
}


def test_every_shipped_scene_is_tested():
    assert set(SMALL) == set(shipped())


def run_and_check(scene) -> None:
    """Runs to its end: finite members, no floors, energy within what the scene's ledger and time step explain."""
    with Simulation(scene) as sim:
        sim.run()
        assert sim.time == pytest.approx(scene.t_end)
        assert all(np.isfinite(values).all() for values in sim.columns().values())
        summary = sim.summary()
    assert summary["floors"] == 0
    # coarse runs: the rest is the time step's error and, with cleaning, what the damping takes; measured <= 4e-3
    assert abs(summary["energy_drift"] - summary["energy_drift_predicted"]) < 1e-2


@pytest.mark.parametrize("name", sorted(SMALL))
def test_the_last_variant_of_each_scene_runs(name):
    run_and_check(list(load_scene(name, **SMALL[name]).values())[-1])


ALONE = {"blast", "noh", "sedov", "sod", "sound_wave", "uniform_field"}  # scenes of one variant


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(set(SMALL) - ALONE))
def test_the_other_variants_of_each_scene_run(name):
    *others, _ = load_scene(name, **SMALL[name]).values()
    assert others
    for scene in others:
        run_and_check(scene)


def test_the_scenes_that_know_both_schemes_are_these():
    assert set(GODUNOV) == {name for name in shipped() if "scheme" in parameters_of(name)}


@pytest.mark.parametrize("name", sorted(GODUNOV))
def test_godunovs_scheme_has_every_variant_once_and_the_standard_one_is_as_it_was(name):
    small = SMALL[name]
    made, plain = load_scene(name, **small, scheme="godunov"), load_scene(name, **small)
    assert set(made) <= set(plain) and list(made)[-1] == list(plain)[-1]
    assert len({(scene.terms, scene.density, scene.start) for scene in made.values()}) == len(made)
    assert all(isinstance(scene.terms[0], Godunov) for scene in made.values())
    assert not any(isinstance(scene.terms[0], Godunov) for scene in plain.values())


def run_in_godunovs_scheme(scene) -> None:
    """As run_and_check, and the energy is what the ledger says."""
    with Simulation(scene) as sim:
        sim.run()
        assert sim.time == pytest.approx(scene.t_end)
        assert all(np.isfinite(values).all() for values in sim.columns().values())
        summary = sim.summary()
    cleans = any(isinstance(term, ConstantCleaning) for term in scene.terms)
    assert summary["floors"] == 0
    # exact for any step; but for cleaning, whose psi is known to the order of the step. Measured 8e-16 and 3e-5
    assert summary["energy_drift"] == pytest.approx(summary["energy_drift_predicted"], abs=1e-4 if cleans else 1e-12)


FIRST = ("alfven_tensile", "contact_gap", "hii_shell", "orszag_tang", "sod")  # one of each kind; the rest is slow


@pytest.mark.parametrize("name", FIRST)
def test_the_last_variant_of_a_scene_runs_in_godunovs_scheme(name):
    run_in_godunovs_scheme(list(load_scene(name, **{**SMALL[name], **GODUNOV[name]}, scheme="godunov").values())[-1])


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(GODUNOV))
def test_all_variants_of_each_scene_run_in_godunovs_scheme(name):
    for scene in load_scene(name, **SMALL[name], scheme="godunov").values():
        run_in_godunovs_scheme(scene)


@pytest.mark.slow
def test_sod_as_a_strip_runs():
    run_and_check(load_scene("sod", nx=100, dim=2, t_end=0.05)["sod"])


@pytest.mark.slow
@pytest.mark.parametrize("lattice", ["square", "hexagonal"])
def test_uniform_field_on_both_lattices_runs(lattice):
    run_and_check(next(iter(load_scene("uniform_field", nx=16, duration=2.0, lattice=lattice, angle=30.0).values())))
