"""What is said when a run goes wrong: the particle, the place, the term and the time."""

import numpy as np

from .errors import RunError


def fail(sim, what: str) -> None:
    """Raises RunError with the particle, the place, the term with the largest share in its rates, and the time."""
    table, ids = sim.particles.table()
    memory, name = worst(sim, table)
    columns = {name: table[:, first : first + kind] for name, kind, first in sim.particles.layout}
    place = ", ".join(f"{c:.4g}" for c in columns["x"][memory])
    term = loudest(sim, memory)
    raise RunError(
        f"{what} at t = {sim.time:.6g}, step {sim.steps + 1}: particle {ids[memory]} at ({place}), member {name}, "
        f"largest rate from {term}; try a smaller time step (stepper cour), more particles, or a remedy for this term"
    )


def worst(sim, table: np.ndarray) -> tuple[int, str]:
    """The particle (in memory order) and the member that are ill, else those with the shortest step."""
    rates = sim.particles.rates()
    for name, kind, first in sim.particles.layout:
        values = table[:, first : first + kind]
        bad = ~np.isfinite(values).all(axis=1)
        if name == "u":
            bad |= values[:, 0] <= 0
        if name in rates:
            bad |= ~np.isfinite(rates[name]).reshape(len(table), -1).all(axis=1)
            if bad.any():
                return int(np.argmax(bad)), name
    return int(np.argmax(np.abs(rates["v"]).sum(axis=1))), "v"


def loudest(sim, memory: int) -> str:
    """The term whose contribution to this particle's rates is not finite, or the largest."""
    shares = {}
    for term in sim.rhs.parts:
        if term.has("pair") or term.has("local"):
            out = np.zeros(1, sim.particles.word)
            sim.rhs.share(term, memory, sim.time + sim.dt, sim.dt, sim.neighbours.near, sim.neighbours.count, out)
            shares[type(term).__name__] = np.inf if not np.isfinite(out[0]) else float(out[0])
    return max(shares, key=shares.get) if shares else "no term"
