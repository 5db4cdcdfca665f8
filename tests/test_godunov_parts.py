"""The parts of Godunov's scheme, one by one: limiters, characteristics, frames, gradients, predicted states, fits."""

import numpy as np
import pytest
from conftest import disordered_scene

from taichi_spmhd import Isothermal, Simulation
from taichi_spmhd.density import SumMass
from taichi_spmhd.godunov.across import across
from taichi_spmhd.godunov.characteristics import crossed, sign
from taichi_spmhd.godunov.limiter import LIMITERS
from taichi_spmhd.godunov.rarefaction import LEAST, Fan, IsothermalFan, eighth
from taichi_spmhd.lattice import cubic, jitter, line, square
from taichi_spmhd.runtime import ti
from taichi_spmhd.stepper import TimeCentred
from taichi_spmhd.terms import GodunovHydro, GodunovMHD, Induction
from taichi_spmhd.vector import Vector3, named, traced

LIMITING = [name for name in LIMITERS if name != "none"]


def applied(row, out, *columns):
    """What row, a ti.func of a vector that returns one of `out` numbers, makes of each row of the columns: (N, out)."""
    table = np.column_stack(np.broadcast_arrays(*columns)).astype(float)
    found, width = np.zeros((len(table), out)), table.shape[1]

    @ti.kernel
    def fill(table: ti.types.ndarray(ndim=2), found: ti.types.ndarray(ndim=2)):
        for n in range(found.shape[0]):
            made = row(ti.Vector([table[n, k] for k in range(width)]))
            for k in ti.static(range(out)):
                found[n, k] = made[k]

    fill(table, found)
    return found


def slopes(n=2000, seed=3):
    """Random slopes and jumps of both signs, some of them zero or equal."""
    random = np.random.default_rng(seed)
    slope, jump = random.normal(size=(2, n))
    slope[:50], jump[50:100] = 0.0, 0.0
    slope[100:150] = jump[100:150]
    return slope, jump


def limit(name, slope, jump):
    rule = LIMITERS[name]

    @ti.func
    def row(q):
        return ti.Vector([rule(q[0], q[1])])

    return applied(row, 1, slope, jump)[:, 0]


@pytest.mark.parametrize("name", LIMITERS)
def test_a_limiter_is_odd_so_that_both_of_a_pair_see_the_same(name):
    slope, jump = slopes()
    assert (limit(name, -slope, -jump) == -limit(name, slope, jump)).all()


@pytest.mark.parametrize("name", LIMITERS)
def test_a_limiter_leaves_linear_data_alone(name):
    slope, _ = slopes()
    assert (limit(name, slope, slope) == slope).all()


@pytest.mark.parametrize("name", LIMITING)
def test_no_state_leaves_the_interval_between_both_particles(name):
    # a state is at +- half of the limited slope from its particle: |part| <= 2 |jump|, and towards the other
    slope, jump = slopes()
    part = limit(name, slope, jump)
    assert (part * jump >= 0).all()
    assert (np.abs(part) <= 2 * np.abs(jump)).all()
    assert (np.abs(part) <= np.abs(slope)).all()
    assert (part != 0).mean() > 0.2 and (part[slope * jump < 0] == 0).all()


def test_the_limiter_is_that_of_iwasaki_and_inutsuka():
    slope, jump = slopes()
    beyond = 2 * slope - jump
    agree = (np.sign(slope) == np.sign(jump)) & (np.sign(beyond) == np.sign(jump))
    size = np.minimum(np.minimum(2 * np.abs(jump), np.abs(slope)), 2 * np.abs(beyond))
    assert limit("II11", slope, jump) == pytest.approx(np.where(agree, np.sign(jump) * size, 0), abs=1e-14)
    gentle = np.where(slope * jump > 0, np.sign(jump) * np.minimum(np.abs(jump), np.abs(slope)), 0)
    assert (limit("minmod", slope, jump) == gentle).all()


@ti.func
def between(q):
    """B*, v* of rho_L, rho_R, s, v_L, v_R, B_L, B_R."""
    B, v = crossed(ti.sqrt(q[0]), ti.sqrt(q[1]), sign(q[2]), q[3], q[4], q[5], q[6])
    return ti.Vector([B, v])


