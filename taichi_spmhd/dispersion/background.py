"""The uniform state that waves are small disturbances of: what a scene starts with, in the mean or at one spot."""

from dataclasses import dataclass, replace

import numpy as np

from .. import state
from ..boundary import everywhere
from ..eos import Radiating
from ..errors import InputError
from ..scene import Scene
from .patch import Patch

EXACT = 1e-13  # tolerance of the density: differences of rates are taken


@dataclass(frozen=True, eq=False)
class Background:
    """rho, P, cs (of the start, None where the equation of state has its own), v and B (3,), spot (d,) of the scene."""

    rho: float
    P: float | None
    cs: float | None
    v: np.ndarray
    B: np.ndarray | None
    spot: np.ndarray

    def start(self) -> dict:
        """What a scene's start gives."""
        given = {"rho": self.rho, "P": self.P, "cs": self.cs, "v": self.v, "B": self.B}
        return {name: value for name, value in given.items() if value is not None}


def background(scene: Scene, at: tuple | None = None) -> Background:
    """The mean over a scene's particles, weighed by volume, or the state of the one next to `at`.

    Raises InputError for a spot of another dimension or outside the box.
    """
    values = state.opening(scene)
    if at is None:
        volume = values["m"] / values["rho"]
        weights, spot = volume / volume.sum(), np.array(scene.box.lo) + 0.5 * np.array(scene.box.size)
    else:
        spot = spot_in(scene, at)
        weights = np.zeros(len(values["m"]))
        weights[int(np.argmin(((scene.positions - spot) ** 2).sum(axis=1)))] = 1.0
    mean = {
        name: np.tensordot(weights, values[name], 1) for name in ("rho", "v", "P", "u", "cs", "B") if name in values
    }
    if "u" in mean and "P" not in mean and not isinstance(scene.eos, Radiating):
        mean["P"] = (scene.eos.gamma - 1) * mean["rho"] * mean["u"]
    B = mean.get("B")
    rho, P, cs = (None if name not in mean else float(mean[name]) for name in ("rho", "P", "cs"))
    return Background(rho, P, cs, mean["v"], B if B is None else cleared(B, values["B"]), spot)


def cleared(B: np.ndarray, each: np.ndarray) -> np.ndarray:
    """A mean field whose components are exactly zero where they cancel but for rounding."""
    return np.where(np.abs(B) > 1e-12 * np.abs(each).max(), B, 0.0)


def spot_in(scene: Scene, at: tuple) -> np.ndarray:
    """`at` as a spot of the scene's box."""
    spot = np.array(at, float)
    lo, hi = np.array(scene.box.lo), np.array(scene.box.hi)
    if spot.shape != (scene.dim,) or not (np.isfinite(spot) & (spot >= lo) & (spot <= hi)).all():
        room = " x ".join(f"{a:g}..{b:g}" for a, b in zip(lo, hi, strict=True))
        raise InputError(f"--at {' '.join(map(str, at))}: give a spot of the box {room}, a number for each axis")
    return spot


def uniform(scene: Scene, found: Background, patch: Patch) -> Scene:
    """The scene's terms and choices on the patch, in the uniform state, periodic everywhere."""
    given = found.start()
    return scene.but(
        box=patch.box, positions=patch.positions, start=lambda x: given, boundary=everywhere(),
        terms=tuple(term.smooth() for term in scene.terms),
        density=replace(scene.density, tolerance=EXACT), exact=None, reference=None, measure=None,
    )  # fmt: skip
