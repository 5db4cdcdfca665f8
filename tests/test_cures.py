"""The cures of the tensile instability: their sums, what they keep, what they break, and whether they cure."""

import numpy as np
import pytest
from conftest import BOX, disordered_scene
from test_identities import ROUND_OFF, energy_pieces
from test_terms import EQUAL, Reference, cubic, dot
from test_tensile import growth_rate

from taichi_spmhd import SSPRK3, InputError, Simulation, SumMass, SumVolume, WendlandC4, hexagonal, load_scene
from taichi_spmhd.cli.advice import warnings
from taichi_spmhd.diagnostics.ledger import drifts
from taichi_spmhd.terms import (
    DivBSource,
    Induction,
    LogLinearXi,
    MinimalXi,
    PhantomXi,
    Repulsion,
    Stress,
    StressShift,
    xi_of,
)

MHD = (Stress(), Induction())


def beta(c):
    return 2 * c["P"] / dot(c["B"], c["B"])


def shift(s):
    """T0 of the strongest stress times the sum that would vanish in order."""
    force = -max(0.5 * dot(s.c["B"], s.c["B"]) - s.c["P"]) * s.sum(s.Gi + s.Gj)
    return {"v": force, "leak_E": dot(force, s.c["v"])}


def repulsion(s, eps, n):
    """R from the stress along the pair, near from both kernels at the mean h; dx = h/1.2."""
    B2, (Bi, Bj) = dot(s.c["B"], s.c["B"]), s.along(s.c["B"])
    stress = [s.c["P"][:, None] + 0.5 * B2[:, None] - Bi**2, s.c["P"] + 0.5 * B2 - Bj**2]
    Ri, Rj = (eps * np.where(S < 0, -S, 0) for S in stress)
    near = cubic(2 * s.r / (s.h[:, None] + s.h))[0] / cubic(1 / 1.2)[0]
    force = -s.sum((Ri * s.Gi + Rj * s.Gj) * near**n)
    return {"v": force, "leak_E": dot(force, s.c["v"])}


def source(s, xi):
    """The div B force with xi (N,) a particle."""
    force = -(xi * s.S())[:, None] * s.c["B"]
    return {"v": force, "leak_v": force, "leak_E": dot(force, s.c["v"])}


CASES = {
    "shift": (StressShift(), shift),
    "repulsion": (Repulsion(eps=0.3, n=3), lambda s: repulsion(s, 0.3, 3)),
    "phantom": (DivBSource(PhantomXi()), lambda s: source(s, np.clip((10 - beta(s.c)) / 8, 0, 1))),
    "minimal": (DivBSource(MinimalXi(0.1)), lambda s: source(s, np.clip(0.6 - beta(s.c) / 2, 0, 1))),
}


@pytest.mark.parametrize("term, formula", CASES.values(), ids=CASES)
def test_rates_equal_the_sums_over_all_pairs(disordered, term, formula):
    sim = disordered(*MHD, term)
    s = Reference(sim.columns(), BOX)
    rates, extra, base = sim.rates(), formula(s), {**s.stress(), **s.induction()}
    assert set(rates) == set(extra) | set(base), "rates of members nobody listed, or none of a listed one"
    for name, values in rates.items():
        expected = base.get(name, 0) + extra.get(name, 0)
        assert abs(values - expected).max() <= EQUAL * abs(expected).max(), name
    assert abs(extra["v"]).max() > 0.01 * abs(base["v"]).max(), "too weak to have been tested"


@pytest.mark.parametrize("term", [term for term, _ in CASES.values()], ids=CASES)
def test_the_ledger_states_what_each_cure_adds(disordered, term):
    """Energy: leak_E to 1e-12. Momentum: leak_v for the source, nothing for shift and repulsion."""
    sim = disordered(*MHD, term)
    c, rates, pieces = sim.columns(), sim.rates(), energy_pieces(sim)
    leak = c["m"] * rates["leak_E"]
    assert abs(pieces.sum() - leak.sum()) <= ROUND_OFF * abs(pieces).sum()
    assert abs(leak.sum()) > 1e-3 * abs(leak).sum(), "the leak must not vanish by chance, or nothing was tested"
    push = c["m"][:, None] * rates["v"]
    kick = c["m"] @ rates["leak_v"] if "leak_v" in rates else 0.0
    assert (abs(push.sum(0) - kick) <= ROUND_OFF * abs(push).sum(0)).all()


@pytest.mark.parametrize(
    ("rule", "table"),
    [
        (PhantomXi(), {0: 1, 1.9: 1, 2: 1, 6: 0.5, 9: 0.125, 10: 0, 1e30: 0}),
        (LogLinearXi(), {0: 1, 0.005: 1, 0.01: 1, 0.001**0.5: 0.75, 0.1: 0.5, 5: 0.5, 1e30: 0.5}),
        (LogLinearXi(low=0.1, high=10), {0.01: 1, 1: 0.75, 10: 0.5}),
        (MinimalXi(), {0: 0.55, 0.1: 0.5, 0.5: 0.3, 1: 0.05, 1.1: 0, 1e30: 0}),
        (MinimalXi(margin=-0.1), {0: 0.4, 0.8: 0, 5: 0}),
    ],
    ids=str,
)
def test_rules_of_xi_have_their_values_and_no_jump(rule, table):
    found = xi_of(DivBSource(rule), np.array(list(table), float))
    assert found == pytest.approx(list(table.values()), abs=1e-14)
    # 10^4 steps of 1.4e-3 in ln beta; the steepest, Phantom's at beta = 10, changes xi by 10/8 of that
    assert abs(np.diff(xi_of(DivBSource(rule), np.geomspace(1e-4, 100, 10001)))).max() < 2e-3


