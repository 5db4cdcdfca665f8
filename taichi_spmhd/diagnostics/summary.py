"""What summary.json says of a variant, in Python numbers and strings."""

from .clumping import clumping
from .correlation import first_peak
from .errors import errors
from .field import div_B_figures
from .instability import instability
from .ledger import drifts


def summary(sim) -> dict:
    """The per-variant entry of summary.json: size, cost, terms, arrangement, conservation, div B, errors."""
    columns = sim.columns()
    out = {**cost(sim), **contents(sim), **clumping(sim, columns), "first_peak": first_peak(sim, columns)}
    out.update(drifts(sim, columns))
    if "B" in columns:
        out.update({"div_B": div_B_figures(sim, columns), **instability(sim, columns)})
    out["floors"] = int(sim.floors)
    if "switched" in columns:  # steps of particles in which Dual took u from its own equation
        out["energy_switches"] = int(columns["switched"].astype(float).sum())
    found = errors(sim, columns)
    return {**out, "errors": found} if found else out


def cost(sim) -> dict:
    """Particles, time and steps reached, and seconds of stepping; the first step compiles and is not among them."""
    timed = len(sim) * sim.timed
    return {
        "particles": len(sim),
        "t": float(sim.time),
        "steps": int(sim.steps),
        "seconds": float(sim.seconds),
        "seconds_compile": float(sim.seconds_compile),
        "updates_per_s": float(timed / sim.seconds) if sim.seconds > 0 else 0.0,
    }


def contents(sim) -> dict:
    """Terms as a scene file writes them, members allocated and evolved, bytes a particle with the neighbour list."""
    particles = sim.particles
    return {
        "terms": [str(term) for term in sim.scene.terms],
        "members": list(particles.members),
        "evolved": list(particles.names),
        "bytes_per_particle": int(particles.bytes_each + sim.neighbours.bytes_each),
    }
