"""What is said when a run goes wrong: the particle, the place, the term and the time."""

import numpy as np

from .errors import RunError
from .rhs import add
from .runtime import ti


def fail(sim, what: str) -> None:
    """Raises RunError with the particle, the place, the term with the largest share in its rates, and the time."""
    table, ids = sim.particles.table()
    memory, name = (sim.ill - 1, spoilt(sim, table, sim.ill - 1)) if sim.ill else fastest(sim)
    columns = {name: table[:, first : first + kind] for name, kind, first in sim.particles.layout}
    place = ", ".join(f"{c:.4g}" for c in columns["x"][memory])
    term = loudest(sim, memory)
    raise RunError(
        f"{what} at t = {sim.time:.6g}, step {sim.steps + 1}: particle {ids[memory]} at ({place}), member {name}, "
        f"largest rate from {term}; try a smaller time step (stepper cour), more particles, or a remedy for this term"
    )


def spoilt(sim, table: np.ndarray, memory: int) -> str:
    """The evolved member of a particle (at its place in memory) that is not finite, or u where all are."""
    rates = sim.particles.rates()
    first = {name: first for name, _, first in sim.particles.layout}
    ill = [
        name
        for name, values in rates.items()
        if not (np.isfinite(values[memory]).all() and np.isfinite(table[memory, first[name]]))
    ]
    return ill[0] if ill else "u" if "u" in rates else "v"


def fastest(sim) -> tuple[int, str]:
    """The particle (its place in memory) whose thermal energy ran out, else that with the largest acceleration."""
    table, _ = sim.particles.table()
    first = {name: first for name, _, first in sim.particles.layout}
    if "u" in first and not table[:, first["u"]].min() > 0:
        return int(np.argmin(table[:, first["u"]])), "u"
    return int(np.argmax(np.abs(sim.particles.rates()["v"]).sum(axis=1))), "v"


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
        for key in ti.static(rhs.p.names):
            if ti.static(key in rhs.p.vectors):
                out[0] += ti.abs(total[key]).sum()
            else:
                out[0] += ti.abs(total[key])
