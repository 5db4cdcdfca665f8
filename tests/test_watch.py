"""The watch over a run: it sees the energy the ledger sees, changes no bit, and costs next to nothing."""

import os
import statistics
import subprocess
import sys
import time
from math import inf
from pathlib import Path

import pytest
from conftest import chaos, disordered_scene

from taichi_spmhd import Guard, Heun, Isothermal, Simulation, Total
from taichi_spmhd.bench import cases
from taichi_spmhd.diagnostics.ledger import energies, predicted
from taichi_spmhd.launching import Method
from taichi_spmhd.recast import restart
from taichi_spmhd.terms import Cleaning, DivBSource, Induction, Pressure, Resistivity, Stress, Viscosity
from taichi_spmhd.watch import BLOCK, LOOK

MHD = (Stress(), Induction(), DivBSource(0.5), Viscosity(), Resistivity(), Cleaning())
BLIND = Guard(drift=inf, growth=inf, fall=inf)


def cold(x):
    """The start of an isothermal gas."""
    return {name: value for name, value in chaos(x).items() if name not in ("P", "B", "psi")}


SCENES = {
    "MHD": lambda: disordered_scene(*MHD),
    "total energy": lambda: disordered_scene(*MHD, energy=Total(), stepper=Heun()),
    "isothermal": lambda: disordered_scene(Pressure(), Viscosity(), start=cold, eos=Isothermal(1.2)),
}


@pytest.mark.parametrize("name", SCENES)
def test_the_watch_adds_up_the_energy_of_the_ledger(name, simulate):
    sim = simulate(SCENES[name]())
    for _ in range(3):
        sim.step()
    assert len(sim) % BLOCK and len(sim) > BLOCK  # more than one block, the last one short
    columns = sim.columns()
    told, leak = energies(sim, columns), predicted(sim, columns)[0]
    stored, size = sim.watch.energies(sim)
    # numbers of order one from 500 summands in another order: 1e-16 each
    assert leak != 0 and stored == pytest.approx(told["E_tot"] - leak, abs=1e-13 * size)
    assert size >= abs(told["E_tot"]) * (1 - 1e-13)
    assert size == pytest.approx(sum(map(abs, list(told.values())[:-1])), rel=1e-12) or name == "isothermal"


def launches(sim, steps: int) -> list[str]:
    """The kernels that so many steps start, by name."""
    counted, own = [], Method.__call__

    def count(kernel, owner, *given):
        counted.append(kernel.__name__)
        return own(kernel, owner, *given)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Method, "__call__", count)
        for _ in range(steps):
            sim.step()
    return counted


def test_a_look_is_two_launches_in_twenty_steps_and_changes_no_bit(simulate):
    sim, ends = simulate(disordered_scene(*MHD)), []
    for guard in (Guard(), BLIND):
        sim.scene = sim.scene.but(guard=guard)
        sim.step()  # the first step looks once, so that everything is compiled
        made = launches(sim, 2 * LOOK)
        ends.append((sim.particles.table()[0].tobytes(), sim.longest, made.count("tally"), len(made)))
        restart(sim)
    watched, blind = ends
    assert watched[:2] == blind[:2]
    assert watched[2:] == (2, blind[3] + 4) and blind[2] == 0  # tally, and the close before it
    assert sim.watch.sums.nbytes == 2 * 8 * 2  # 500 particles are two blocks: what comes back from the device


def test_a_state_keeps_what_later_looks_compare_with(simulate, tmp_path):
    scene = disordered_scene(Pressure(), Viscosity())
    sim = simulate(scene)
    for _ in range(LOOK + 1):
        sim.step()
    sim.save(tmp_path / "state.npz")
    with Simulation.load(tmp_path / "state.npz", scene) as other:
        assert other.watch.before == sim.watch.before > 0
        assert other.ledger.widest == sim.ledger.widest > 0
        other.step()
        assert other.watch.before == sim.watch.before  # between looks nothing is noted, resumed or not


@pytest.mark.slow
@pytest.mark.parametrize("case", ["mhd2d_f64", "mhd3d_f64"])
def test_the_watch_costs_less_than_a_hundredth_of_a_step(case, simulate):
    sim = simulate(cases.scene(case, {"mhd2d_f64": 128, "mhd3d_f64": 25}[case]))
    for _ in range(6):
        sim.step()
    steps, looks, idle = [], [], []
    for _ in range(8):  # interleaved, so that whatever disturbs the machine disturbs both
        steps.append(seconds(sim.step))
        looks += [seconds(lambda: sim.watch.weigh(sim, 0.5)) for _ in range(3)]
        idle.append(seconds(lambda: [sim.watch.look(sim) for _ in range(100)]) / 100)
    share = (statistics.median(looks) / LOOK + statistics.median(idle)) / statistics.median(steps)
    assert (sim.steps + 1) % LOOK and share < 0.01  # measured 0.0003 to 0.0025


SINGLE = """
from taichi_spmhd import runtime
runtime.init(arch="cpu", precision="f32", threads=2)
with Simulation(cases.scene("mhd2d_f32", 64)) as sim:
    for _ in range(3):
        sim.step()
    columns = sim.columns()
    told = energies(sim, columns)["E_tot"] - predicted(sim, columns)[0]
    print(sim.watch.energies(sim)[0] / told - 1)
"""


@pytest.mark.slow
def test_in_f32_the_watch_adds_up_in_double_precision():
    here = Path(__file__).parent
    paths = os.pathsep.join([str(here), str(here.parent), os.environ.get("PYTHONPATH", "")])
    command = [sys.executable, "-c", f"from test_watch import *\n{SINGLE}"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, env={**os.environ, "PYTHONPATH": paths})
    assert done.returncode == 0, done.stderr[-2000:]
    off = float(done.stdout.split()[-1])
    assert abs(off) < 1e-9  # measured 2e-11; sums in f32 would be off by 1e-7 and more


def seconds(call) -> float:
    """What a call takes."""
    clock = time.perf_counter()
    call()
    return time.perf_counter() - clock
