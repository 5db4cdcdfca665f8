"""Measuring a setting, in the process that computes: the whole run from t = 0 to t_end, compiled beforehand."""

import contextlib
import hashlib
import os
import time

from .. import choices, runtime
from ..library import find, load_scene
from ..outputs.plan import chosen
from ..recast import restart
from ..runtime import ti
from ..scene_code import code_of
from ..simulation import Simulation
from .calibration import Calibration
from .figures import figures
from .prices.steps import timed

ROOM = 1.5e9  # bytes of simulations kept for the next round


class Bench:
    """Runs orders; keeps what it has compiled for their repetitions, as far as memory goes."""

    def __init__(self):
        self.sims: dict[str, Simulation] = {}
        self.loop = Calibration()

    def run(self, order: dict) -> dict:
        """order: path or name, parameters, changes, variant, t_end, key; steps: how many, without it the whole run.

        Returns what `measured` says of a whole run, or prices.steps.timed of some steps, in turn with those of
        another order, `whole`, where there is one.
        """
        with code_of(find(order["path"])):
            whole = self.ready(order["whole"])[0] if "whole" in order else None
            sim, seconds_compile = self.ready(order, spared=whole)
            steps = order.get("steps")
            made = timed(sim, steps, whole) if steps else measured(sim, self.loop)
            return {**made, "seconds_compile": seconds_compile, **runtime.started()}

    def ready(self, order: dict, spared: Simulation | None = None) -> tuple[Simulation, float]:
        """A simulation at its start with everything compiled, and the seconds that took."""
        clock = time.perf_counter()
        sim = self.sims.pop(order["key"], None)
        if sim is None:
            with written_to(order.get("code")):
                sim = compiled(scene(order))
            self.make_room(sim, spared)
        self.sims[order["key"]] = sim  # the latest used is the last
        restart(sim)
        return sim, time.perf_counter() - clock

    def make_room(self, sim: Simulation, spared: Simulation | None) -> None:
        """Close those not used for longest until this one fits."""
        for key, other in list(self.sims.items()):
            if sum(map(size, self.sims.values())) + size(sim) <= ROOM:
                break
            if other is not spared:
                self.sims.pop(key).close()


def compiled(scene) -> Simulation:
    """A simulation that has done everything once."""
    sim = Simulation(scene)
    sim.begin()
    sim.step()
    sim.columns()
    return sim


@contextlib.contextmanager
def written_to(folder: str | None):
    """Taichi writes the code it compiles meanwhile, as it gets it from us and from LLVM, into this folder."""
    if folder is None:
        yield
        return
    before, config = os.getcwd(), ti.lang.impl.current_cfg()
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    try:
        config.print_kernel_llvm_ir = config.print_kernel_llvm_ir_optimized = True
        yield
    finally:
        config.print_kernel_llvm_ir = config.print_kernel_llvm_ir_optimized = False
        os.chdir(before)


def size(sim: Simulation) -> int:
    """Bytes on the device."""
    return len(sim) * (sim.particles.bytes_each + sim.neighbours.bytes_each)


def scene(order: dict):
    """The scene of an order."""
    variants = load_scene(order["path"], **order["parameters"])
    return choices.applied(chosen(variants, [order["variant"]], order["t_end"])[order["variant"]], order["changes"])


def measured(sim: Simulation, loop: Calibration) -> dict:
    """Seconds of all steps, the calibration loop just before and after, cores got, the load of the machine, figures."""
    before = loop.seconds()
    sim.seconds, sim.timed = 0.0, 0
    wall, work = time.perf_counter(), time.process_time()
    sim.run()
    ti.sync()
    wall, work = time.perf_counter() - wall, time.process_time() - work
    return {
        "seconds": sim.seconds,
        "calibration": 0.5 * (before + loop.seconds()),
        "cores": work / wall,
        "load": os.getloadavg()[0] if hasattr(os, "getloadavg") else None,
        **figures(sim),
        "digest": digest(sim),
    }


def digest(sim: Simulation) -> str:
    """A hash of the final state: the same bits give the same one."""
    made, columns = hashlib.sha256(), sim.columns()
    for name in sorted(columns):
        made.update(columns[name].tobytes())
    return made.hexdigest()[:16]
