"""What is said when a run goes wrong: the particle, the place, the term and the time."""

import numpy as np

from .errors import RunError


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
            out = np.zeros(1, sim.particles.word)
            sim.rhs.share(
                term,
                memory,
                sim.time + sim.dt,
                sim.dt,
                sim.neighbours.near,
                sim.neighbours.count,
                sim.rhs.moment.most,
                out,
            )
            shares[type(term).__name__] = np.inf if not np.isfinite(out[0]) else float(out[0])
    return max(shares, key=shares.get) if shares else "no term"