@pytest.mark.parametrize("along", [0.3, -0.3])
@pytest.mark.parametrize("against", [1, -1])
def test_a_simple_alfven_wave_keeps_the_state_it_comes_from(along, against):
    # v = + B/sqrt(rho) runs against the field: for B.e > 0 from R, which is ahead along e, towards L
    rho, (B_L, B_R) = 2.5, np.random.default_rng(1).normal(size=(2, 100))
    v_L, v_R = against * B_L / np.sqrt(rho), against * B_R / np.sqrt(rho)
    B, v = applied(between, 2, rho, rho, along, v_L, v_R, B_L, B_R).T
    from_R = along * against > 0
    assert (B_R if from_R else B_L) == pytest.approx(B, abs=1e-14)
    assert v == pytest.approx(v_R if from_R else v_L, abs=1e-14)


def test_the_star_state_has_the_invariants_of_both_sides():
    random = np.random.default_rng(2)
    rho_L, rho_R = 10 ** random.uniform(-3, 3, (2, 300))
    along, v_L, v_R, B_L, B_R = random.normal(size=(5, 300))
    B, v = applied(between, 2, rho_L, rho_R, along, v_L, v_R, B_L, B_R).T
    s = np.sign(along)
    # v + s B/sqrt(rho) comes from R, v - s B/sqrt(rho) from L, each with the density of its side
    assert v + s * B / np.sqrt(rho_R) == pytest.approx(v_R + s * B_R / np.sqrt(rho_R), rel=1e-9, abs=1e-11)
    assert v - s * B / np.sqrt(rho_L) == pytest.approx(v_L - s * B_L / np.sqrt(rho_L), rel=1e-9, abs=1e-11)


def test_without_a_field_along_the_pair_nothing_is_exchanged():
    # s = 0: weighted means; velocity does not make field nor field velocity
    random = np.random.default_rng(2)
    v_L, v_R, B_L, B_R = random.normal(size=(4, 100))
    B, v = applied(between, 2, 1.0, 4.0, 0.0, v_L, v_R, B_L, B_R).T
    assert pytest.approx(B, abs=1e-14) == (B_R + 2 * B_L) / 3
    assert v == pytest.approx((2 * v_R + v_L) / 3, abs=1e-14)


def directions(dim, n=300):
    """Unit vectors (N, 3), among them the axes, and in 3-D some in the plane z = 0, as in a lattice."""
    e = np.zeros((n, 3))
    e[:, :dim] = np.random.default_rng(dim).normal(size=(n, dim))
    e[50:100, 2] = 0.0
    e[: 2 * dim, :dim] = np.concatenate([np.eye(dim), -np.eye(dim)])
    return e / np.linalg.norm(e, axis=1)[:, None]


def frames(e, dim):
    """The two directions across each e: (N, 2, 3)."""

    @traced
    def axis(*parts):
        return named(Vector3((*parts[:dim], 0.0, 0.0)[:3]))

    @ti.func
    def row(q):
        first, second = across(axis(q[0], q[1], q[2]))
        return ti.Vector([first.x, first.y, first.z, second.x, second.y, second.z])

    return applied(row, 6, *e.T).reshape(-1, 2, 3)


@pytest.mark.parametrize("dim", [1, 2, 3])
def test_e_and_the_directions_across_are_orthonormal(dim):
    e = directions(dim)
    whole = np.concatenate([e[:, None], frames(e, dim)], axis=1)
    # measured 7e-16; near -z the formula of Duff et al. loses nothing
    assert np.abs(whole @ whole.transpose(0, 2, 1) - np.eye(3)).max() < 1e-14


@pytest.mark.parametrize("dim", [1, 2, 3])
def test_both_of_a_pair_use_the_same_directions_up_to_their_signs(dim):
    e = directions(dim)
    one, other = frames(e, dim), frames(-e, dim)
    same = np.abs(one[:, 0, None, :] @ other[:, 0, :, None])[:, 0, 0]
    assert same == pytest.approx(np.ones(len(e)), abs=1e-14)


