"""Alternative forms of one equation: induction for B or B/rho, energy u or E, and one number for all particles."""

from dataclasses import dataclass

import numpy as np
import pytest
from conftest import BOX, chaos, disordered_scene
from test_terms import Reference, dot

from taichi_spmhd import InputError, RunError, Scene, Simulation, Total, load_scene, square
from taichi_spmhd.density import SumMass
from taichi_spmhd.runtime import ti
from taichi_spmhd.terms import (
    Cleaning,
    Conductivity,
    DivBSource,
    Induction,
    PassiveDensity,
    Pressure,
    Resistivity,
    Stress,
    Term,
    Viscosity,
)
from taichi_spmhd.types import real, vec3

EQUAL = 1e-12  # of the largest value; sums in another order differ by some 1e-15
REST = (DivBSource(xi=0.5), Viscosity(), Conductivity(), Resistivity(), Cleaning())
ALL = (Stress(), Induction(), *REST)


def close(a, b) -> bool:
    return abs(a - b).max() <= EQUAL * abs(b).max()


def compression(sim):
    """drho/dt / rho from an independent sum over all pairs."""
    reference = Reference(sim.columns(), BOX)
    return reference.drho / reference.rho


def test_both_forms_of_induction_are_one_equation(simulate, disordered):
    """dB = rho d(B/rho) + B drho/rho for every rate of B: stretching, resistivity and cleaning."""
    base, other = disordered(*ALL), simulate(disordered_scene(Stress(), Induction(form="B"), *REST))
    c, rates, found = base.columns(), base.rates(), other.rates()
    assert "b" not in found and "b" not in other.particles.members
    assert close(found["B"], c["rho"][:, None] * rates["b"] + c["B"] * compression(base)[:, None])
    for name in set(rates) - {"b"}:
        assert close(found[name], rates[name]), name


def test_the_rate_of_E_is_that_of_its_parts(simulate, disordered):
    base, other = disordered(*ALL), simulate(disordered_scene(*ALL, energy=Total()))
    c, rates, found = base.columns(), base.rates(), other.rates()
    assert "u" not in found and close(other["u"], c["u"])
    field = dot(c["B"], rates["b"]) + dot(c["B"], c["B"]) / (2 * c["rho"]) * compression(base)
    assert close(found["E"], dot(c["v"], rates["v"]) + rates["u"] + field)


def test_all_other_forms_together_are_still_the_same_equations(simulate, disordered):
    """Each sums the compression for itself: together they must not count it twice."""
    terms = (Stress(), Induction(form="B"), *REST, PassiveDensity())
    base, other = disordered(*ALL), simulate(disordered_scene(*terms, energy=Total()))
    c, rates, found = base.columns(), base.rates(), other.rates()
    closing = compression(base)
    field = dot(c["B"], rates["b"]) + dot(c["B"], c["B"]) / (2 * c["rho"]) * closing
    assert close(found["B"], c["rho"][:, None] * rates["b"] + c["B"] * closing[:, None])
    assert close(found["E"], dot(c["v"], rates["v"]) + rates["u"] + field)
    assert close(found["rho_evolved"], c["rho"] * closing)


def test_two_terms_that_sum_under_one_name_are_refused():
    @dataclass(frozen=True)
    class Twin(Term):
        """S again"""

        sums = {"S": real}

    with pytest.raises(InputError, match="both sum S"):
        disordered_scene(*ALL, Twin())


@pytest.mark.parametrize("xi", [0.0, 0.5, 1.0])
def test_the_rate_of_E_is_the_sum_of_fluxes_and_the_xi_term(simulate, xi):
    """dE_i = - sum_j m_j ( v_j.T_i.g_i + v_i.T_j.g_j ) - xi (v_i.B_i) S_i   (lecture p. 19; physics.md 3.5)."""
    source = (DivBSource(xi=xi),) if xi else ()
    sim = simulate(disordered_scene(Stress(), Induction(), *source, energy=Total()))
    c, s = sim.columns(), Reference(sim.columns(), BOX)
    P, B, v = c["P"] + 0.5 * dot(c["B"], c["B"]), c["B"], c["v"]
    Bi, Bj = s.along(B)

    def flux(v, P, B, along, G):
        """v.T.e G"""
        return (P * dot(v, s.e) - dot(v, B) * along) * G

    own = flux(v[None], P[:, None], B[:, None], Bi, s.Gi) + flux(v[:, None], P[None], B[None], Bj, s.Gj)
    expected = -own.sum(1) - xi * dot(v, B) * s.S()
    assert close(sim.rates()["E"], expected)
    total, scale = dot(c["m"], sim.rates()["E"]), dot(c["m"], abs(sim.rates()["E"]))
    assert (abs(total) < EQUAL * scale) == (xi == 0), "E is conserved without the source, and only then"


