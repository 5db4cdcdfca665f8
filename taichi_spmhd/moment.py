"""What terms see as `now`: the time, the step being taken, and the largest of what every particle says.

Some effects need one number for all particles: the offset of StressShift, the one cleaning speed. A part gives each
particle's in `most`, names them in `mosts`, and reads the largest as now.NAME in every later hook. Where no part does,
nothing is computed.
"""

import numpy as np

from .runtime import ti
from .vector import traced


@ti.data_oriented
class Moment:
    """Finds the largest numbers once an evaluation and hands them to the kernels as one small array, `most`."""

    def __init__(self, particles, parts: tuple):
        self.p = particles
        self.asked = tuple((part, name) for part in parts if part.has("most") for name in part.mosts)
        self.places = {name: k for k, (_, name) in enumerate(self.asked)}
        self.most = np.zeros(max(1, len(self.asked)), particles.word)

    def find(self) -> None:
        """The largest numbers of the present state; a maximum has the same bits in any order."""
        for k, (part, name) in enumerate(self.asked):
            self.most[k] = self.largest(part, name)

    @ti.kernel
    def largest(self, part: ti.template(), name: ti.template()) -> float:
        found = ti.cast(0.0, float)
        for n in range(self.p.n):
            ti.atomic_max(found, self.chosen(part.most(self.p.state[n]), name))
        return found

    @traced
    def chosen(self, numbers, name: str):
        return getattr(numbers, name)

    @ti.func
    def entry(self, most: ti.template(), k: ti.template()):
        return most[k]

    @traced
    def now(self, t, dt, most):
        """now.t, now.dt, and the largest numbers by name."""
        return ti.Struct({"t": t, "dt": dt, **{name: self.entry(most, k) for name, k in self.places.items()}})