LATTICES = {1: (line, (1.0,), 60), 2: (square, (1.0, 1.0), 24), 3: (cubic, (1.0, 1.0, 1.0), 12)}


def linear(dim):
    """start(x) with P, v and B linear in x, and their gradients: (d,), (3, d), (3, d)."""
    random = np.random.default_rng(dim)
    dP, dv, dB = random.normal(size=dim), random.normal(size=(3, dim)), random.normal(size=(3, dim))

    def start(x):
        mass = np.random.default_rng(8).uniform(0.8, 1.2, len(x)) / len(x)
        return {"mass": mass, "P": 5 + x @ dP, "v": x @ dv.T, "B": [1.0, -2.0, 0.5] + x @ dB.T}

    return start, dP, dv, dB


@pytest.fixture(scope="module")
def linear_gas():
    """linear_gas(dim, slope, magnetic=, eos=) -> what Linear holds, one for each; shared, so do not step it."""
    built = {}

    def made(dim, slope="own", magnetic=True, eos=None):
        key = (dim, slope, magnetic, eos)
        if key not in built:
            built[key] = Linear(*key)
        return built[key]

    yield made
    for gas in built.values():
        gas.sim.close()


class Linear:
    """The simulation of linear fields on a jittered lattice, begun; who is far from the edges, where fields jump."""

    def __init__(self, dim, slope, magnetic, eos):
        lattice, box, nx = LATTICES[dim]
        start, self.dP, self.dv, self.dB = linear(dim)
        self.div = np.trace(self.dv[:dim])
        terms = (GodunovMHD(), Induction()) if magnetic else (GodunovHydro(),)
        left_out = {name for name, out in (("B", not magnetic), ("P", eos is not None)) if out}
        self.sim = Simulation(
            disordered_scene(
                *terms,
                box=box,
                positions=jitter(lattice(box, nx), box, 0.2, seed=3),
                start=lambda x: {k: v for k, v in start(x).items() if k not in left_out},
                density=SumMass(tolerance=1e-12, slope=slope),
                stepper=TimeCentred(),
                **({} if eos is None else {"eos": eos}),
            )
        )
        self.sim.begin()
        reach = 2.1 * self.sim["h"].max()
        self.inside = (np.abs(self.sim["x"] - 0.5) < 0.5 - reach).all(axis=1)

    def at(self, dt):
        """The simulation after an evaluation for a step of dt."""
        self.sim.rhs.from_density(0.0, dt)
        return self.sim


@pytest.mark.parametrize(("dim", "slope"), [(1, "own"), (2, "own"), pytest.param(3, "mean", marks=pytest.mark.slow)])
def test_gradients_of_linear_fields_are_exact(linear_gas, dim, slope):
    gas = linear_gas(dim, slope)
    sim, inside = gas.at(0.0), gas.inside
    assert inside.sum() >= 8
    # measured 3e-13: sums of some 50 neighbours, and A^-1
    assert np.abs(sim["dP"][inside] - gas.dP).max() < 1e-10
    for a, letter in enumerate("xyz"):
        assert np.abs(sim[f"dv{letter}"][inside] - gas.dv[a]).max() < 1e-10
        assert np.abs(sim[f"dB{letter}"][inside] - gas.dB[a]).max() < 1e-10


def ahead(c, gas, half, gamma, dP=None):
    """P, rho, v and B half a step on, of ideal MHD with these gradients; without B of a gas."""
    dim, dP = len(gas.dP), gas.dP if dP is None else dP
    rho, P, v, div = c["rho"], c["P"], c["v"], gas.div
    B = c.get("B", np.zeros((len(v), 3)))
    force = B[:, :dim] @ gas.dB.T
    force[:, :dim] -= dP + B @ gas.dB
    new = {"P": P * (1 - gamma * half * div), "rho": rho * (1 - half * div), "v": v + half * force / rho[:, None]}
    return new | ({"B": B + half * (B[:, :dim] @ gas.dv.T - div * B)} if "B" in c else {})


