"""Exact solution of the Riemann problem of gas dynamics (Toro, Riemann Solvers and Numerical Methods, chapter 4)."""

from math import sqrt
from typing import NamedTuple

import numpy as np

from ..errors import InputError

SOD_LEFT, SOD_RIGHT = (1.0, 0.0, 1.0), (0.125, 0.0, 0.1)  # rho, v, P (Sod 1978)


class Star(NamedTuple):
    """What lies between the two waves: pressure and velocity, and the density on each side of the contact.

    shocks: speeds of the left and of the right shock, None where that wave is a rarefaction.
    """

    P: float
    v: float
    rho_left: float
    rho_right: float
    shocks: tuple[float | None, float | None]


def star_state(left: tuple = SOD_LEFT, right: tuple = SOD_RIGHT, gamma: float = 1.4) -> Star:
    """The state between the waves of the states (rho, v, P), to round-off.

    Raises InputError for rho <= 0, P <= 0, gamma <= 1, and for states that leave a vacuum between them.
    """
    _check(left, right, gamma)
    P = _star_pressure(left, right, gamma)
    v = 0.5 * (left[1] + right[1] + _jump(P, right, gamma)[0] - _jump(P, left, gamma)[0])
    densities = (_star_density(P, side, gamma) for side in (left, right))
    return Star(P, v, *densities, (_shock(P, left, gamma, -1), _shock(P, right, gamma, +1)))


def _check(left: tuple, right: tuple, gamma: float) -> None:
    """States and gamma that have an answer."""
    if not gamma > 1:
        raise InputError(f"gamma = {gamma}: give a number above 1 (the isothermal limit has other formulas)")
    for state in (left, right):
        if len(state) != 3 or not (state[0] > 0 and state[2] > 0):
            raise InputError(f"state {state}: give (rho, v, P) with positive rho and P")
    if right[1] - left[1] >= 2 / (gamma - 1) * (_sound(left, gamma) + _sound(right, gamma)):
        raise InputError("the states move apart faster than gas can follow (vacuum): bring their velocities closer")


def _sound(state: tuple, gamma: float) -> float:
    """The sound speed of (rho, v, P)."""
    return sqrt(gamma * state[2] / state[0])


def _jump(P: float, state: tuple, gamma: float) -> tuple[float, float]:
    """Toro's f_K(P), the velocity change across a wave from `state` to pressure P, and its derivative (4.6, 4.37)."""
    rho, _, P0 = state
    if P > P0:
        floor = P + (gamma - 1) / (gamma + 1) * P0
        slope = sqrt(2 / ((gamma + 1) * rho) / floor)
        return (P - P0) * slope, slope * (1 - 0.5 * (P - P0) / floor)
    c, z = _sound(state, gamma), (gamma - 1) / (2 * gamma)
    return 2 * c / (gamma - 1) * ((P / P0) ** z - 1), (P / P0) ** (z - 1) / (rho * c)


def _star_pressure(left: tuple, right: tuple, gamma: float) -> float:
    """f_L(P) + f_R(P) + v_R - v_L = 0 by Newton from the two-rarefaction guess (Toro 4.46).

    The function is concave and rising: from the second iterate on P grows towards the root and cannot pass it.
    """
    z, c_left, c_right = (gamma - 1) / (2 * gamma), _sound(left, gamma), _sound(right, gamma)
    speed = c_left + c_right - 0.5 * (gamma - 1) * (right[1] - left[1])
    P = (speed / (c_left / left[2] ** z + c_right / right[2] ** z)) ** (1 / z)
    for _ in range(100):
        (f_left, slope_left), (f_right, slope_right) = _jump(P, left, gamma), _jump(P, right, gamma)
        old, P = P, P - (f_left + f_right + right[1] - left[1]) / (slope_left + slope_right)
        P = max(P, 1e-3 * old)  # a first step from a guess far too high may land below zero
        if abs(P - old) <= 1e-15 * P:
            break
    return P


def _star_density(P: float, state: tuple, gamma: float) -> float:
    """Density behind a shock (Toro 4.50) or a rarefaction (4.53) that leads from `state` to pressure P."""
    rho, _, P0 = state
    x, g = P / P0, (gamma - 1) / (gamma + 1)
    return rho * (x + g) / (g * x + 1) if x > 1 else rho * x ** (1 / gamma)


def _shock(P: float, state: tuple, gamma: float, side: int) -> float | None:
    """The speed of the left (side = -1) or right (+1) shock (Toro 4.52, 4.59), None for a rarefaction."""
    rho, v, P0 = state
    if P <= P0:
        return None
    return v + side * sqrt(((gamma + 1) * P + (gamma - 1) * P0) / (2 * rho))


def sod(x, t: float, left: tuple = SOD_LEFT, right: tuple = SOD_RIGHT, gamma: float = 1.4, x0: float = 0.0) -> dict:
    """rho, v, P and u of the Riemann problem (rho, v, P) left | right of x0, at time t >= 0; u = P / ((gamma - 1) rho).

    x of shape (N,) gives arrays (N,); positions (N, d) give v as vectors (N, 3) along the first axis.
    The defaults are Sod's tube. Raises InputError as `star_state`, and for t < 0.
    """
    x, star = np.asarray(x, dtype=float), star_state(left, right, gamma)
    if not t >= 0:
        raise InputError(f"t = {t}: the tube opens at t = 0, give a time from there on")
    # ahead of every wave at t = 0 and beyond: infinite x/t picks the undisturbed sides
    distance = (x if x.ndim == 1 else x[:, 0]) - x0
    speed = distance / t if t > 0 else np.where(distance < 0, -np.inf, np.inf)
    on_left = _left_half(speed, left, (star.rho_left, star.v, star.P), gamma)
    mirrored = _left_half(-speed, _mirror(right), _mirror((star.rho_right, star.v, star.P)), gamma)
    rho, v, P = (np.where(speed < star.v, a, b) for a, b in zip(on_left, _mirror(mirrored), strict=True))
    vector = v if x.ndim == 1 else np.stack([v, 0 * v, 0 * v], axis=-1)
    return {"rho": rho, "v": vector, "P": P, "u": P / ((gamma - 1) * rho)}


def _mirror(state: tuple) -> tuple:
    """The state seen from the other side."""
    return state[0], -state[1], state[2]


def _left_half(speed: np.ndarray, state: tuple, star: tuple, gamma: float) -> tuple:
    """rho, v, P at x/t = speed, left of the contact: undisturbed, shock or rarefaction fan, star (Toro 4.5)."""
    rho, v, P = state
    shock = _shock(star[2], state, gamma, -1)
    if shock is not None:
        return tuple(np.where(speed < shock, a, b) for a, b in zip(state, star, strict=True))
    c, c_star = _sound(state, gamma), _sound(star, gamma)
    inside = np.clip(speed, v - c, star[1] - c_star)  # the fan between head and tail, frozen at both
    c_fan = (2 * c + (gamma - 1) * (v - inside)) / (gamma + 1)
    power = (c_fan / c) ** (2 / (gamma - 1))
    return rho * power, inside + c_fan, P * power**gamma
