"""What the discrete equations conserve exactly (physics.md 3.2), on a random disordered periodic set in f64.

Rates are those of the simulation; only the sums over particles are made here.
"""

import numpy as np
import pytest
from conftest import BOX, chaos, disordered_scene
from test_terms import Reference, dot

from taichi_spmhd.diagnostics import energies
from taichi_spmhd.lattice import square
from taichi_spmhd.scene import Scene
from taichi_spmhd.terms import (
    Cleaning,
    Conductivity,
    CullenDehnen,
    DivBSource,
    Induction,
    Pressure,
    Resistivity,
    Stress,
    Viscosity,
)

ROUND_OFF = 1e-12  # of the sum of the absolute contributions; f64 sums of 500 particles reach some 1e-15
MHD = (Stress(), Induction())
DISSIPATION = (Viscosity(), Conductivity(), Resistivity())


def energy_pieces(sim):
    """The contributions m dE/dt of v, u, B/rho, the compression of the field, and psi: rows of shape (N,)."""
    c, rates = sim.columns(), sim.rates()
    drho, m, rho = Reference(c, BOX).drho, c["m"], c["rho"]
    pieces = [dot(c["v"], rates["v"]), rates["u"], dot(c["B"], rates["b"]), dot(c["B"], c["B"]) / (2 * rho**2) * drho]
    if "y" in rates:
        pieces.append(c["y"] * rates["y"] / rho - c["y"] ** 2 / (2 * rho**2) * drho)
    return m * np.array(pieces)


def added(sim, base):
    """What the terms that base does not have add to the rates of v, u and b, with the columns."""
    ours, theirs = sim.rates(), base.rates()
    return sim.columns(), {name: ours[name] - theirs[name] for name in ("v", "u", "b")}


@pytest.mark.parametrize("terms", [(), DISSIPATION, (CullenDehnen(),)], ids=["ideal", "dissipative", "switch"])
def test_momentum_and_energy_are_constant_without_the_source(disordered, terms):
    sim = disordered(*MHD, *terms)
    push = sim["m"][:, None] * sim.rates()["v"]
    assert (abs(push.sum(0)) <= ROUND_OFF * abs(push).sum(0)).all()
    pieces = energy_pieces(sim)
    assert abs(pieces.sum()) <= ROUND_OFF * abs(pieces).sum()


def test_hydrodynamics_conserves_momentum_and_energy(simulate):
    sim = simulate(disordered_scene(Pressure(), start=lambda x: {k: v for k, v in chaos(x).items() if k != "B"}))
    c, rates = sim.columns(), sim.rates()
    push, power = c["m"][:, None] * rates["v"], c["m"] * np.array([dot(c["v"], rates["v"]), rates["u"]])
    assert (abs(push.sum(0)) <= ROUND_OFF * abs(push).sum(0)).all()
    assert abs(power.sum()) <= ROUND_OFF * abs(power).sum()


@pytest.mark.parametrize("xi", [0.5, 1.0])
def test_the_source_changes_momentum_and_energy_as_predicted(disordered, xi):
    sim = disordered(*MHD, DivBSource(xi=xi))
    c, rates, pieces = sim.columns(), sim.rates(), energy_pieces(sim)
    force = -xi * (c["m"] * Reference(c, BOX).S())[:, None] * c["B"]
    leak = dot(force, c["v"])
    assert abs(pieces.sum() - leak.sum()) <= ROUND_OFF * abs(pieces).sum()
    assert abs(leak.sum()) > 1e-3 * abs(leak).sum(), "the drift must not vanish by chance, or nothing was tested"
    assert abs(dot(c["m"], rates["leak_E"]) - leak.sum()) <= ROUND_OFF * abs(leak).sum()
    push = c["m"][:, None] * rates["v"]
    assert (abs(push.sum(0) - force.sum(0)) <= ROUND_OFF * abs(push).sum(0)).all()


