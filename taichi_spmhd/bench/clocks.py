"""Where the time of a step goes: the calls a step is made of, each with a clock around it."""

import time

from ..runtime import ti

PHASES = ("sort", "list", "density", "rates", "kick")


def calls(sim) -> list[tuple[str, object, str]]:
    """(phase, owner, method) of everything a step calls. list contains the check whether the list still holds."""
    near, cells, rhs, advance = sim.neighbours, sim.neighbours.cells, sim.rhs, sim.advance
    return [
        *(("sort", cells, name) for name in ("bin", "sort")),
        *(("list", near, name) for name in ("list", "slack")),
        ("density", sim.density, "solve"),
        *(("rates", rhs, name) for name in ("close", "gather", "gathered", "rates", "finish", "alone")),
        *(("kick", advance, name) for name in ("predict", "correct", "forward", "bearable")),
        ("kick", rhs, "settle"),
    ]


class Clocks:
    """with Clocks(sim) as clocks: sim.step() ...; clocks.seconds: {phase: seconds}, list builds when they happen."""

    def __init__(self, sim):
        self.calls = calls(sim)
        self.seconds = dict.fromkeys(PHASES, 0.0)

    def __enter__(self) -> "Clocks":
        for phase, owner, name in self.calls:
            setattr(owner, name, self.timed(phase, getattr(owner, name)))
        return self

    def __exit__(self, *_) -> None:
        for _, owner, name in self.calls:
            delattr(owner, name)  # the class's own method shows again

    def timed(self, phase: str, call):
        """The call, its time added to a phase; the device is waited for, so that no work slips into the next phase."""

        def run(*given):
            clock = time.perf_counter()
            out = call(*given)
            ti.sync()
            self.seconds[phase] += time.perf_counter() - clock
            return out

        return run
