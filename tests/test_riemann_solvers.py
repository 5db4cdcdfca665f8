"""The Riemann problem between two particles, with as many steps as the scheme takes, against jump conditions."""

from dataclasses import replace

import numpy as np
import pytest

from taichi_spmhd import InputError, exact
from taichi_spmhd.godunov.hugoniot import Hugoniot, Isothermal
from taichi_spmhd.godunov.rarefaction import ExactRiemann, Fan, IsothermalFan
from taichi_spmhd.godunov.riemann import KEPT, STEPS, Riemann
from taichi_spmhd.runtime import ti

SOLVERS = {
    "adiabatic": Riemann(Hugoniot(5 / 3)),
    "isothermal": Riemann(Isothermal()),
    "adiabatic, exact fans": ExactRiemann(Fan(1.4)),
    "isothermal, exact fans": ExactRiemann(IsothermalFan()),
}


def stars(solver, L, R):
    """P* and v* (N, 2) of sides (rho, P, b2, v), (4,) or (N, 4); P contains b2/2."""
    L, R = (
        np.ascontiguousarray(np.broadcast_to(side, np.broadcast_shapes(np.shape(L), np.shape(R)))) for side in (L, R)
    )
    L, R = np.atleast_2d(L).astype(float), np.atleast_2d(R).astype(float)
    out = np.zeros((len(L), 2))

    @ti.kernel
    def fill(L: ti.types.ndarray(ndim=2), R: ti.types.ndarray(ndim=2), out: ti.types.ndarray(ndim=2)):
        for n in range(out.shape[0]):
            left = ti.Struct(rho=L[n, 0], P=L[n, 1], b2=L[n, 2], v=L[n, 3])
            right = ti.Struct(rho=R[n, 0], P=R[n, 1], b2=R[n, 2], v=R[n, 3])
            P, v = solver.star(left, right)
            out[n, 0], out[n, 1] = P, v

    fill(L, R, out)
    return out


def fluxes(law, sides, P):
    """M^2, its derivative and (rho c_f)^2 (N, 3) of sides (N, 4) at pressures P (N,)."""
    sides, P = np.ascontiguousarray(sides, float), np.ascontiguousarray(np.broadcast_to(P, len(sides)), float)
    out = np.zeros((len(P), 3))

    @ti.kernel
    def fill(s: ti.types.ndarray(ndim=2), P: ti.types.ndarray(ndim=1), out: ti.types.ndarray(ndim=2)):
        for n in range(out.shape[0]):
            side = ti.Struct(rho=s[n, 0], P=s[n, 1], b2=s[n, 2], v=s[n, 3])
            M2, top, bottom = law.flux(side, P[n])
            out[n, 0], out[n, 1], out[n, 2] = M2, top / bottom, law.acoustic(side)

    fill(sides, P, out)
    return out


def drawn(n=200, seed=7, field=True):
    """n sides with rho, gas pressure and b2 over four decades; of b2 some are zero."""
    random = np.random.default_rng(seed)
    rho, gas, b2 = 10 ** random.uniform(-2, 2, (3, n))
    b2 = np.where(random.random(n) < 0.1, 0.0, b2) if field else 0 * b2
    return np.column_stack([rho, gas + 0.5 * b2, b2, random.normal(size=n)])


EXACT = [  # gamma, left, right as rho, P; P*, v* (Inutsuka 2002; Toro)
    (1.4, (1.0, 1.0), (0.125, 0.1), (0.303130, 0.927453)),
    (5 / 3, (1.0, 1.0), (0.125, 0.1), (0.293945, 0.841195)),
    (1.4, (1.0, 1.0), (0.5, 0.2), (0.509864, 0.542771)),
    (5 / 3, (1.0, 3000.0), (1.0, 1e-7), (1336.857, 31.66454)),
]


@pytest.mark.parametrize(("gamma", "left", "right", "known"), EXACT, ids=["sod", "sod 5/3", "inutsuka", "strong"])
def test_a_gas_has_the_star_state_of_the_exact_problem(gamma, left, right, known):
    # measured 1.1e-7 and less: what the polynomial in the rarefaction leaves; the numbers have six digits
    found = stars(ExactRiemann(Fan(gamma)), (*left, 0, 0), (*right, 0, 0))[0]
    assert found == pytest.approx(known, rel=1e-5)
    solved = exact.star_state((left[0], 0, left[1]), (right[0], 0, right[1]), gamma)
    assert found == pytest.approx(solved[:2], rel=5e-7)


