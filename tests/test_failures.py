"""A run that goes wrong is stopped for what went wrong, and says where, when, by which term, and what to try."""

from dataclasses import dataclass

import numpy as np
import pytest

from taichi_spmhd import (
    Boundary,
    Guard,
    Heun,
    InputError,
    Open,
    Periodic,
    Reflecting,
    RunError,
    Scene,
    Simulation,
    Term,
    Total,
    cures,
    line,
    search,
    square,
)
from taichi_spmhd.recast import restart
from taichi_spmhd.runtime import ti
from taichi_spmhd.terms import Cleaning, DivBSource, Induction, Pressure, Stress, Viscosity
from taichi_spmhd.types import real, vec3
from taichi_spmhd.watch import LOOK

BOX, N = (1.0, 1.0), 12


def gas(*terms, v=None, **changes) -> Scene:
    """A uniform gas of 12 x 12 particles at rest; v: {particle: velocity}."""

    def start(x):
        motion = np.zeros((len(x), 3))
        for k, velocity in (v or {}).items():
            motion[k] = velocity
        return {"rho": 1.0, "P": 0.6, "v": motion}

    given = {"box": BOX, "positions": square(BOX, N), "start": start, "terms": (Pressure(), *terms)}
    return Scene(**{**given, **changes})


def failure(scene: Scene, dt: float | None = None, steps: int = 200) -> RunError:
    """The error that a run of the scene ends with; the simulation is closed."""
    with Simulation(scene) as sim, pytest.raises(RunError) as caught:
        for _ in range(steps):
            sim.step(dt)
    error = caught.value
    assert "\n" not in str(error) and error.what in str(error)
    assert error.cure.startswith("try ") and str(error).endswith(error.cure)
    assert f"particle {error.particle} at (" in str(error) and f"member {error.member}" in str(error)
    assert f"t = {error.time:.6g}, step {error.step}:" in str(error)
    return error


@dataclass(frozen=True)
class Heat(Term):
    """du_i/dt = k for t > 0.05"""

    k: float = 1.0

    @ti.func
    def local(self, i, now):
        return ti.Struct(u=ti.select(now.t > 0.05, self.k, 0.0))


@dataclass(frozen=True)
class Booked(Heat):
    """The same, and the ledger is told"""

    evolves = {"leak_E": real}

    @ti.func
    def local(self, i, now):
        k = ti.select(now.t > 0.05, self.k, 0.0)
        return ti.Struct(u=k, leak_E=k)


@dataclass(frozen=True)
class Bang(Term):
    """dv_i/dt = sqrt(0.03 - t) at x < 0.1: not a number from t = 0.03 on"""

    evolves = {"v": vec3}

    @ti.func
    def local(self, i, now):
        here = ti.select(i.x[0] < 0.1, 0.03 - now.t, 1.0)
        return ti.Struct(v=ti.sqrt(here) * ti.Vector([1.0, 0.0, 0.0]))


@dataclass(frozen=True)
class Slow(Term):
    """dt <= 1 before t = 0.6, `after_it` from then on: after 20 steps of 0.02 to 0.03 and more"""

    after_it: float = 1e-8

    @ti.func
    def max_dt(self, i, now):
        return ti.select(now.t > 0.6, self.after_it, 1.0)


def test_a_value_that_is_not_finite_names_its_particle_and_term():
    error = failure(gas(Bang()))
    assert (error.cause, error.member, error.term) == (cures.NOT_FINITE, "v", "Bang")
    assert error.position[0] < 0.1 and error.position.shape == (2,)  # only these are hit
    assert error.time < 0.03 < error.time + 0.3 * 1.2 / N  # the step that met it; no step is longer than C h / c_s
    assert "another form of Bang" in error.cure


@pytest.mark.parametrize(("energy", "words"), [({}, "Conductivity()"), ({"energy": Total()}, "energy=Thermal()")])
def test_thermal_energy_that_runs_out_is_told_from_what_is_not_finite(energy, words):
    error = failure(gas(Heat(k=-500.0), **energy))  # a step is 0.03: 8 times what there is
    assert (error.cause, error.member, error.term) == (cures.NEGATIVE, "u", "Heat")
    assert words in error.cure


def test_a_step_that_collapses_names_what_limits_it():
    error = failure(gas(Slow(after_it=0.0)))
    assert (error.cause, error.term) == (cures.COLLAPSED, "Slow") and "limited by Slow" in error.what


