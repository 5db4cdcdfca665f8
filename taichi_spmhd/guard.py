"""Guard: how far a run may stray before it is stopped; a run that goes on has the same bits with any."""

from dataclasses import dataclass
from math import inf

from .errors import InputError

HALF = 0.5  # of all energy: what nobody takes for round-off or for the error of a step


@dataclass(frozen=True)
class Guard:
    """Beside what always stops a run (not finite, u <= 0, a collapsed step, lost neighbours); inf: not watched.

    drift: energy off the ledger, over the sum of the absolute energies, looked at every watch.LOOK steps. None: half
    where all terms and choices are the package's own, for then the ledger knows whatever does work; else not watched.
    All scenes of the package stay below 0.01.
    growth: the largest smoothing length over the largest at the start: a particle that flies off alone, or a gas
    thinned out beyond what its particles can show. The density falls by growth^d.
    fall: how many times the longest stable step may shrink within two looks.
    """

    drift: float | None = None
    growth: float = 100.0
    fall: float = 1e4

    def __post_init__(self):
        for name, least in (("drift", 0.0), ("growth", 1.0), ("fall", 1.0)):
            value = getattr(self, name)
            if not (value is None and name == "drift") and not (isinstance(value, float | int) and value > least):
                raise InputError(f"Guard: {name} = {value!r} must be a number above {least:g}; inf: not watched")

    def tolerance(self, parts: tuple) -> float:
        """The drift that stops a scene with these terms and choices."""
        if self.drift is not None:
            return self.drift
        return HALF if all(map(ours, parts)) else inf


def ours(part) -> bool:
    """Whether a part belongs to this package, which books in leak_E what its terms do to the energy."""
    return all(
        kind.__module__.split(".")[0] == __name__.split(".")[0] for kind in type(part).__mro__ if kind is not object
    )
