"""One trial: a scene run to its end or until it fails, and what is said of it."""

import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace

import numpy as np

from ..diagnostics.clumping import clumping
from ..diagnostics.field import div_B_figures
from ..diagnostics.ledger import energies, momentum, predicted, speed, total
from ..errors import InputError, RunError
from ..scene import Scene
from ..simulation import Simulation
from .case import Limits

LOOKS = 12  # times at which arrangement and div B are measured
SOUND, UNSOUND, FAILED = "sound", "unsound", "failed"
ROUNDING = {4: 1e-4, 8: 0.0}  # of momentum in f32, after thousands of steps of 6e-8 each
PATIENCE = 200.0  # times the steps that Courant's limit asked for at the start: more is a step that has collapsed


def trial(scene: Scene, limits: Limits, check: Callable[[], None] = lambda: None) -> dict:
    """verdict, seconds, steps, what was measured on the way; why and where it failed, or what is beyond the limits."""
    clock, seen = time.perf_counter(), Seen(check)
    try:
        with Simulation(scene) as sim:
            failure = run(sim, seen)
            limits = replace(limits, momentum=max(limits.momentum, ROUNDING[sim.particles.word().itemsize]))
            found = {"particles": len(sim), "t": sim.time / scene.t_end, "steps": sim.steps, "floors": int(sim.floors)}
    except InputError as error:  # it does not even start
        failure, found = {"why": str(error), "cause": "start"}, {"t": 0.0, "steps": 0, "floors": 0}
    found.update(seen.measures())
    beyond = excess(found, limits) if failure is None else []
    verdict = FAILED if failure else UNSOUND if beyond else SOUND
    return {"verdict": verdict, **found, "beyond": beyond, **(failure or {}), "seconds": time.perf_counter() - clock}


def run(sim: Simulation, seen: "Seen") -> dict | None:
    """To the end; what went wrong, or None."""
    try:
        sim.begin()
        most = PATIENCE * sim.scene.t_end / max(sim.longest, 1e-300)
        for until in np.linspace(0, sim.scene.t_end, LOOKS + 1)[1:]:
            sim.run(float(until), watch=lambda sim: seen.step(sim, most))
            seen.look(sim)
    except RunError as error:
        with suppress(RunError, InputError, ValueError, FloatingPointError):
            seen.look(sim)  # the state of the failure, if it can be read
        names = ("cause", "particle", "position", "member", "term", "time")
        return {"why": str(error), **{name: getattr(error, name, None) for name in names}}
    return None


class Seen:
    """The worst of what was seen in a run."""

    def __init__(self, check: Callable[[], None]):
        self.check, self.steps, self.worst = check, [], {}

    def step(self, sim: Simulation, most: float) -> None:
        """After every step: its length. Raises RunError for a run that gets nowhere."""
        self.check()
        self.steps.append(sim.dt)
        if len(self.steps) > most:
            raise RunError(f"the time step fell: {len(self.steps)} steps to t = {sim.time:.4g} of {sim.scene.t_end:g}")

    def look(self, sim: Simulation) -> None:
        """Arrangement, div B, conservation."""
        columns = sim.columns()
        gaps = clumping(sim, columns)
        now = {**off_ledger(sim, columns), "close": gaps["close_pairs"], "gap": -gaps["smallest_gap"]}
        if "B" in columns:
            now.update({"div_B": div_B_figures(sim, columns)["mean"], "low_beta": -lowest_beta(columns)})
        for name, value in now.items():
            self.worst[name] = max(self.worst.get(name, -np.inf), float(value))

    def measures(self) -> dict:
        """By name; the smallest gap and beta as they are."""
        out = {name: value for name, value in self.worst.items() if name not in ("gap", "low_beta")}
        for name in {"gap", "low_beta"} & set(self.worst):
            out[name] = -self.worst[name]
        if self.steps:
            out["dt"] = [float(np.min(self.steps)), float(np.median(self.steps)), float(np.max(self.steps))]
        return out


def off_ledger(sim: Simulation, columns: dict) -> dict[str, float]:
    """energy: |E - E0 - what terms gave| over all energies, xi_energy: what terms gave, likewise; momentum: |p - p0 -
    what terms gave| over M times the largest r.m.s. velocity, or speed of signals where that is more."""
    ledger, mass = sim.ledger, total(columns, np.ones(len(sim)))
    ledger.v_rms = max(ledger.v_rms, speed(columns))
    stored, (given, push) = energies(sim, columns), predicted(sim, columns)
    size = max(sum(abs(value) for name, value in stored.items() if name != "E_tot"), 1e-300)
    lost = np.linalg.norm(momentum(sim, columns) - ledger.p0 - push)
    signals = np.sqrt(total(columns, columns["vw"].astype(float) ** 2) / mass)
    return {
        "energy": abs(stored["E_tot"] - ledger.E0 - given) / size,
        "xi_energy": abs(given) / size,
        "momentum": lost / (mass * max(ledger.v_rms, signals)),
    }


def lowest_beta(columns: dict) -> float:
    """The smallest 2P/B^2 of any particle."""
    squares = (columns["B"].astype(float) ** 2).sum(axis=1)
    return float((2 * columns["P"] / np.maximum(squares, 1e-30)).min())


def excess(found: dict, limits: Limits) -> list[str]:
    """What is beyond the limits, in words; a floor always is."""
    names = ("energy", "momentum", "close", "div_B")
    over = [name for name in names if not found.get(name, 0.0) <= getattr(limits, name)]
    words = [f"{name} {found[name]:.2g} > {getattr(limits, name):g}" for name in over]
    return words + ([f"{found['floors']} floors"] if found["floors"] else [])