@pytest.mark.parametrize(
    "terms", [*((term,) for term in DISSIPATION), DISSIPATION], ids=lambda t: type(t[-1]).__name__ * len(t)
)
def test_dissipation_conserves_energy_and_only_heats(disordered, terms):
    sim = disordered(*MHD, *terms)
    c, extra = added(sim, disordered(*MHD))
    power = c["m"] * np.array([dot(c["v"], extra["v"]), extra["u"], dot(c["B"], extra["b"])])
    assert abs(power.sum()) <= ROUND_OFF * abs(energy_pieces(sim)).sum()
    if Conductivity() in terms:  # it carries heat: none is made, and it flows down the gradient
        if len(terms) == 1:
            assert dot(c["m"] * c["u"], extra["u"]) < 0
    else:
        assert extra["u"].min() >= -ROUND_OFF * abs(extra["u"]).max()
    assert abs(power).max() > 0


def test_the_viscosity_switch_conserves_energy_and_only_heats_whatever_its_alpha(simulate, disordered):
    sim = simulate(disordered_scene(*MHD, CullenDehnen(alpha=1.0)))
    sim.begin()
    table, ids = sim.particles.table()
    column = sim.particles.first["alpha"]
    table[:, column] = np.random.default_rng(5).uniform(0, 1, len(table))
    sim.particles.admit(table, ids)
    c, extra = added(sim, disordered(*MHD))
    power = c["m"] * np.array([dot(c["v"], extra["v"]), extra["u"]])
    assert abs(power.sum()) <= ROUND_OFF * abs(energy_pieces(sim)).sum()
    assert extra["u"].min() >= -ROUND_OFF * abs(extra["u"]).max() and extra["u"].max() > 0


def test_cleaning_takes_from_the_energy_exactly_what_its_damping_does(disordered):
    """At any v: the work of the conjugate operators cancels, and y^2/(2 rho) moves with the flow without a loss."""
    cleaning = Cleaning(sigma=0.3)
    sim = disordered(*MHD, cleaning)
    c, pieces = sim.columns(), energy_pieces(sim)
    damping = c["m"] * cleaning.sigma * c["ch"] * c["y"] ** 2 / (c["h"] * c["rho"])
    assert abs(pieces.sum() + damping.sum()) <= ROUND_OFF * abs(pieces).sum()


def test_magnetic_and_cleaning_energy_never_grow_at_rest(simulate):
    sim = simulate(disordered_scene(*MHD, Cleaning(), start=lambda x: {**chaos(x), "v": 0.0}))
    pieces = energy_pieces(sim)[2:]
    assert pieces.sum() <= ROUND_OFF * abs(pieces).sum()
    assert pieces.sum() < -1e-3 * abs(pieces).sum(), "with psi of order one the damping must be seen"


def test_magnetic_and_cleaning_energy_never_grow_in_a_run(simulate):
    """A peak of div B in gas at rest that the field does not push (Pressure on a lattice): only the cleaning acts."""
    x = square((1.0, 1.0), 24)

    def start(x):
        r2 = ((x - 0.5) ** 2).sum(1) / 0.125
        peak = np.where(r2 < 1, r2**4 - 2 * r2**2 + 1, 0.0)
        return {"rho": 1.0, "P": 6.0, "B": np.stack([peak, 0 * peak, 0 * peak], axis=1), "psi": 0.0}

    terms = (Pressure(), Induction(), Cleaning())
    sim, history = simulate(Scene(box=(1.0, 1.0), positions=x, start=start, terms=terms)), []
    for _ in range(60):
        now = energies(sim)
        history.append(now["E_mag"] + now["E_clean"])
        sim.step()
    assert (np.diff(history) / history[0]).max() < 1e-4  # a step: what the time integration may add
    # the part of the field that is a gradient goes: half of <B^2> of an isotropic peak, and the waves with it
    assert history[-1] < 0.7 * history[0]


def test_the_density_changes_as_the_summation_does(disordered, simulate):
    """d rho/dt with Omega equals a finite difference of the summed density to 1e-6; without Omega it does not."""
    sim = disordered(*MHD)
    c, eps = sim.columns(), 1e-6  # central: the error is eps^2 times a third derivative, round-off 1e-13/eps
    sides = []
    for sign in (1, -1):
        moved = np.mod(c["x"] + sign * eps * c["v"][:, :2], BOX)
        sides.append(simulate(disordered_scene(*MHD).but(positions=moved, start=lambda _: chaos(moved)))["rho"])
    difference = (sides[0] - sides[1]) / (2 * eps)
    s = Reference(c, BOX)
    assert abs(s.drho - difference).max() < 1e-6 * abs(difference).max()
    assert abs(s.drho * c["Omega"] - difference).max() > 0.02 * abs(difference).max()