@pytest.mark.parametrize(("fall", "stopped"), [(1e4, True), (1e9, False)])
def test_a_step_that_falls_within_a_few_steps_is_a_collapse(fall, stopped):
    with Simulation(gas(Slow(), guard=Guard(fall=fall))) as sim:  # from 0.02 to 1e-8, which is no collapse to 1e-10
        try:
            while sim.longest > 1e-3 or not sim.begun:
                sim.step()
            for _ in range(3):
                sim.step()
            error = None
        except RunError as caught:
            error = caught
        assert (error is not None) == stopped
        assert not stopped or (error.cause, error.term) == (cures.COLLAPSED, "Slow")


LONE = {N * N - 1: (40.0, 40.0, 0.0)}  # the corner particle, 30 times faster than sound


def test_a_particle_that_flies_off_into_the_vacuum_is_named():
    error = failure(gas(v=LONE, boundary=Boundary()), dt=0.02)
    assert (error.cause, error.particle, error.member) == (cures.GROWN, N * N - 1, "h")
    # h is half the distance to the others, and 100 times 1.2/12 is allowed: 20 away, less than a step (0.8) more
    assert 20 < np.hypot(*(error.position - 1)) < 24
    assert "growth" in error.cure


def test_growth_may_be_allowed():
    with Simulation(gas(v=LONE, boundary=Boundary(), guard=Guard(growth=float("inf")))) as sim:
        for _ in range(30):  # the one before is stopped after 18
            sim.step(0.02)
        assert sim["h"].max() > 100 * 1.2 / N


def test_a_support_that_outgrows_the_box_is_named_with_its_particle():
    # open along x, a period of 1 along y: the lone particle's support passes 0.5 before it is 1 away
    error = failure(gas(v={N * N - 1: (40.0, 0.0, 0.0)}, boundary=Boundary(y=Periodic())), dt=0.005)
    assert (error.cause, error.particle, error.member) == (cures.GROWN, N * N - 1, "h")
    assert "outgrown the box" in error.what


def test_two_that_part_from_all_others_have_lost_their_neighbours():
    # on a line two can share a support, but no gradient is seen with one neighbour
    v = {30: (50.0, 0.0, 0.0), 31: (50.0, 0.0, 0.0)}
    x = line((1.0,), 32)
    error = failure(gas(v=v, box=(1.0,), positions=x, boundary=Boundary(x=Open())), dt=0.002)
    assert error.cause == cures.LOST and error.particle in (30, 31) and error.position[0] > 1
    assert "1 left in 1-D" in error.what and "h_fact" in error.cure


def test_a_list_that_would_fill_the_memory_names_who_strayed():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(search, "MOST_BYTES", 4.0 * N * N * 100)  # rows of 100 entries
        error = failure(gas(v=LONE, boundary=Boundary(), guard=Guard(growth=float("inf"))), dt=0.02)
    assert (error.cause, error.particle, error.term) == (cures.STRAYED, N * N - 1, None)


def test_two_that_meet_on_one_spot_are_named():
    # powers of two: after one step of 1/128 particle 15 is where 16 is, to the last bit. On a line two on one spot
    # are more than any h wants (2 against h_fact/sigma = 1.8)
    x = (np.arange(32) + 0.5) / 32
    scene = gas(v={15: (4.0, 0, 0)}, box=(1.0,), positions=x)
    error = failure(scene.but(boundary=Boundary(x=Periodic())), dt=1 / 128)
    assert error.cause == cures.MET and error.particle in (15, 16) and "Viscosity()" in error.cure


def test_a_particle_that_passes_a_wall_is_named():
    wall = Boundary(x=Reflecting(), y=Periodic())
    error = failure(gas(v={N * N - 1: (40.0, 0.0, 0.0)}, boundary=wall), dt=0.01)
    assert (error.cause, error.particle, error.member) == (cures.PASSED_WALL, N * N - 1, "x")
    assert error.position[0] > 1 and "Viscosity()" in error.cure


def test_energy_off_the_ledger_stops_a_run_at_the_next_look():
    with Simulation(gas(Heat(), guard=Guard(drift=0.01))) as sim:
        times = []
        with pytest.raises(RunError) as caught:
            sim.run(1.0, watch=lambda sim: times.append(sim.time))
        # u = 0.9 and k = 1: 1 % is off 0.009 after t = 0.05, and the end of that step is looked at within LOOK steps
        off = next(k for k, t in enumerate(times) if t > 0.05 + 0.01 * 0.9 / 0.98)
    error = caught.value
    assert (error.cause, error.term) == (cures.DRIFT, "Heat") and error.step % LOOK == 0
    assert off < error.step <= off + LOOK + 1 and error.member == "u" and "leak_E" in error.cure