def tube(name):
    """Sides of a tube of Ryu & Jones."""
    known = exact.TUBES[name]
    both = []
    for state in (known.states[0], known.states[-1]):
        b2 = state[5] ** 2 + state[6] ** 2
        both.append((state[0], state[1] + 0.5 * b2, b2, state[2]))
    return known.gamma, *both


TWO_SHOCKS = {  # P*, v* with the shock formula on both sides
    "rj1a": (*tube("rj1a"), (158.43968, 0.715309)),
    "rj2a": (*tube("rj2a"), (3.081140, 0.571284)),
    "brio_wu": (2.0, (1, 1.5, 1, 0), (0.125, 0.6, 1, 0), (0.813269, 0.489288)),
    "sod": (1.4, (1, 1, 0, 0), (0.125, 0.1, 0, 0), (0.303254, 0.927838)),
    "inutsuka": (1.4, (1, 1, 0, 0), (0.5, 0.2, 0, 0), (0.510301, 0.543318)),
}


@pytest.mark.parametrize("name", TWO_SHOCKS)
def test_the_tubes_have_their_two_shock_star_state(name):
    # rj1a, the strongest, is 5e-8 off after four steps; the rest is round-off of the six digits
    gamma, left, right, known = TWO_SHOCKS[name]
    assert stars(Riemann(Hugoniot(gamma)), left, right)[0] == pytest.approx(known, rel=1e-5)


def test_the_shock_of_sod_runs_at_its_speed():
    # S = v_R + M_R/rho_R = 1.752156 at the exact P*
    M2 = fluxes(Hugoniot(1.4), [(0.125, 0.1, 0, 0)], 0.3031301780506468)[0, 0]
    assert np.sqrt(M2) / 0.125 == pytest.approx(1.752156, rel=1e-6)


@pytest.mark.parametrize("gamma", [1.05, 1.4, 5 / 3, 2.0, 2.5])
def test_without_a_field_the_mass_flux_is_that_of_a_gas(gamma):
    sides = drawn(field=False)
    P = sides[:, 1] * 10 ** np.random.default_rng(1).uniform(-4, 4, len(sides))
    known = 0.5 * sides[:, 0] * ((gamma + 1) * P + (gamma - 1) * sides[:, 1])
    assert fluxes(Hugoniot(gamma), sides, P)[:, 0] == pytest.approx(known, rel=1e-12)


@pytest.mark.parametrize("law", [Hugoniot(1.4), Hugoniot(2.0), Isothermal()], ids=["1.4", "2", "isothermal"])
def test_weak_waves_are_fast_waves(law):
    sides = drawn()
    M2, _, acoustic = fluxes(law, sides, sides[:, 1]).T
    rho, Pt, b2, _ = sides.T
    assert acoustic == pytest.approx(rho * (law.gamma * (Pt - 0.5 * b2) + b2), rel=1e-13)  # (rho c_f)^2
    assert acoustic == pytest.approx(M2, rel=1e-11)  # measured 4e-13


def compression(rho, P, b2, gamma, after, steps=200):
    """rho*/rho behind a shock to the total pressure `after`, by bisection of the jump of energy.

    Mass: M^2 = (P* - P)/(1/rho - 1/rho*), momentum; B/rho frozen; e + P_t/rho + (M/rho)^2/2 the same on both sides.
    """
    low, high = np.ones_like(rho), np.full_like(rho, (gamma + 1) / (gamma - 1))
    for _ in range(steps):
        x = 0.5 * (low + high)
        M2 = (after - P) / (1 / rho - 1 / (rho * x))
        before = enthalpy(rho, P, b2, gamma) + 0.5 * M2 / rho**2
        behind = enthalpy(rho * x, after, b2 * x**2, gamma) + 0.5 * M2 / (rho * x) ** 2
        low, high = np.where(behind > before, x, low), np.where(behind > before, high, x)
    return x


def enthalpy(rho, P, b2, gamma):
    """e + P_t/rho per mass, e that of gas and field, from the total pressure."""
    return ((P - 0.5 * b2) / (gamma - 1) + 0.5 * b2 + P) / rho


