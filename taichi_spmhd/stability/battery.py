"""The battery: which trials there are, in which order, and how far each case is from trouble."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from ..errors import InputError
from ..picture import suggestion
from .case import Case
from .cases import CASES
from .presets import PRESETS
from .trial import FAILED, SOUND, trial

BEST = "robust"  # the preset that must be sound everywhere and whose margins are measured


@dataclass(frozen=True)
class Task:
    """One trial to be made; whole: of the whole battery; beyond: harder than the case asks for."""

    case: Case
    preset: str
    value: object
    nx: int
    whole: bool = False
    beyond: bool = False

    def make(self, check: Callable[[], None] = lambda: None) -> dict:
        """Runs it; the row of the table. check(), after every step, may raise to stop."""
        scene = PRESETS[self.preset].scene(self.case.make(self.value, self.nx))
        return {**self.named(), **trial(scene, self.case.limits, check)}

    def named(self) -> dict:
        """What tells it from the others."""
        return {
            "case": self.case.name,
            "hard": self.case.hard,
            "value": self.value,
            "preset": self.preset,
            "nx": self.nx,
            "whole": self.whole,
            "beyond_asked": self.beyond,
        }


def wanted(only: list[str] | None, known: dict, what: str) -> list[str]:
    """The names asked for, in the order of the battery. Raises InputError for one that is not there."""
    for name in only or ():
        if name not in known:
            raise InputError(f"{what} {name}: there is none{suggestion(name, known)}; there are {', '.join(known)}")
    return [name for name in known if not only or name in only]


def best_of(presets: list[str]) -> str:
    """The preset whose margins are told."""
    return BEST if BEST in presets else presets[-1]


def tasks(cases: list[str], presets: list[str], whole: bool, precision: str = "f64") -> Iterator[Task]:
    """All that must be sound, case by case, then for each what is beyond; send(row) what came out of the last one.

    What is beyond is tried until it fails, of one preset: the best there is among those asked for.
    """
    best = best_of(presets)
    for name in cases:
        case = CASES[name]
        nx, values = case.chosen(whole, precision)
        for preset in presets:
            for value in values:
                yield Task(case, preset, value, nx, whole)
        if whole:
            for value in case.further(precision):
                row = yield Task(case, best, value, nx, whole, beyond=True)
                if row and row["verdict"] == FAILED:
                    break


def margin(case: Case, rows: list[dict]) -> str:
    """How far the hard parameter can be turned, in words, from the rows of one preset and precision."""
    own = [row for row in rows if row["case"] == case.name]
    asked = [row for row in own if not row["beyond_asked"]]
    if any(row["verdict"] != SOUND for row in asked):
        bad = next(row for row in asked if row["verdict"] != SOUND)
        return f"{bad['verdict']} at {case.hard} = {shown(bad['value'])}"
    further = [row for row in own if row["beyond_asked"]]
    if not further:
        return "not asked"
    kept = [row for row in further if row["verdict"] == SOUND]
    last = shown(kept[-1]["value"]) if kept else shown(asked[-1]["value"])
    worse = next((row for row in further if row["verdict"] != SOUND), None)
    return f"sound to {last}" + (f", {worse['verdict']} at {shown(worse['value'])}" if worse else ", the last tried")


def shown(value) -> str:
    """A value of a hard parameter."""
    return f"{value:g}" if isinstance(value, float) else str(value)
