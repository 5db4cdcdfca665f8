"""Solved MHD shock tubes at any x and t: a function of x/t, constant states joined by jumps and rarefaction fans."""

from functools import lru_cache
from math import sqrt

import numpy as np

from ..errors import InputError
from .mhd_tubes import TUBES, Tube
from .runge_kutta import rk4

FAN = 200  # steps of the fourth-order integration through a rarefaction: round-off


def mhd_tube(x, t: float, name: str = "rj1a") -> dict:
    """rho, P, v and B of a solved tube of TUBES at time t >= 0; the step was at x = 0.

    x: (N,) or positions (N, d). rho, P (N,), v, B (N, 3). Raises InputError for an unknown tube, one without a
    solution, and t < 0.
    """
    tube = solved(name)
    if not t >= 0:
        raise InputError(f"t = {t}: the tube opens at t = 0, give a time from there on")
    x = np.asarray(x, dtype=float)
    x = x if x.ndim == 1 else x[:, 0]
    speed, states = nodes(name)
    # at t = 0 every wave is at x = 0: infinite x/t picks the outer states
    at = x / t if t > 0 else np.where(x < 0, -np.inf, np.inf)
    rho, P, *v, By, Bz = (np.interp(at, speed, column) for column in states.T)
    return {"rho": rho, "P": P, "v": np.stack(v, axis=-1), "B": np.stack([np.full(len(at), tube.B_x), By, Bz], axis=-1)}


def solved(name: str) -> Tube:
    """The tube of that name, if its solution is known."""
    known = [key for key, tube in TUBES.items() if tube.waves]
    if name not in known:
        raise InputError(f"no exact solution of the tube {name!r}; there are {', '.join(known)}")
    return TUBES[name]


@lru_cache
def nodes(name: str) -> tuple[np.ndarray, np.ndarray]:
    """x/t (K,), not falling, and the states there (K, 7): two nodes at each jump, many in a fan, linear between."""
    speeds, states = zip(*waves(solved(name)), strict=True)
    return np.concatenate(speeds), np.concatenate(states)


def waves(tube: Tube) -> list[tuple[np.ndarray, np.ndarray]]:
    """x/t and states of the nodes of each wave, left to right."""
    sides = zip(tube.states[:-1], tube.states[1:], tube.waves, strict=True)
    return [fan(*wave, tube) if wave[2][1:] in ("fast", "slow") else jump(*wave, tube) for wave in sides]


def plateaus(name: str) -> list[tuple[float, float, tuple]]:
    """(from x/t, to x/t, state) of the constant states between the waves, left to right; a state as in TUBES."""
    tube = solved(name)
    edges = [(s[0], s[-1]) for s, _ in waves(tube)]
    inner = tube.states[1:-1]
    return [(float(edges[n][1]), float(edges[n + 1][0]), state) for n, state in enumerate(inner)]


def jump(left: tuple, right: tuple, wave: str, tube: Tube) -> tuple[np.ndarray, np.ndarray]:
    """The two nodes of a discontinuity, at one speed."""
    return np.full(2, speed(left, right, wave, tube)), np.array([left, right], dtype=float)


def speed(left: tuple, right: tuple, wave: str, tube: Tube) -> float:
    """x/t of a jump: S = [rho v_x]/[rho] of a shock, v_x -+ |B_x|/sqrt(rho) of a rotation, v_x of a contact."""
    if wave[1:] == "shock":
        return (right[0] * right[2] - left[0] * left[2]) / (right[0] - left[0])
    return left[2] + side(wave) * abs(tube.B_x) / sqrt(left[0])


def side(wave: str) -> int:
    """Which way a wave runs through the gas."""
    return {"<": -1, ">": 1}.get(wave[0], 0)


def fan(left: tuple, right: tuple, wave: str, tube: Tube) -> tuple[np.ndarray, np.ndarray]:
    """v_x -+ c (K,) and states (K, 7) through a rarefaction, from the gas ahead to the density of the state behind.

    A simple wave: dU = r(U) d ln rho along the characteristic field r, integrated by Runge and Kutta.
    """
    ahead, behind = (left, right) if side(wave) < 0 else (right, left)
    step = np.log(behind[0] / ahead[0]) / FAN
    states = [np.array(ahead, dtype=float)]
    for _ in range(FAN):
        states.append(rk4(lambda u: field(u, wave, tube), states[-1], step))
    states = np.array(states)
    s = np.array([u[2] + side(wave) * magnetosonic(u, wave, tube) for u in states])
    return (s, states) if side(wave) < 0 else (s[::-1], states[::-1])


def magnetosonic(u: np.ndarray, wave: str, tube: Tube) -> float:
    """c^2 = (a^2 + b^2)/2 +- sqrt( (a^2 + b^2)^2/4 - a^2 b_x^2 ),   a^2 = gamma P/rho,   b = B/sqrt(rho)"""
    a2, bx2, b2 = tube.gamma * u[1] / u[0], tube.B_x**2 / u[0], (tube.B_x**2 + u[5] ** 2 + u[6] ** 2) / u[0]
    root = sqrt(max((0.5 * (a2 + b2)) ** 2 - a2 * bx2, 0.0))
    return sqrt(0.5 * (a2 + b2) + (root if wave[1:] == "fast" else -root))


def field(u: np.ndarray, wave: str, tube: Tube) -> np.ndarray:
    """dU/d ln rho: dP = gamma P, dv_x = +-c, dB_y = B_y c^2/(c^2 - b_x^2), dv_y = -+ c b_x b_y/(c^2 - b_x^2); z as y"""
    c = magnetosonic(u, wave, tube)
    along = side(wave) * c
    bx = tube.B_x / sqrt(u[0])
    turn = 1.0 / (c * c - bx * bx)
    by, bz = u[5] / sqrt(u[0]), u[6] / sqrt(u[0])
    return np.array(
        [
            u[0],
            tube.gamma * u[1],
            along,
            -along * bx * by * turn,
            -along * bx * bz * turn,
            u[5] * c * c * turn,
            u[6] * c * c * turn,
        ]
    )
