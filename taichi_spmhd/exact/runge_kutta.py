"""One step of the classical Runge-Kutta method, for the solutions that are ordinary differential equations."""

from collections.abc import Callable

import numpy as np


def rk4(slope: Callable, y: np.ndarray, step) -> np.ndarray:
    """y after a step (a number, or one for each entry) of dy/ds = slope(y), of fourth order."""
    k1 = slope(y)
    k2 = slope(y + 0.5 * step * k1)
    k3 = slope(y + 0.5 * step * k2)
    k4 = slope(y + step * k3)
    return y + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
