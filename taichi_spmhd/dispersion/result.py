"""What the analysis of one scene gives: growth over wave vectors, the fastest-growing mode, speeds and exact speeds.

Rates are in units of v_A/dx (cs/dx without a field), lengths in dx, wave vectors in 1/dx, speeds in units of cs.
"""

from dataclasses import dataclass

import numpy as np

from ..scene import Scene
from .background import Background
from .branches import NAMES, Gas, matched, speeds
from .directions import SHORTEST, Grid, finest, grid
from .patch import Patch
from .waves import PlaneWaves

LINES = (0.0, 45.0, 90.0)  # degrees to the field along which speeds are followed
LONGEST, POINTS, FEW = 24.0, 60, 14  # spacings; points of such a line, on lattices and in glasses
STILL = 1e-3  # growth below which nothing grows: rounding leaves 1e-4 of waves without a frequency
VECTORS = ("x", "v", "b", "B")


@dataclass(frozen=True, eq=False)
class Dispersion:
    """growth (L, A, T) over the grid; best: the fastest-growing mode, "growth", "frequency", "k", "wavelength", "angle"
    (to the field, degrees), "phase_speed", "eigenvector"; lines: {angle: {"wavelength", "growth", "fast", "alfven",
    "slow" (N,), "exact_fast", ..., "damping_fast" (N,), ...}}.
    """

    scene: Scene
    background: Background
    gas: Gas
    patch: Patch
    grid: Grid
    growth: np.ndarray
    best: dict
    lines: dict


def worked_out(
    scene: Scene, found: Background, gas: Gas, patch: Patch, waves: PlaneWaves, lines: bool, tell
) -> Dispersion:
    """Growth on the grid, a close look at its largest value, and the lines."""
    looked = grid(scene.dim, gas.B, len(patch.cell))
    k = looked.vectors().reshape(-1, scene.dim)
    growth = waves.growth(k, tell)
    top = k[int(growth.argmax())]
    if len(patch.cell) <= 2 and scale(gas) * growth.max() > STILL:  # a look in a glass costs too much
        top = finest(waves.growth, top, looked.lengths[0])
    angles = () if not lines else LINES if scene.dim > 1 else LINES[:1]
    along = {angle: line(waves, gas, looked, angle, POINTS if len(patch.cell) <= 2 else FEW) for angle in angles}
    shape = (len(looked.lengths), len(looked.angles), len(looked.turns))
    return Dispersion(
        scene, found, gas, patch, looked, scale(gas) * growth.reshape(shape), fastest(waves, gas, patch, top), along
    )


def scale(gas: Gas) -> float:
    """From rates in units of the fastest wave to those in units of v_A/dx."""
    return gas.fastest / gas.pace


def fastest(waves: PlaneWaves, gas: Gas, patch: Patch, k: np.ndarray) -> dict:
    """The mode that grows fastest at k, under the shortest wave vector that is it."""
    values, vectors = (part[0] for part in waves.modes(k))
    m = int(values.real.argmax())
    k_own = waves.wave_vector(patch, vectors[:, m], k, SHORTEST[len(k)])
    amplitudes = waves.wave_part(vectors[:, m], k_own - k)
    length = float(np.linalg.norm(k_own))
    return {
        "growth": scale(gas) * float(values[m].real),
        "frequency": scale(gas) * float(abs(values[m].imag)),
        "k": [float(c) for c in k_own],
        "wavelength": 2 * np.pi / length,
        "angle": float(np.degrees(np.arccos(min(1.0, abs(gas.cosine(k_own)))))),
        "phase_speed": gas.fastest / gas.cs * float(abs(values[m].imag)) / length,
        "eigenvector": named(waves, amplitudes),
    }


def named(waves: PlaneWaves, amplitudes: np.ndarray) -> dict[str, complex]:
    """{x_x, x_y, v_x, ..., u: amplitude}, the largest one made 1."""
    largest = amplitudes[int(np.abs(amplitudes).argmax())]
    names = [f"{name}_{'xyz'[c]}" if name in VECTORS else name for name, c in waves.names]
    return {name: complex(a / largest) for name, a in zip(names, amplitudes, strict=True)}


def line(waves: PlaneWaves, gas: Gas, looked: Grid, angle: float, points: int) -> dict:
    """Speeds and damping of the three waves over wavelength at one angle to the field, and the growth."""
    one = Grid(2 * np.pi / np.geomspace(2.0, LONGEST, points), np.array([angle]), np.zeros(1), looked.axes)
    k = one.vectors()[:, 0, 0]
    values, vectors = waves.modes(k)
    found = [matched(waves, gas, *each) for each in zip(k, values, vectors, strict=True)]
    out = {"wavelength": 2 * np.pi / one.lengths, "growth": scale(gas) * values.real.max(axis=1)}
    exact = speeds(gas.cs, gas.v_A, round(abs(gas.cosine(k[0])), 12))  # 90 degrees are not quite in radians
    for name in NAMES:
        mode = np.array([f[name] for f in found])
        out[name] = gas.fastest / gas.cs * np.abs(mode.imag) / one.lengths
        out[f"damping_{name}"] = -scale(gas) * mode.real
        out[f"exact_{name}"] = float(exact[name]) / gas.cs
    return out
