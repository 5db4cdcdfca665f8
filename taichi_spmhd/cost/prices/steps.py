"""Milliseconds of a step and of its phases, bytes, neighbours: what a price is made of."""

import time

from ...bench.clocks import PHASES, Clocks
from ...runtime import ti

SETTLE = 2  # steps before the clock starts: the list has found its pad, h follows
TURNS = 3  # of the scene and the whole; the quickest of each counts


def timed(sim, steps: int, whole=None) -> dict:
    """The mean of some steps after the start, the phases of a step, one pass of the density sum, memory.

    whole: the scene with everything in it, timed in turn with sim: within a second both meet the same machine.
    """
    sims = [sim, *([whole] if whole else [])]
    for one in sims:
        settled(one)
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


def settled(sim) -> None:
    """Take the first steps."""
    sim.begin()
    for _ in range(SETTLE):
        sim.step()


def turn(sim, steps: int) -> dict:
    """Milliseconds of a step and of its phases, list builds, cores."""
    ti.sync()
    builds = sim.neighbours.builds
    with Clocks(sim) as clocks:
        wall, work = time.perf_counter(), time.process_time()
        for _ in range(steps):
            sim.step()
        wall, work = time.perf_counter() - wall, time.process_time() - work
    return {
        "ms": 1e3 * wall / steps,
        "phases_ms": {phase: 1e3 * clocks.seconds[phase] / steps for phase in PHASES},
        "cores": work / wall,
        "builds_per_step": (sim.neighbours.builds - builds) / steps,
    }


def density_pass(sim) -> float:
    """ms of the density sum where h is already right: one pass over the neighbours."""
    near = sim.neighbours
    sim.density.solve(near.near, near.rows)
    clock = time.perf_counter()
    sim.density.solve(near.near, near.rows)
    ti.sync()
    return 1e3 * (time.perf_counter() - clock)