def test_hydrodynamics_with_E_needs_no_field(simulate):
    terms = (Pressure(), Viscosity())
    a, b = (simulate(disordered_scene(*terms, **given)) for given in ({}, {"energy": Total()}))
    c, rates = a.columns(), a.rates()
    assert "B" not in b.particles.members and "b" not in b.particles.members
    assert close(b.rates()["E"], dot(c["v"], rates["v"]) + rates["u"])


def test_both_energies_give_the_same_run(simulate):
    """An Alfven wave, 40 and 80 steps: what differs is the time step's error, of second order."""
    found = {}
    for label, steps in (("coarse", 40), ("fine", 80)):
        # no dissipation: what acts on approaching pairs alone has a kink, which costs an order
        scene = load_scene("alfven_tensile", nx=16)["xi = 1/2"].without(Viscosity, Resistivity)
        scene = scene.but(density=SumMass(tolerance=1e-12))  # E holds B^2/(2 rho): an error of rho is one of u
        sims = [simulate(scene), simulate(scene.but(energy=Total()))]
        for sim in sims:
            for _ in range(steps):
                sim.step(0.2 / steps)
        a, b = (sim.columns() for sim in sims)
        found[label] = abs(a["u"] / b["u"] - 1).max()
        drift = sims[1].summary()
        assert drift["energy_drift"] == pytest.approx(drift["energy_drift_predicted"], abs=2e-6)
    assert found["coarse"] < 2e-5 and found["coarse"] / found["fine"] > 3


def test_a_run_whose_thermal_energy_runs_out_stops_and_names_the_particle(simulate):
    @dataclass(frozen=True)
    class Drain(Term):
        """du_i/dt = -100"""

        @ti.func
        def local(self, i, now):
            return ti.Struct(u=ti.cast(-100.0, float))

    x = square((1.0, 1.0), 12)
    scene = Scene(box=(1.0, 1.0), positions=x, start=lambda _: {"rho": 1.0, "P": 1.0}, terms=(Pressure(), Drain()))
    sim = simulate(scene.but(energy=Total()))
    with pytest.raises(RunError, match="member u, largest rate from"):
        sim.run()


@dataclass(frozen=True)
class Largest(Term):
    """v' = now.fastest, now.nearest: so that a test sees what terms see."""

    reads, evolves = {"v": vec3, "rho": real}, {"seen": vec3}
    mosts = {"fastest": real, "densest": real}

    @ti.func
    def most(self, i):
        return ti.Struct(fastest=i.v.norm(), densest=i.rho)

    @ti.func
    def local(self, i, now):
        return ti.Struct(seen=ti.Vector([now.fastest, now.densest, 0.0]))


def test_now_holds_the_largest_of_what_every_particle_says(simulate):
    sim = simulate(disordered_scene(Pressure(), Largest()))
    seen, c = sim.rates()["seen"], sim.columns()
    assert (seen[:, 0] == seen[0, 0]).all() and (seen[:, 1] == c["rho"].max()).all()
    assert seen[0, 0] == pytest.approx(np.linalg.norm(c["v"], axis=1).max(), rel=1e-14)


def test_wrong_forms_are_refused_with_the_cure():
    with pytest.raises(InputError, match='give "B/rho"'):
        Induction(form="b")
    with pytest.raises(InputError, match="list Induction"):
        disordered_scene(Pressure(), Cleaning(), start=chaos)
    with pytest.raises(InputError, match=r"Thermal\(\)"):
        disordered_scene(Pressure(), energy=SumMass())


def test_a_state_of_the_other_form_is_refused(simulate, tmp_path):
    scene = load_scene("alfven_tensile", nx=12)["xi = 1/2"]
    simulate(scene).save(tmp_path / "state.npz")
    others = tuple(Induction(form="B") if isinstance(term, Induction) else term for term in scene.terms)
    for other in (scene.but(energy=Total()), scene.but(terms=others)):
        with pytest.raises(InputError, match="saved by another scene"):
            Simulation.load(tmp_path / "state.npz", other)
