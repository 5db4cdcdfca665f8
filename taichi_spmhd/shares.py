"""Who is to blame: what each term adds to the rates of one particle, and what limits its time step."""

import numpy as np

from .rhs import add
from .runtime import ti
from .sums import width
from .types import vec3

SIGNAL, FORCE, HEAT = "the signal speed", "the acceleration", "the loss of heat"


def slowest(sim, t: float) -> tuple[int, str]:
    """The particle (its place in memory) with the shortest own step at time t, and what limits it."""
    rhs = sim.rhs
    names = [SIGNAL, FORCE, HEAT, *(type(part).__name__ for part in (*rhs.dt_terms, *rhs.sum_dt_terms))]
    steps = np.zeros((len(sim), len(names)), sim.particles.word)
    limits(rhs, t, sim.dt, rhs.moment.most, rhs.sums.rows, steps)
    memory, which = np.unravel_index(np.argmin(np.nan_to_num(steps, nan=-np.inf)), steps.shape)
    return int(memory), names[which]


@ti.kernel
def limits(rhs: ti.template(), t: float, dt: float, most: ti.types.ndarray(ndim=1), sums: ti.types.ndarray(ndim=2),
           steps: ti.types.ndarray(ndim=2)):  # fmt: skip
    """The steps that signals, acceleration, heat and the terms allow each particle, by the sums last left behind."""
    for n in range(rhs.p.n):
        i, now = rhs.p.state[n], rhs.moment.now(t, dt, most)
        total = rhs.complete(i, rhs.sums.found(sums, n, rhs.totals), now)
        steps[n, 0] = rhs.signal_step(i, rhs.sums.entry(sums, n, ti.static(width(rhs.totals, rhs.p.dim))))
        steps[n, 1] = rhs.force_step(i, total)
        steps[n, 2] = rhs.heat_step(i, total)
        for k, term in ti.static(enumerate(rhs.dt_terms)):
            steps[n, 3 + k] = term.max_dt(i, now)
        for k, term in ti.static(enumerate(rhs.sum_dt_terms)):
            steps[n, 3 + len(rhs.dt_terms) + k] = term.longest(i, total, now)


def loudest(sim, memory: int) -> str:
    """The term whose contribution to this particle's rates is not finite, or the largest."""
    shares = {}
    for term in sim.rhs.parts:
        if term.has("pair") or term.has("local") or term.has("after"):
            shares[type(term).__name__] = share(sim, term, memory)
    return max(shares, key=shares.get) if shares else "no term"


def share(sim, term, memory: int) -> float:
    """What one term adds to the rates of a particle: the sum of absolute values of the evolved members; inf for NaN."""
    rhs, near, when = sim.rhs, sim.neighbours, (memory, sim.time + sim.dt, sim.dt)
    most, sums, out = rhs.moment.most, rhs.sums.rows, np.zeros(1, sim.particles.word)
    add_up(rhs, sim.one_by_one, term, *when, near.near, near.count, most, sums)
    complete(rhs, term, *when, most, sums, out)
    return float(out[0]) if np.isfinite(out[0]) else np.inf


@ti.kernel
def add_up(rhs: ti.template(), pairs: ti.template(), term: ti.template(), n: ti.i32, t: float, dt: float,
           near: ti.types.ndarray(dtype=ti.i32, ndim=2), rows: ti.types.ndarray(dtype=ti.i32, ndim=1),
           most: ti.types.ndarray(ndim=1), sums: ti.types.ndarray(ndim=2)):  # fmt: skip
    """What one term sums over the neighbours of one particle."""
    for _ in range(1):
        i, total, now = pairs.mine(n, rhs.looked), pairs.lanes.totals(rhs.totals), rhs.moment.now(t, dt, most)
        if ti.static(term.has("pair")):
            for k in range(rows[n]):
                j = pairs.theirs(near, n, k, rhs.looked)
                total.add(term.pair(i, j, rhs.weights(i, j), now), term)
        rhs.sums.keep(sums, n, pairs.lanes, total)


def stated(rhs) -> tuple:
    """(name, whether it is a vector) of every rate a term may state: heat and B/rho, too, where others are evolved."""
    own = (name for name in rhs.p.names if not name.startswith("leak"))  # leaks repeat what is in v and u
    names = (*own, *(name for name in ("u", "b") if name in rhs.totals and name not in rhs.p.names))
    return tuple((name, rhs.totals[name] is vec3) for name in names)


@ti.kernel
def complete(rhs: ti.template(), term: ti.template(), n: ti.i32, t: float, dt: float, most: ti.types.ndarray(ndim=1),
             sums: ti.types.ndarray(ndim=2), out: ti.types.ndarray(ndim=1)):  # fmt: skip
    """The size of the rates made of these sums, and of what the term adds without neighbours."""
    for _ in range(1):
        total, now = rhs.sums.found(sums, n, rhs.totals), rhs.moment.now(t, dt, most)
        if ti.static(term.has("local")):
            add(total, term.local(rhs.p.state[n], now))
        if ti.static(term.has("after")):
            add(total, term.after(rhs.p.state[n], total, now))
        out[0] = 0.0
        for key, vector in ti.static(stated(rhs)):
            if ti.static(vector):
                out[0] += ti.abs(total[key]).sum()
            else:
                out[0] += ti.abs(total[key])