@pytest.mark.parametrize(("dim", "slope"), [(1, "own"), (2, "own"), (3, "mean")])
def test_the_predicted_state_is_that_of_ideal_mhd_half_a_step_on(linear_gas, dim, slope):
    gas = linear_gas(dim, slope)
    known = ahead(gas.sim.columns(), gas, 0.05, 5 / 3)
    sim = gas.at(0.0)
    for name in known:  # there is no step yet
        assert (sim[f"{name}_mid"] == sim[name]).all()
    sim = gas.at(0.1)
    for name, value in known.items():
        assert np.abs(value - sim[name])[gas.inside].max() > 1e-3, "the prediction must be seen"
        assert np.abs(sim[f"{name}_mid"] - value)[gas.inside].max() < 1e-10


@pytest.mark.parametrize(("eos", "gamma"), [(None, 5 / 3), (Isothermal(2.0), 1.0)], ids=["adiabatic", "isothermal"])
def test_the_predicted_state_of_a_gas(linear_gas, eos, gamma):
    gas = linear_gas(2, magnetic=False, eos=eos)
    sim = gas.at(0.1)
    # the pressure of isothermal gas is not linear here: its gradient is what the particles have
    known = ahead(sim.columns(), gas, 0.05, gamma, None if eos is None else sim["dP"])
    for name, value in known.items():
        assert np.abs(sim[f"{name}_mid"] - value)[gas.inside].max() < 1e-10


def test_a_step_that_would_change_the_gas_too_much_is_not_predicted(linear_gas):
    gas = linear_gas(2)
    for change, predicted in ((0.69, True), (0.71, False)):  # gamma dt/2 |div v|
        sim = gas.at(2 * change / (5 / 3 * abs(gas.div)))
        assert ((sim["P_mid"] != sim["P"])[gas.inside] == predicted).all()
        assert ((sim["v_mid"] != sim["v"]).any(axis=1)[gas.inside] == predicted).all()


RATIOS = np.geomspace(1e-8, 1 - 1e-9, 4000)


def test_the_eighth_root_is_one_down_to_the_smallest_ratio():
    @ti.func
    def row(q):
        return ti.Vector([eighth(q[0])])

    assert applied(row, 1, RATIOS)[:, 0] == pytest.approx(RATIOS**0.125, rel=1e-14)
    assert applied(row, 1, [0.0, 1e-9, 1.0, 7.0])[:, 0].tolist() == [LEAST, LEAST, 1.0, 1.0]


def fan(law, rho, P0, P):
    """phi and its derivative."""

    @ti.func
    def row(q):
        phi, slope, _ = law.fan(ti.Struct(rho=q[0], P=q[1], b2=0.0, v=0.0), q[2])
        return ti.Vector([phi, slope])

    return applied(row, 2, rho, P0, P).T


@pytest.mark.parametrize(
    ("gamma", "within"), [(1.05, 1e-4), (1.2, 1e-5), (1.4, 2e-6), (5 / 3, 2e-6), (2.0, 2e-6), (2.5, 2e-6)]
)
def test_a_rarefaction_is_that_of_the_power_law(gamma, within):
    # measured 5.3e-5, 6.8e-6, 7e-7 and less: towards gamma = 1 the power becomes a logarithm, singular at P* = 0
    rho, P0 = 3.0, 0.7
    phi, slope = fan(Fan(gamma), rho, P0, P0 * RATIOS)
    c, small = np.sqrt(gamma * P0 / rho), (gamma - 1) / (2 * gamma)
    known = 2 * c / (gamma - 1) * np.expm1(small * np.log(RATIOS))
    assert phi == pytest.approx(known, rel=within)
    # 1/(rho c) along the fan
    assert slope == pytest.approx(RATIOS ** (small - 1) / (rho * c), rel=1e-4)  # measured 3e-5


def test_an_isothermal_rarefaction_is_that_of_the_logarithm():
    phi, slope = fan(IsothermalFan(), 3.0, 0.75, 0.75 * RATIOS)
    assert phi == pytest.approx(0.5 * np.log(RATIOS), rel=2e-4)  # measured 1e-4, at the smallest ratio
    assert slope == pytest.approx(0.5 / (0.75 * RATIOS), rel=1e-12)