@pytest.mark.parametrize("gamma", [1.4, 5 / 3, 2.0, 2.5])
def test_the_mass_flux_obeys_the_jump_conditions(gamma):
    sides = drawn(400)
    rho, P, b2, _ = sides.T
    after = P * (1 + 10 ** np.random.default_rng(2).uniform(-2, 4, len(rho)))
    x = compression(rho, P, b2, gamma, after)
    assert x.max() / x.min() > 1.5, "weak and strong shocks"
    known = (after - P) / (1 / rho - 1 / (rho * x))
    assert fluxes(Hugoniot(gamma), sides, after)[:, 0] == pytest.approx(known, rel=1e-9)  # bisection: 1e-16/(x-1)


def test_the_isothermal_mass_flux_obeys_its_jump_conditions():
    sides = drawn(400)
    rho, P, b2, _ = sides.T
    x = 1 + 10 ** np.random.default_rng(2).uniform(-2, 3, len(rho))  # rho*/rho
    after = (P - 0.5 * b2) * x + 0.5 * b2 * x**2
    known = (after - P) / (1 / rho - 1 / (rho * x))
    assert fluxes(Isothermal(), sides, after)[:, 0] == pytest.approx(known, rel=1e-10)  # measured 1e-12


def test_the_isothermal_density_is_that_of_the_pressure():
    law = Isothermal()

    @ti.kernel
    def found() -> ti.f64:
        return law.density(7.0, 3.0, 0.5)

    assert found() == 6.0


@pytest.mark.parametrize("law", [Hugoniot(5 / 3), Hugoniot(1.4), Isothermal()], ids=["5/3", "1.4", "isothermal"])
def test_the_slope_of_the_mass_flux_is_its_derivative(law):
    sides = drawn()
    P, eps = sides[:, 1] * 10 ** np.random.default_rng(3).uniform(-2, 3, len(sides)), 1e-5
    above, below = (fluxes(law, sides, P * (1 + s * eps))[:, 0] for s in (1, -1))
    # central difference: eps^2 and round-off/eps
    assert fluxes(law, sides, P)[:, 1] == pytest.approx((above - below) / (2 * eps * P), rel=1e-6)


def collisions(n=300, seed=11, field=True, reach=50.0):
    """Pairs of sides with pressures up to 1e8 apart, closing or parting with up to `reach` sound speeds."""
    random = np.random.default_rng(seed)
    L, R = drawn(n, seed, field), drawn(n, seed + 1, field)
    ratio = 10 ** random.uniform(-8, 8, n)
    R[:, 1] = 0.5 * R[:, 2] + (L[:, 1] - 0.5 * L[:, 2]) * ratio
    sound = np.sqrt(np.maximum(L[:, 1] / L[:, 0], R[:, 1] / R[:, 0]))
    L[:, 3], R[:, 3] = 0.0, random.uniform(-reach, reach, n) * sound
    return L, R


@pytest.mark.parametrize("name", SOLVERS)
def test_extreme_pairs_have_a_positive_pressure(name):
    L, R = collisions(field="fans" not in name)
    P, v = stars(SOLVERS[name], L, R).T
    assert np.isfinite(P).all() and np.isfinite(v).all()
    assert (P / (L[:, 1] + R[:, 1]) >= 0.499 * KEPT ** (STEPS + 1)).all()
    parting, most = R[:, 3] > 0, np.maximum(L[:, 1], R[:, 1])
    assert (P[parting] < most[parting] * (1 + 1e-9)).all()
    assert (P[~parting] > np.minimum(L[:, 1], R[:, 1])[~parting] * (1 - 1e-9)).all()


@pytest.mark.parametrize("name", SOLVERS)
def test_the_pressure_falls_as_the_sides_part(name):
    L, R = collisions(n=20, field="fans" not in name)
    for left, right in zip(L, R, strict=True):
        sound = np.sqrt(max(left[1] / left[0], right[1] / right[0]))
        sweep = np.repeat(right[None], 200, axis=0)
        sweep[:, 3] = np.linspace(-30, 30, 200) * sound
        P = stars(SOLVERS[name], left, sweep)[:, 0]
        # measured 0, but 9e-4 where the last steps of an isothermal fan have not converged
        assert (np.diff(P) <= (1e-3 if name == "isothermal, exact fans" else 1e-9) * (left[1] + right[1])).all()
        assert P[0] > 2 * P[-1]