@pytest.mark.parametrize("scene", [gas(Heat()), gas(Booked(), guard=Guard(drift=1e-6))], ids=["own", "booked"])
def test_a_term_of_the_scene_may_heat_the_gas_when_it_is_booked_or_not_asked_about(scene):
    with Simulation(scene) as sim:
        sim.run(1.0)
        assert sim["u"].mean() == pytest.approx(0.9 + 0.95, rel=0.01)  # 100 % more: half of all energy, and above


def test_the_package_s_own_terms_are_watched_unless_told_otherwise():
    with Simulation(gas()) as sim:
        sim.begin()
        sim.ledger.E0 *= 3.1  # as if two thirds of the energy had gone: more than half of what is there
        with pytest.raises(RunError, match="off the ledger") as caught:
            sim.run(1.0)
        assert caught.value.step == LOOK
        sim.scene = sim.scene.but(guard=Guard(drift=float("inf")))
        sim.run(1.0)
        assert sim.time == 1.0


def test_what_a_guard_cannot_be_is_refused():
    for wrong in ({"drift": -1.0}, {"growth": 0.5}, {"fall": None}, {"drift": float("nan")}):
        with pytest.raises(InputError, match=f"Guard: {next(iter(wrong))}"):
            Guard(**wrong)
    with pytest.raises(InputError, match="guard"):
        gas(guard=0.1)


def magnetic(*terms) -> Scene:
    """A gas with a field of beta = 0.12."""

    def start(x):
        return {"rho": 1.0, "P": 0.06, "B": [1.0, 0.0, 0.0]}

    return gas(start=start).but(terms=(Stress(), Induction(), *terms))


ADVICE = {
    "a field without its remedies": (
        magnetic(),
        "Stress",
        0.12,
        "DivBSource(xi=0.5) and Cleaning() (beta = 0.12 there)",
    ),
    "half a remedy": (magnetic(DivBSource(0.2), Cleaning()), "DivBSource", 0.12, "DivBSource(xi=0.5) (beta"),
    "a weak field": (magnetic(), "Stress", 12.0, "try Cleaning() (beta = 12"),
    "all remedies taken": (magnetic(DivBSource(0.5), Cleaning()), "Stress", 0.12, "try a smaller time step"),
    "a term with numbers": (gas(Viscosity()), "Viscosity", None, "smaller numbers in Viscosity (alpha = 1, beta = 2)"),
    "no term": (gas(), None, None, "try a smaller time step"),
}


@pytest.mark.parametrize(("scene", "term", "beta", "words"), ADVICE.values(), ids=ADVICE)
def test_the_advice_is_for_this_term_at_this_place(scene, term, beta, words):
    said = cures.cure(cures.NOT_FINITE, scene, term, beta)
    assert words in said and said.startswith("try ") and "\n" not in said


def test_a_violent_collision_without_viscosity_is_told_its_beta():
    # a cold, strongly magnetised gas thrown together: whatever goes wrong first is told with the field's remedies
    def start(x):
        v = np.stack([-30 * np.sign(x[:, 0] - 0.5), 0 * x[:, 0], 0 * x[:, 0]], axis=1)
        return {"rho": 1.0, "P": 1e-4, "B": [1.0, 1.0, 0.0], "v": v}

    error = failure(magnetic().but(start=start, stepper=Heun()))
    assert error.cause in cures.BY_RATES and "DivBSource(xi=0.5)" in error.cure and "beta = " in error.cure


def test_a_run_taken_up_again_or_started_anew_is_stopped_where_the_undisturbed_one_is(tmp_path):
    scene, path, ends = gas(Heat(), guard=Guard(drift=0.01)), tmp_path / "state.npz", []

    def stopped(sim, **more) -> None:
        with pytest.raises(RunError) as caught:
            sim.run(1.0, **more)
        ends.append((caught.value.step, caught.value.time, caught.value.particle))

    with Simulation(scene) as sim:
        stopped(sim, watch=lambda sim: sim.save(path) if sim.steps == LOOK // 2 else None)
        restart(sim)
        stopped(sim)
    with Simulation.load(path, scene) as sim:
        stopped(sim)
    assert ends[0] == ends[1] == ends[2]
