"""A scene's small waves: its uniform state on a lattice, and what becomes of disturbances of it."""

from collections.abc import Callable

import numpy as np

from ..errors import InputError
from ..recast import fits, recast, restart
from ..scene import Scene
from ..simulation import Simulation
from .background import Background, background, uniform
from .branches import Gas
from .patch import Patch, patch, recognised
from .response import Response
from .result import Dispersion, worked_out
from .waves import PlaneWaves


def analyse(scene: Scene, lattice: str | None = None, at: tuple | None = None) -> Dispersion:
    """Linear stability of a scene's discrete equations about its uniform state.

    lattice: line, hexagonal, square, cubic, close_packed or glass (default: that of the scene); at: the spot whose
    state is taken (default: the mean of all particles). Raises InputError for a lattice or spot that is not there.
    """
    with Analyst() as analyst:
        return analyst.analyse(scene, lattice, at)


class Analyst:
    """Works out one scene after another; what is compiled is kept while only numbers change."""

    def __init__(self):
        self.sim: Simulation | None = None

    def analyse(self, scene: Scene, lattice: str | None = None, at: tuple | None = None, lines: bool = True,
                tell: Callable[[float], None] = lambda share: None) -> Dispersion:  # fmt: skip
        """The Dispersion of a scene; lines: phase speeds too; tell(share) hears of progress."""
        checked()
        found = background(scene, at)
        arranged = arrange(scene, found, lattice)
        sim = self.set_up(uniform(scene, found, arranged))
        gas = gas_of(sim, found)
        waves = PlaneWaves(Response(sim, arranged, gas.fastest))
        return worked_out(scene, found, gas, arranged, waves, lines, tell)

    def set_up(self, scene: Scene) -> Simulation:
        """A simulation of this uniform scene at its start; numbers slide (sliding.py), so few need compiling."""
        if self.sim is None or not same_particles(self.sim, scene) or not fits(self.sim, scene):
            self.close()
            self.sim = Simulation(scene, spare=())
        else:
            self.sim.begun = False
            recast(self.sim, scene)
            restart(self.sim)
        self.sim.begin()
        return self.sim

    def close(self) -> None:
        """Give the device memory back."""
        if self.sim is not None:
            self.sim.close()
            self.sim = None

    def __enter__(self) -> "Analyst":
        return self

    def __exit__(self, *_) -> None:
        self.close()


def checked() -> None:
    """Differences of rates want doubles."""
    from ..runtime import ensure, started

    ensure()
    if started().get("precision") == "f32":
        raise InputError("dispersion takes differences of rates, for which f32 is too coarse; use --precision f64")


def same_particles(sim: Simulation, scene: Scene) -> bool:
    """Whether only the state differs, not where and how many the particles are, nor what they are summed with."""
    mine = sim.scene
    same = mine.box == scene.box and np.array_equal(mine.positions, scene.positions)
    return same and (mine.kernel, mine.density, mine.stepper) == (scene.kernel, scene.density, scene.stepper)


def arrange(scene: Scene, found: Background, lattice: str | None) -> Patch:
    """The patch: as many particles a volume as the scene has, wide enough for two or three supports on either side."""
    kernel = scene.kernel.at(scene.dim)
    hops = 3 if any(part.has("gather") for part in scene.parts) else 2
    volume = scene.box.volume / len(scene.positions)
    name = lattice or recognised(scene.positions, found.spot, scene.box)
    return patch(name, scene.dim, volume, hops * scene.density.reach * kernel.support * kernel.h_fact, kernel)


def gas_of(sim: Simulation, found: Background) -> Gas:
    """Pressure and speeds of the background as the code has them."""
    columns = sim.columns()
    P, cs, rho = (float(columns[name].mean()) for name in ("P", "cs", "rho"))
    B = np.zeros(3) if found.B is None else found.B
    return Gas(P, cs, float(np.linalg.norm(B) / np.sqrt(rho)), B)