@pytest.mark.parametrize("name", SOLVERS)
def test_the_observer_moves_and_the_pressure_stays(name):
    L, R = collisions(field="fans" not in name, reach=3.0)
    P, v = stars(SOLVERS[name], L, R).T
    shift = 10 * np.sqrt(L[:, 1] / L[:, 0])
    moved = [np.column_stack([side[:, :3], side[:, 3] + shift]) for side in (L, R)]
    P_moved, v_moved = stars(SOLVERS[name], *moved).T
    size = np.abs(R[:, 3]) + np.abs(v) + shift
    assert P_moved == pytest.approx(P, rel=1e-8)
    assert np.abs(v_moved - v - shift).max() < 1e-11 * size.max()
    assert (np.abs(v_moved - v - shift) < 1e-9 * size).all()


@pytest.mark.parametrize("name", SOLVERS)
def test_the_mirror_changes_the_sign_of_v_only(name):
    L, R = collisions(field="fans" not in name)
    P, v = stars(SOLVERS[name], L, R).T
    turned = [np.column_stack([side[:, :3], -side[:, 3]]) for side in (R, L)]
    P_turned, v_turned = stars(SOLVERS[name], *turned).T
    assert P_turned == pytest.approx(P, rel=1e-12)
    assert v_turned == pytest.approx(-v, rel=1e-12, abs=1e-12 * np.abs(R[:, 3]).max())


PARTING = np.linspace(0, 3, 31)  # v_R - v_L of two equal sides, in sound speeds


@pytest.mark.parametrize(
    ("name", "known"),
    [
        ("isothermal", (np.sqrt(1 + PARTING**2 / 16) - PARTING / 4) ** 2),  # 2 (1 - P)/sqrt(P) = v_R - v_L
        ("isothermal, exact fans", np.exp(-PARTING / 2)),
        ("adiabatic, exact fans", (1 - 0.1 * PARTING) ** 7),
    ],
)
def test_gas_that_parts_keeps_the_pressure_that_it_should(name, known):
    # measured .0088, .0041, .0002; steps that may end at zero lose the pressure of an isothermal gas above 2 c, .35
    R = np.column_stack([np.ones((31, 2)), np.zeros(31), PARTING])
    L = [SOLVERS[name].law.gamma, 1, 0, 0]
    R[:, 0] = L[0]
    assert np.abs(stars(SOLVERS[name], L, R)[:, 0] - known).max() < 0.012


def converged(L, R, solver):
    """The largest relative error of P* and error of v* in sound speeds, against twenty steps."""
    (P, v), (P_end, v_end) = stars(solver, L, R).T, stars(replace(solver, steps=20), L, R).T
    return np.abs(P / P_end - 1).max(), (np.abs(v - v_end) / np.sqrt(L[:, 1] / L[:, 0])).max()


@pytest.mark.parametrize(
    ("name", "within"), [("adiabatic", 1e-9), ("isothermal", 1e-8), ("adiabatic, exact fans", 1e-7)]
)
def test_one_step_is_enough_between_neighbours_in_smooth_flow(name, within):
    # sides a tenth apart in all that they are: measured 5e-11, 1.7e-9 and, of the fitted power, 4e-8
    L, random = drawn(field="fans" not in name), np.random.default_rng(9)
    R = L * (1 + 0.1 * random.uniform(-1, 1, L.shape))
    R[:, 3] = L[:, 3] + 0.1 * random.uniform(-1, 1, len(L)) * np.sqrt(L[:, 1] / L[:, 0])
    assert max(converged(L, R, SOLVERS[name])) < within


@pytest.mark.parametrize("name", SOLVERS)
def test_one_step_is_enough_in_a_collision(name):
    # up to Mach 5 and pressures ten apart: measured 2e-4, 4.3e-3, 8e-4, 3.9e-3
    L, R = collisions(field="fans" not in name)
    random = np.random.default_rng(13)
    R[:, 1] = L[:, 1] * 10 ** random.uniform(-1, 1, len(L))
    R[:, 2] = np.minimum(R[:, 2], R[:, 1])
    R[:, 3] = -random.uniform(0, 5, len(L)) * np.sqrt(SOLVERS[name].law.gamma * L[:, 1] / L[:, 0])
    assert max(converged(L, R, SOLVERS[name])) < 0.01


def test_equal_sides_are_their_own_star_state():
    sides = drawn()
    P, v = stars(SOLVERS["adiabatic"], sides, sides).T
    assert sides[:, 1] == pytest.approx(P, rel=1e-13)
    assert v == pytest.approx(sides[:, 3], rel=1e-13)


@pytest.mark.parametrize("steps", [0, 21])
def test_a_number_of_steps_without_sense_is_refused(steps):
    with pytest.raises(InputError, match=r"must lie in 1\.\.20"):
        Riemann(Hugoniot(), steps)
