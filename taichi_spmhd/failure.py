"""What is said when a run goes wrong: the particle, the place, the member, the term, the time, and what to try."""

import numpy as np

from .cures import CAUSES, COLLAPSED, NEGATIVE, NOT_FINITE, STRAYED, cure
from .errors import RunError
from .shares import FORCE, HEAT, SIGNAL, loudest, slowest
from .suspects import coldest, spoilt, suspect


def explained(sim, what: str, cause: str, found: tuple[int, str] | None = None, term: str | None = None,
              advice: str | None = None) -> RunError:  # fmt: skip
    """The error that says so. found: (place in memory, member), term: the one to blame, where they are known."""
    memory, member = found or suspect(sim, cause)
    table, ids = sim.particles.table()
    columns = sim.particles.by_name(table, sim.particles.layout)
    position = columns["x"][memory].astype(float)
    if term is None and cause != STRAYED:  # there the list is of no use
        term = loudest(sim, memory)
    place = ", ".join(f"{c:.4g}" for c in position)
    blame = f", largest rate from {term}" if term else ""
    where = f"particle {ids[memory]} at ({place}), member {member}{blame}"
    return RunError(
        f"{what} at t = {sim.time:.6g}, step {sim.steps + 1}: {where}",
        cause,
        f"try to {advice}" if advice else cure(cause, sim.scene, term, beta(columns, memory)),
        particle=int(ids[memory]),
        position=position,
        member=member,
        term=term,
        time=float(sim.time),
        step=sim.steps + 1,
    )


def beta(columns: dict, memory: int) -> float | None:
    """2P/B^2 of a particle; None without a field."""
    if not {"P", "B"} <= set(columns):
        return None
    B2 = float((columns["B"][memory].astype(float) ** 2).sum())
    found = 2 * float(columns["P"][memory]) / B2 if B2 > 0 else np.nan
    return found if np.isfinite(found) else None


def ill(sim) -> RunError:
    """A stepper found a value that is not finite, or u <= 0."""
    memory = sim.ill - 1
    columns = sim.particles.in_memory()
    member = spoilt(sim, columns, memory)
    rates = sim.particles.rates()
    if member == "u" and np.isfinite(rates["u"][memory]) and np.isfinite(columns["u"][memory]):
        return explained(sim, "negative thermal energy", NEGATIVE, (memory, member))
    return explained(sim, "not finite", NOT_FINITE, (memory, member))


def collapsed(sim, what: str, t: float) -> RunError:
    """No step is left at time t: thermal energy has run out, or whose own step is shortest, and what limits it."""
    columns = sim.particles.in_memory()
    if "u" in columns and not columns["u"].min() > 0:
        return explained(sim, f"{what}, thermal energy has run out", NEGATIVE, coldest(sim, columns))
    memory, limit = slowest(sim, t)
    if limit == HEAT:
        return explained(sim, f"{what}, thermal energy runs out", NEGATIVE, (memory, "u"))
    term = None if limit in (SIGNAL, FORCE) else limit
    return explained(sim, f"{what}, limited by {limit}", COLLAPSED, (memory, "v"), term)


def stepped(sim, dt: float) -> float:
    """One step of the scene's stepper: the longest next one. Raises RunError with all that is known."""
    sim.ill = 0
    try:
        longest = sim.scene.stepper.step(sim, dt)
    except RunError as error:  # from inside an evaluation, which knows neither the particle nor the time
        if error.cause not in CAUSES:
            raise
        raise explained(sim, error.what, error.cause, advice=error.cure) from error
    if sim.ill:
        raise ill(sim)
    return longest
