"""One row of the table: a case run for a while on the device this child has started."""

import statistics
import time

from .. import runtime
from ..simulation import Simulation
from . import cases
from .clocks import PHASES, Clocks
from .yardstick import Yardstick, ratio

WARM_UP = 4  # steps that compile everything and let the list find its pad
STEPS, RUNS = 20, 5
PASSES = 2  # a step reads the list at least this often: density and rates


def row(case: str, nx: int, runs: int = RUNS, steps: int = STEPS, repeats: int = 25) -> dict:
    """Everything `spmhd bench` tells of a case; compile time includes reading Taichi's cache of kernels."""
    with Simulation(cases.scene(case, nx)) as sim:
        clock = time.perf_counter()
        for _ in range(WARM_UP):
            sim.step()
        warm = time.perf_counter() - clock
        made = [run(sim, steps) for _ in range(runs)]
        stick = Yardstick(sim)
        rates, bare = ratio(sim, stick, repeats)
        middle = sorted(made, key=lambda one: one["step_ms"])[len(made) // 2]
        speeds = [1e3 * len(sim) / one["step_ms"] for one in made]
        return {
            "case": case,
            **runtime.started(),
            "particles": len(sim),
            "neighbours": stick.neighbours(),
            **size(sim),
            "updates_per_s": statistics.median(speeds),
            "spread": (max(speeds) - min(speeds)) / statistics.median(speeds),
            **middle,
            "seconds_compile": max(0.0, warm - WARM_UP * middle["step_ms"] / 1e3),
            "rates_ns": rates,
            "yardstick_ns": bare,
            "rates_per_yardstick": rates / bare,
            "list_GB_per_s": traffic(sim, middle),
        }


def run(sim, steps: int) -> dict:
    """Milliseconds a step, in all and in its phases, list builds a step, cores got (fewer than threads: others run)."""
    builds = sim.neighbours.builds
    with Clocks(sim) as clocks:
        clock, work = time.perf_counter(), time.process_time()
        for _ in range(steps):
            sim.step()
        spent, work = time.perf_counter() - clock, time.process_time() - work
    phases = {phase: 1e3 * clocks.seconds[phase] / steps for phase in PHASES}
    builds = (sim.neighbours.builds - builds) / steps
    return {"step_ms": 1e3 * spent / steps, "phases_ms": phases, "builds_per_step": builds, "cores": work / spent}


def size(sim) -> dict:
    """Entries of a list row, bytes of memory a particle."""
    listed = float(sim.neighbours.count.to_numpy().mean())
    state, near = sim.particles.bytes_each, sim.neighbours.bytes_each
    return {"listed": listed, "bytes_per_particle": state + near, "bytes_state": state, "bytes_list": near}


def traffic(sim, step: dict) -> float:
    """GB/s of list entries in density and rates, one pass each: Newton's later passes find a row in the cache."""
    entries = float(sim.neighbours.count.to_numpy().sum())
    seconds = (step["phases_ms"]["density"] + step["phases_ms"]["rates"]) / 1e3
    return PASSES * 4 * entries / seconds / 1e9
