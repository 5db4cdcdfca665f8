"""Strong fields: a uniform one on a noisy lattice, the Alfven wave, current sheets, a loop that is carried along."""

import numpy as np

from ... import exact
from ...lattice import hexagonal, jitter
from ...library import load_scene
from ..case import Case, Limits, Problem

ANGLE = np.radians(30)


def along(angle: float, B: float = 1.0) -> np.ndarray:
    """A field in the plane."""
    return B * np.array([np.cos(angle), np.sin(angle), 0.0])


def uniform(beta: float, nx: int) -> Problem:
    """At rest for 30 dx/v_A on a lattice with a tenth of a spacing of noise: it should stay as it is."""
    rows = 2 * round(nx / np.sqrt(3))
    box = (1.0, rows * np.sqrt(0.75) / nx)
    given = {"rho": 1.0, "P": 0.5 * beta, "B": along(ANGLE)}
    return Problem(box, jitter(hexagonal(box, nx), box, 0.1), lambda x: given, 30 / nx)


def wave(beta: float, nx: int) -> Problem:
    """One period of the circularly polarised Alfven wave."""
    box = (1 / np.cos(ANGLE), 1 / np.sin(ANGLE))

    def start(x):
        return exact.alfven_wave(x, 0.0, exact.direction(ANGLE), 0.1, pressure=0.5 * beta)

    return Problem(box, jitter(hexagonal(box, nx), box, 1e-3), start, 1.0)


def wave_3d(beta: float, nx: int) -> Problem:
    """The same wave in three dimensions, two periods."""
    scene = load_scene("alfven_3d", nx=nx)["xi = 1/2"]

    def start(x):
        return {**scene.start(x), "P": 0.5 * beta}

    return Problem(scene.box, jitter(scene.positions, scene.box, 1e-3), start, 2.0)


def sheets(beta: float, bend: float, nx: int) -> Problem:
    """Two current sheets, bent by v_x = bend cos pi y; until t = 10."""
    box = (2.0, 2.0)

    def start(x):
        zero = np.zeros(len(x))
        B = np.where(np.abs(x[:, 0] - 1) < 0.5, -1.0, 1.0)
        v = bend * np.cos(np.pi * x[:, 1])
        return {"rho": 1.0, "P": 0.5 * beta, "v": np.stack([v, zero, zero], 1), "B": np.stack([zero, B, zero], 1)}

    return Problem(box, hexagonal(box, nx), start, 10.0)


def loop(crossings: float, nx: int) -> Problem:
    """A field a million times weaker than the pressure, carried through the box again and again."""
    scene = load_scene("field_loop", nx=nx)["noise, with resistivity"]
    return Problem(scene.box, scene.positions, scene.start, crossings)


CASES = (
    Case("uniform_field", "a uniform field at rest on a noisy lattice, 30 dx/v_A", "beta", uniform,
         (10.0, 1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6), (1e-9, 1e-12, 1e-16), (32, 20)),
    Case("alfven_wave", "a circularly polarised Alfven wave, one period", "beta", wave,
         (0.2, 0.02, 2e-3, 1e-3), (1e-4, 1e-6, 1e-9), (32, 16)),
    Case("alfven_wave_3d", "the same wave in three dimensions", "beta", wave_3d,
         (0.2, 0.02, 2e-3), (2e-4, 2e-6), (24, 16)),
    Case("current_sheet", "two current sheets, v_x = 0.1 cos pi y, until t = 10", "beta",
         lambda beta, nx: sheets(beta, 0.1, nx), (0.1, 1e-3), (1e-4, 1e-6), (48, 24)),
    Case("bent_sheet", "two current sheets at beta = 0.1, v_x = A cos pi y, until t = 10", "A",
         lambda bend, nx: sheets(0.1, bend, nx), (0.1, 1.0), (3.0, 10.0, 30.0), (48, 24), Limits(energy=0.02)),
    Case("field_loop", "a weak loop of field, carried along", "crossings", loop, (20.0,), (50.0,), (48, 24)),
)  # fmt: skip
