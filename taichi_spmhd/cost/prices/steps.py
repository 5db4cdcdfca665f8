"""Milliseconds of a step and of its phases, bytes, neighbours: what a price is made of."""

import time

from ...bench.clocks import PHASES, Clocks
from ...runtime import ti

SETTLE = 2  # steps before the clock starts: the list has found its pad, h follows


def timed(sim, steps: int) -> dict:
    """The mean of some steps after the start, the phases of a step, one pass of the density sum, memory."""
    sim.begin()
    for _ in range(SETTLE):
        sim.step()
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
        "pass_ms": density_pass(sim),
        "cores": work / wall,
        "builds_per_step": (sim.neighbours.builds - builds) / steps,
        "particles": len(sim),
        "members": sorted(sim.particles.members),
        "bytes_state": int(sim.particles.bytes_each),
        "bytes_list": int(sim.neighbours.bytes_each),
        "listed": float(sim.neighbours.count.to_numpy().mean()),
    }


def density_pass(sim) -> float:
    """ms of the density sum where h is already right: one pass over the neighbours."""
    near = sim.neighbours
    sim.density.solve(near.near, near.rows)
    clock = time.perf_counter()
    sim.density.solve(near.near, near.rows)
    ti.sync()
    return 1e3 * (time.perf_counter() - clock)
