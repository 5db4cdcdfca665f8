"""Fast flows: colliding, parting, turning, turbulent."""

import numpy as np

from ...boundary import Boundary, Open
from ...lattice import hexagonal, jitter, line
from ...library import load_scene
from ..case import SHOCKED, Case, Problem

P = 0.6  # with rho = 1 and gamma = 5/3 the speed of sound is 1
FIELD = np.array([0.5, 0.5, 0.0])


def colliding(mach: float, nx: int) -> Problem:
    """Two streams of a magnetised gas, v_x = -+ Mach for x >< 0, meet in the middle of a periodic box; behind them the
    gas is torn apart."""
    box = ((-0.5, 0.5), (0.0, 0.5))

    def start(x):
        v = -mach * np.sign(x[:, 0]) * (np.abs(x[:, 0]) < 0.25)
        return {"rho": 1.0, "P": P, "v": np.stack([v, 0 * v, 0 * v], axis=1), "B": FIELD}

    return Problem(box, jitter(hexagonal(box, nx), box, 0.01), start, 0.15 / max(1.0, mach / 2) ** 0.75)


def parting(mach: float, nx: int) -> Problem:
    """Two halves of a magnetised gas fly apart and leave next to nothing between them; their far ends are free."""
    x = line(((-0.5, 0.5),), nx)

    def start(x):
        v = mach * np.sign(x[:, 0])
        return {"rho": 1.0, "P": P, "v": np.stack([v, 0 * v, 0 * v], axis=1), "B": [0.0, 0.5, 0.0]}

    return Problem(((-0.5, 0.5),), x, start, 1.0 / mach, boundary=Boundary(x=Open()))


def orszag_tang(speed: float, nx: int) -> Problem:
    """The Orszag-Tang vortex to t = 5 (in units of its own flow), the flow `speed` times as fast."""
    scene = load_scene("orszag_tang", nx=nx)["with cleaning"]

    def start(x):
        given = scene.start(x)
        return {**given, "v": speed * given["v"]}

    return Problem(scene.box, scene.positions, start, 5.0 / speed)


def rotor(speed: float, nx: int) -> Problem:
    """The rotor with this speed of its edge: 2 in the literature."""
    scene = load_scene("rotor", nx=nx)["with cleaning"]

    def start(x):
        given = scene.start(x)
        return {**given, "v": speed / np.linalg.norm(given["v"], axis=1).max() * given["v"]}

    return Problem(scene.box, scene.positions, start, 0.3 / speed, eos=scene.eos)


CASES = (
    Case("colliding_flow", "two magnetised streams meet", "Mach", colliding, (10.0, 30.0, 100.0), (300.0, 1000.0),
         (96, 48), SHOCKED),
    Case("parting_flow", "two halves of a magnetised gas part, near vacuum between", "Mach", parting,
         (2.0, 5.0, 10.0), (30.0, 100.0, 1000.0), (200, 100)),
    Case("orszag_tang", "the Orszag-Tang vortex to t = 5", "speed", orszag_tang, (1.0,), (3.0, 10.0, 30.0), (64, 24),
         SHOCKED),
    Case("rotor", "the MHD rotor", "edge speed", rotor, (2.0,), (4.0, 8.0, 16.0, 32.0), (48, 24), SHOCKED),
)  # fmt: skip
