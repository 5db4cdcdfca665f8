"""Simulation: a scene at work. Wiring and stepping only."""

import time
from collections.abc import Callable, Iterator

import numpy as np

from . import runtime, state
from .advance import Advance
from .errors import InputError, RunError
from .failure import collapsed, stepped
from .lanes import best as lanes
from .neighbours import Neighbours
from .pairs import Pairs
from .particles import Particles
from .readable import Readable
from .rhs import RHS
from .scene import Scene
from .sliding import Sliding
from .smoothing import Density
from .types import integer
from .watch import Watch

SMALLEST_STEP = 1e-10  # of the time to simulate: a step shorter than this has collapsed


class Simulation(Readable):
    """The particles of a scene and what moves them.

        sim = Simulation(scene); sim.run(until=0.5); sim["rho"], sim.time, sim.steps, len(sim)

    spare: None, and all numbers are compiled in; or, for a live run (live/), parts that may be switched on later, whose
    members are allocated too: then numbers slide (sliding.py) and terms can be switched (recast.py).
    Raises InputError for a start that cannot be simulated, RunError (from step, run, frames) when a run goes wrong.
    """

    def __init__(self, scene: Scene, start: dict | None = None, spare: tuple | None = None):
        runtime.ensure()
        self.scene, self.dim = scene, scene.dim
        self.time, self.steps, self.floors, self.ill = 0.0, 0, 0, 0
        self.seconds, self.seconds_compile, self.dt, self.longest = 0.0, 0.0, 0.0, 0.0
        self.begun = False
        self.timed, self.warm, self.ledger = 0, False, None  # steps whose seconds count; kernels compiled
        values = start if start is not None else state.opening(scene)
        try:
            self._build(scene, len(values["m"]), spare)
            state.fill(self, values)
        except BaseException:
            self.close()
            raise

    def _build(self, scene: Scene, n: int, spare: tuple | None) -> None:
        kernel = scene.kernel.at(self.dim)
        state.check_box(scene, kernel, n)
        parts = (*(part.at(self.dim) for part in scene.parts), *(spare or ()))
        members = {k: v for part in parts for k, v in part.members().items()}
        evolved = {k: v for part in parts for k, v in part.evolves.items()}
        frozen = scene.boundary.frozen
        together = tuple(dict.fromkeys(name for part in parts for name in part.together))
        self.particles = p = Particles(n, self.dim, members | ({"held": integer} if frozen else {}), evolved, together)
        self.saved = scene.stepper.prepare(p)
        p.companions.append((p.old, p.rate))
        self.sliding = None if spare is None else Sliding((*parts, scene.stepper), p.tree)
        p.finish()
        self.watch = Watch(p)
        self.neighbours = Neighbours(p, scene.box, scene.boundary, kernel, scene.density.reach)
        self.pairs = Pairs(p, scene.box, scene.boundary, lanes())
        self.one_by_one = Pairs(p, scene.box, scene.boundary, 1)  # what is measured once a frame: compiles much faster
        self.density = Density(p, self.pairs, kernel, scene.density)
        self.wire(self.right_hand_side(scene))
        self.advance = Advance(p, self.pairs)

    def right_hand_side(self, scene: Scene) -> RHS:
        """What evaluates the rates of a scene's terms on these particles."""
        parts, stepper = tuple(part.at(self.dim) for part in scene.parts), scene.stepper
        if self.sliding:
            self.sliding.write()
            parts, stepper = tuple(map(self.sliding.loose, parts)), self.sliding.loose(stepper)
        near = self.neighbours
        return RHS(self.particles, near, self.pairs, self.density, scene.density, near.kernel, parts, stepper)

    def wire(self, rhs: RHS) -> None:
        """From now on these terms act."""
        self.rhs, self.parts = rhs, rhs.parts

    def begin(self) -> None:
        """The first evaluation: density, evolved members from the primitive ones, rates. Done by itself when needed."""
        if self.begun:
            return
        self.begun = True
        from .diagnostics.ledger import Ledger

        clock = time.perf_counter()
        try:
            self.rhs.neighbourhood()
        except RunError as error:  # nothing has moved yet: it is the start that does not fit
            raise InputError(str(error)) from error
        state.open_members(self)
        self.longest = self.rhs.from_density(self.time, 0.0)
        self.ledger = Ledger.opened(self)
        self.seconds_compile += time.perf_counter() - clock

    def step(self, dt: float | None = None) -> None:
        """One time step, the longest stable one unless dt is given."""
        self.begin()
        dt = self.longest if dt is None else dt
        if not self.longest > SMALLEST_STEP * self.scene.t_end or not dt > 0 or self.time + dt == self.time:
            raise collapsed(self, f"the time step collapsed to {min(dt, self.longest):.3g}", self.time)
        clock = time.perf_counter()
        self.dt = dt
        self.longest = stepped(self, dt)
        if self.rhs.keys["settle"]:
            self.rhs.settle(self.time, self.dt, self.rhs.moment.most)
        self.watch.look(self)
        self.time += self.dt  # which a stepper may have shortened
        self.steps += 1
        spent = time.perf_counter() - clock
        if self.warm:
            self.seconds, self.timed = self.seconds + spent, self.timed + 1
        else:  # the first step of this object compiles the stepper's kernels
            self.seconds_compile, self.warm = self.seconds_compile + spent, True

    def run(self, until: float | None = None, watch: Callable | None = None) -> "Simulation":
        """Steps up to a time (default: the scene's t_end) in equal parts of what remains.

        watch(sim) is called after every step; it may raise to stop.
        """
        until = self.scene.t_end if until is None else until
        self.begin()
        while self.time < until * (1 - 1e-12):
            remaining = until - self.time
            parts = int(np.ceil(remaining / self.longest * (1 - 1e-6))) if self.longest > 0 else 0
            self.step(remaining / parts if parts > 0 else 0.0)
            if parts == 1 and self.dt == remaining:
                self.time = until
            if watch is not None:
                watch(self)
        return self

    def frames(self, n: int) -> Iterator["Simulation"]:
        """Runs to t_end, stopping at n equally spaced times, the start included (n = 1: the end only)."""
        times = np.linspace(0.0, self.scene.t_end, n) if n > 1 else [self.scene.t_end]
        for until in times:
            if until >= self.time:
                yield self.run(float(until))

    def save(self, path, previous=None) -> None:
        """Write all it takes to go on with the same bits; only a complete file replaces an existing one.

        previous: where the existing one stays.
        """
        from .checkpoint import save

        save(self, path, previous)

    @classmethod
    def load(cls, path, scene: Scene, spare: tuple | None = None) -> "Simulation":
        """A simulation that goes on where save stopped, to the same bits."""
        from .checkpoint import load

        return load(cls, path, scene, spare)

    def close(self) -> None:
        """Give the device memory back."""
        if hasattr(self, "particles"):
            self.particles.close()

    def __enter__(self) -> "Simulation":
        return self

    def __exit__(self, *_) -> None:
        self.close()
