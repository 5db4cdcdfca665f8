"""Setting: one point of the grid, and how much work it will be."""

import json
from dataclasses import dataclass, field
from functools import cached_property

from ..scene import Scene

PLACES = ("precision", "threads")  # what is fixed for the whole life of a process
STAGES = {"LeapfrogKDK": 1, "Heun": 2, "SSPRK3": 3}  # evaluations of the rates a step


@dataclass(frozen=True)
class Setting:
    """parameters: those of the scene file that vary; changes: choices that vary; variant: the label; precision and
    threads: of the process that runs it; work: predicted, in particle-neighbour visits."""

    parameters: dict
    changes: dict
    variant: str
    precision: str = "f64"
    threads: int = 1
    work: float = field(default=0.0, compare=False)

    @cached_property
    def key(self) -> str:
        """The same for the same setting, in any process."""
        return json.dumps([self.parameters, self.changes, self.variant, self.precision, self.threads], sort_keys=True)

    def values(self) -> dict:
        """{name: value} of everything that says which setting it is."""
        return {
            "variant": self.variant,
            **self.parameters,
            **self.changes,
            "precision": self.precision,
            "threads": self.threads,
        }


def work(scene: Scene) -> float:
    """Particles times neighbours times evaluations of the rates; steps go with the spacing and the Courant number."""
    n, kernel = len(scene.positions), scene.kernel.at(scene.dim)
    steps = n ** (1 / scene.dim) / (kernel.h_fact * getattr(scene.stepper, "cour", 0.3))
    return n * (kernel.neighbours + 20) * steps * STAGES.get(type(scene.stepper).__name__, 1)