def test_xi_of_a_number_and_of_no_term():
    assert (xi_of(DivBSource(0.7), np.ones(3)) == 0.7).all() and (xi_of(None, np.ones(3)) == 0).all()


def test_equal_masses_give_the_same_rates_by_mass_and_by_volume(disordered, simulate):
    """Masses unlike those of `chaos`: all equal. h, rho and Omega are then the same sums."""
    from conftest import chaos

    def equal(x):
        return {**chaos(x), "mass": 1.0 / len(x)}

    cures = (StressShift(), Repulsion())
    mass, volume = (
        simulate(disordered_scene(*MHD, *cures, start=equal, density=kind(tolerance=1e-14))).rates()
        for kind in (SumMass, SumVolume)
    )
    for name, values in mass.items():
        assert abs(volume[name] - values).max() <= EQUAL * abs(values).max(), name


def test_by_volume_unequal_masses_keep_the_momentum(simulate):
    sim = simulate(disordered_scene(*MHD, StressShift(), Repulsion(), density=SumVolume(tolerance=1e-14)))
    push = sim["m"][:, None] * sim.rates()["v"]
    assert (abs(push.sum(0)) <= ROUND_OFF * abs(push).sum(0)).all()


def test_the_drift_of_a_run_is_the_predicted_one(simulate):
    """SSPRK3 leaves an energy error of third order in dt, so what remains of the drift is the ledger's."""
    bare = load_scene("tensile_cures", nx=12, t_end=0.2)["none"]
    found = drifts(simulate(bare.plus(StressShift(), Repulsion()).but(stepper=SSPRK3())).run())
    assert found["energy_drift"] == pytest.approx(found["energy_drift_predicted"], rel=1e-2)
    assert found["momentum_drift"] < 1e-13 and found["momentum_drift_predicted"] == 0.0


def displacement(scene):
    """r.m.s. distance from the regular lattice, whatever the mean drift, as a function of positions."""
    regular, box = hexagonal(scene.box, 16), np.array(scene.box.size)

    def measured(x):
        d = x - regular
        d -= box * np.round(d / box)
        return np.sqrt(((d - d.mean(axis=0)) ** 2).sum(axis=1).mean())

    return measured


@pytest.mark.parametrize("cure", [StressShift(), DivBSource(MinimalXi())], ids=str)
def test_shift_and_minimal_xi_keep_a_noisy_lattice_as_it_is(cure, simulate):
    # 15 dx/v_A are 19 e-foldings of the bare lattice; a stable one only oscillates about its start
    scene = load_scene("uniform_field", nx=16, beta=0.1)["xi = 0"].plus(cure).but(kernel=WendlandC4())
    sim, measured = simulate(scene), displacement(scene)
    worst = max(measured(sim.run(t / 16)["x"]) for t in (5, 10, 15))
    assert worst < 3 * measured(scene.positions)


def test_two_cures_of_the_same_stress_are_refused():
    bare = load_scene("uniform_field", nx=16)["xi = 0"]
    bare.plus(StressShift(), DivBSource(0.0))
    with pytest.raises(InputError, match="list one of them"):
        bare.plus(StressShift(), DivBSource(0.5))


def test_repulsion_without_stress_names_the_cure():
    with pytest.raises(InputError, match="Repulsion reads Pt.*list Stress"):
        load_scene("uniform_field", nx=16)["xi = 0"].plus(Repulsion()).without(Stress)


@pytest.mark.parametrize(
    "make, words",
    [
        (lambda: DivBSource("phantom"), "MinimalXi"),
        (lambda: DivBSource(2.5), "must lie in 0..2"),
        (lambda: DivBSource(float("nan")), "must lie in 0..2"),
        (lambda: LogLinearXi(low=0.1, high=0.01), "low < high"),
        (lambda: MinimalXi(margin=2.0), "0.05 is usual"),
        (lambda: StressShift(lift=-1.0), "lift"),
        (lambda: Repulsion(eps=-0.1), "0.2 is usual"),
        (lambda: Repulsion(n=2.5), "whole number"),
    ],
)
def test_bad_numbers_are_refused_with_the_cure(make, words):
    with pytest.raises(InputError, match=words):
        make()


def test_a_rule_is_readable_and_its_states_are_its_own(disordered, tmp_path):
    sim = disordered(*MHD, DivBSource(MinimalXi(0.1)))
    assert "DivBSource(xi=MinimalXi(margin=0.1))" in sim.scene.sketch()
    sim.save(tmp_path / "state.npz")
    with pytest.raises(InputError, match="another scene.*margin=0.1"):
        Simulation.load(tmp_path / "state.npz", disordered_scene(*MHD, DivBSource(MinimalXi(0.2))))


def test_advice_knows_the_cures(disordered):
    assert warnings(disordered(*MHD, DivBSource(MinimalXi(0.1)))) == []
    assert warnings(disordered(*MHD, StressShift())) == []
    assert "Repulsion only delays it" in warnings(disordered(*MHD, Repulsion(eps=0.3, n=3)))[0]
