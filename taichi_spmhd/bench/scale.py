"""From 3 10^4 to 10^6 particles: how much dearer a particle becomes once nothing fits into the caches."""

import time

import numpy as np

from ..simulation import Simulation
from . import cases
from .clocks import PHASES
from .measure import WARM_UP, run, size

STEPS = {False: (40, 6), True: (20, 3)}  # quick or not: steps with few and with many particles
READS, WRITES = 8, 5  # whole records a step streams: predict, twice slack, density, close, rates, correct


def row(case: str, quick: bool) -> dict:
    """Time a particle at both sizes, what grew, and the shares of list and memory traffic at the larger one."""
    few, many = cases.LARGE["3d" if "3d" in case else "2d"]
    small, large = (at(case, nx, steps) for nx, steps in zip((few, many), STEPS[quick], strict=True))
    growth = {phase: large["phases_ns"][phase] - small["phases_ns"][phase] for phase in PHASES}
    return {"case": case, "small": small, "large": large, "growth": large["ns"] / small["ns"], "growth_ns": growth}


def at(case: str, nx: int, steps: int) -> dict:
    """ns a particle and step: the faster of two runs."""
    with Simulation(cases.scene(case, nx)) as sim:
        for _ in range(WARM_UP):
            sim.step()
        best = min((run(sim, steps) for _ in range(2)), key=lambda one: one["step_ms"])
        ns = {phase: ms * 1e6 / len(sim) for phase, ms in best["phases_ms"].items()}
        total, bytes_step = best["step_ms"] * 1e6 / len(sim), streamed(sim, best["builds_per_step"])
        return {
            "particles": len(sim),
            "ns": total,
            "phases_ns": ns,
            "builds_per_step": best["builds_per_step"],
            **size(sim),
            "list_share": (ns["sort"] + ns["list"]) / total,
            "bytes_per_step": bytes_step,
            "memory_share": bytes_step / bandwidth() * 1e9 / total,
        }


def streamed(sim, builds: float) -> float:
    """Bytes a particle and step that pass the memory when nothing is cached: records, rates, list (an estimate)."""
    listed = 4 * float(sim.neighbours.count.to_numpy().mean())
    word = sim.particles.word().itemsize
    record, rate = word * sim.particles.width + 4, sum(a[0].nbytes for a in sim.particles.rates().values())
    return (READS + WRITES) * record + 5 * rate + 2 * listed + builds * (4 * record + listed)


def bandwidth(megabytes: int = 256) -> float:
    """Bytes/s of copying an array that fits no cache, read and written bytes counted, one core."""
    source = np.ones(megabytes * 2**17)
    target, best = np.empty_like(source), np.inf
    for _ in range(4):
        clock = time.perf_counter()
        np.copyto(target, source)
        best = min(best, time.perf_counter() - clock)
    return 2 * source.nbytes / best
