"""Milliseconds of a step and of its phases, bytes, neighbours: what a price is made of."""

import time

from ...bench.clocks import PHASES, Clocks
from ...recast import restart
from ...runtime import ti

SETTLE, RUN = 1, 5  # steps from the start before the clock runs, and while it runs
TURNS = 3  # of the scene and the whole; the quickest of each counts


def timed(sim, steps: int, whole=None) -> dict:
    """The mean of some steps after the start, the phases of a step, one pass of the density sum, memory.

    whole: the scene with everything in it, timed in turn with sim: within a second both meet the same machine. Never
    far from the start: later a gas without viscosity is another gas, which needs lists more often.
    """
    sims = [sim, *([whole] if whole else [])]
    turns = [[turn(one, steps) for one in sims] for _ in range(TURNS)]
    own, *other = [min(turns, key=lambda made, k=k: made[k]["ms"])[k] for k in range(len(sims))]
    return {
        **own,
        "whole_ms": other[0]["ms"] if other else own["ms"],
        "pass_ms": density_pass(sim),
        "particles": len(sim),
        "members": sorted(sim.particles.members),
        "bytes_state": int(sim.particles.bytes_each),
        "bytes_list": int(sim.neighbours.bytes_each),
        "listed": float(sim.neighbours.count.to_numpy().mean()),
    }


def turn(sim, steps: int) -> dict:
    """Milliseconds of a step and of its phases, list builds, cores: of some steps, RUN at a time from the start."""
    runs = [run(sim) for _ in range(-(-steps // RUN))]
    mean = {name: sum(made[name] for made in runs) / (len(runs) * RUN) for name in runs[0] if name != "phases"}
    phases = {phase: 1e3 * sum(made["phases"][phase] for made in runs) / (len(runs) * RUN) for phase in PHASES}
    cores = mean["work"] / mean["wall"]
    return {"ms": 1e3 * mean["wall"], "phases_ms": phases, "cores": cores, "builds_per_step": mean["builds"]}


def run(sim) -> dict:
    """Seconds, of all and of the phases, processor seconds and list builds of RUN steps."""
    restart(sim)
    sim.begin()
    for _ in range(SETTLE):
        sim.step()
    ti.sync()
    builds = sim.neighbours.builds
    with Clocks(sim) as clocks:
        wall, work = time.perf_counter(), time.process_time()
        for _ in range(RUN):
            sim.step()
        wall, work = time.perf_counter() - wall, time.process_time() - work
    return {"wall": wall, "work": work, "builds": sim.neighbours.builds - builds, "phases": clocks.seconds}


def density_pass(sim) -> float:
    """ms of the density sum where h is already right: one pass over the neighbours."""
    near = sim.neighbours
    sim.density.solve(near.near, near.rows)
    clock = time.perf_counter()
    sim.density.solve(near.near, near.rows)
    ti.sync()
    return 1e3 * (time.perf_counter() - clock)
