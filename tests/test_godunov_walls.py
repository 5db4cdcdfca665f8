"""A reflecting wall in Godunov's scheme is the same gas once more, mirrored: also the slopes of the second order."""

import numpy as np
import pytest

from taichi_spmhd import Boundary, QuinticSpline, Reflecting, Scene, Simulation, jitter, square, with_scheme
from taichi_spmhd.boundary import everywhere
from taichi_spmhd.terms import DivBSource, Induction, Pressure, Stress

WALLS, WHOLE = ((0.0, 1.0), (0.0, 1.0)), ((-1.0, 1.0), (-1.0, 1.0))
STEPS, DT = 5, 0.005
SIGNS = [(1, 1), (-1, 1), (1, -1), (-1, -1)]


def start(magnetic: bool):
    """Waves between the walls, and their mirror images outside: components along a flipped axis change their sign."""

    def given(x):
        a, b = np.abs(x).T
        flip = np.stack([*np.sign(x).T, np.ones(len(x))], axis=1)
        v = flip * np.stack([np.sin(3 * a + b), np.cos(2 * b + a), a * b], axis=1)
        B = flip * np.stack([1 + 0.3 * np.sin(2 * b), 0.5 + 0.3 * np.cos(3 * a), 0.2 + a - b], axis=1)
        return {"rho": 1.0, "P": 1 + 0.5 * np.sin(3 * a) * np.cos(2 * b), "v": v, **({"B": B} if magnetic else {})}

    return given


def after_a_while(box, x, boundary, magnetic: bool) -> dict:
    terms = (Stress(), Induction(), DivBSource(0.5)) if magnetic else (Pressure(),)
    scene = Scene(box, x, start(magnetic), terms, boundary=boundary, kernel=QuinticSpline())
    with Simulation(with_scheme(scene, "godunov")) as sim:
        for _ in range(STEPS):
            sim.step(DT)
        return sim.columns()


@pytest.mark.slow
@pytest.mark.parametrize("magnetic", [False, True])
def test_walls_do_what_a_mirrored_gas_does(magnetic):
    x = jitter(square(WALLS, 12), WALLS, 0.2, seed=1)
    x = np.clip(x, 0.01, 0.99)
    walled = after_a_while(WALLS, x, Boundary(x=Reflecting(), y=Reflecting()), magnetic)
    whole = after_a_while(WHOLE, np.concatenate([x * signs for signs in SIGNS]), everywhere(), magnetic)
    for name in ("x", "v", "P", "rho", *(("B",) if magnetic else ())):
        # the same numbers in another order: measured 5e-13; slopes that keep their sign in the mirror give 3e-4
        assert np.abs(walled[name] - whole[name][: len(x)]).max() < 1e-10, name
