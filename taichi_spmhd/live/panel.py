"""Panel: one simulation on show, with the settings it has been given."""

import time

from ..errors import RunError
from ..recast import fits, recast, restart, slide, successor
from ..scene import Scene
from ..simulation import Simulation
from .readings import Readings

MEMORY = 0.1  # weight of the last step in the running mean of its milliseconds
CHOICES = ("kernel", "density", "eos", "energy", "boundary", "stepper", "start", "box")


class Panel:
    """label: A or B; variants: {label: Scene} of the scene file, of which `variant` is where the settings began.

    scene: those settings now. failed: what went wrong, in one line; the simulation then rests.
    """

    def __init__(self, label: str, variants: dict[str, Scene], variant: str, scene: Scene | None = None):
        self.label, self.variants, self.variant = label, variants, variant
        self.readings, self.failed = Readings(), None
        self.cold()
        self.words = None  # what setup.py said of the scene
        self.sim = self.made(scene or variants[variant])

    @property
    def scene(self) -> Scene:
        return self.sim.scene

    def spare(self, scene: Scene) -> tuple:
        """The parts of all variants: they can be switched on without new memory."""
        return tuple(part.at(scene.dim) for other in self.variants.values() for part in other.parts)

    def made(self, scene: Scene) -> Simulation:
        """A simulation at its start."""
        sim = Simulation(scene, spare=self.spare(scene))
        try:
            sim.begin()
        except BaseException:
            sim.close()
            raise
        return sim

    def take(self, sim: Simulation) -> None:
        """Show another simulation in place of the present one."""
        old, self.sim = self.sim, sim
        old.close()

    def step(self, dt: float) -> float:
        """One step; returns its seconds."""
        clock = time.perf_counter()
        try:
            self.sim.step(dt)
        except RunError as error:
            self.failed = str(error)
        spent = time.perf_counter() - clock
        if self.warm:
            self.ms += (1e3 * spent - self.ms) * (MEMORY if self.ms else 1.0)
        self.warm = True
        return spent

    def cold(self) -> None:
        """What comes next compiles: its milliseconds say nothing."""
        self.ms, self.warm = 0.0, False

    @property
    def updates(self) -> float:
        """Particle updates a second while it steps."""
        return 1e3 * len(self.sim) / self.ms if self.ms else 0.0

    def slide(self, part: str, name: str, value: float) -> None:
        """Another number from the next step on."""
        slide(self.sim, part, name, value)

    def switch(self, part: str, on: bool) -> None:
        """A term on or off; the state is kept."""
        scene = self.scene
        if on == (part in map(kind, scene.terms)):
            return
        self.change(self.in_order(scene.plus(offered(self.variants, part))) if on else scene.without(part))

    def in_order(self, scene: Scene) -> Scene:
        """The same terms in the order of the variants, so that what was compiled for them is found again."""
        names = list(dict.fromkeys(kind(term) for other in self.variants.values() for term in other.terms))
        known = {name: k for k, name in enumerate(names)}
        return scene.but(terms=tuple(sorted(scene.terms, key=lambda t: (known.get(kind(t), len(known)), kind(t)))))

    def change(self, scene: Scene) -> None:
        """Other terms or another kernel for the present state."""
        if scene.kernel is self.scene.kernel and fits(self.sim, scene):
            recast(self.sim, scene)
        else:
            spare = (*self.spare(scene), *(part.at(scene.dim) for part in (*self.scene.parts, *scene.parts)))
            self.take(successor(self.sim, scene, spare))
        self.cold()

    def reset(self) -> None:
        """Back to the start, with the settings of now."""
        restart(self.sim)
        self.sim.begin()
        self.fresh()

    def fresh(self) -> None:
        """Nothing is known of this run yet."""
        self.failed = None
        self.cold()
        self.readings.clear()

    def begin_with(self, variants: dict[str, Scene], variant: str, scene: Scene | None = None) -> None:
        """Start anew with a variant; what is compiled is used again where only terms differ."""
        self.variants, self.variant = variants, variant
        scene = scene or variants[variant]
        same = all(getattr(scene, name) is getattr(self.scene, name) for name in CHOICES)
        if same and len(scene.positions) == len(self.sim) and fits(self.sim, scene):
            restart(self.sim)
            recast(self.sim, scene)
            self.sim.begin()
        else:
            self.take(self.made(scene))
        self.fresh()

    def close(self) -> None:
        self.sim.close()


def kind(part) -> str:
    """The name of a part's class."""
    return type(part).__name__


def offered(variants: dict[str, Scene], name: str):
    """The term of this name as a variant of the scene has it, else with the package's own numbers."""
    from .. import terms

    for scene in variants.values():
        for term in scene.terms:
            if kind(term) == name:
                return term
    return getattr(terms, name)()
