"""Sedov's explosion: a strong shock from a point, r = R(t) lambda, R = xi0 (E t^2/rho)^(1/(d+2)).

With v = R' U, rho = rho0 G, P = rho0 R'^2 Z as functions of l = lambda, and a = R R''/R'^2 = -d/2, gas obeys

    (U - l) G'/G = -(U' + (d-1) U/l),   a U + (U - l) U' + Z'/G = 0,   (U - l) (Z'/Z - gamma G'/G) + 2 a = 0

integrated inwards from the strong shock at lambda = 1. The energy inside gives xi0 (Sedov 1959; Landau & Lifshitz 106).
"""

from functools import lru_cache
from math import pi

import numpy as np

from ..errors import InputError
from .runge_kutta import rk4

STEPS, INNERMOST = 2000, 1e-2  # of the integration in ln lambda; inside this radius P is uniform and rho vanishes


def sedov(x, t: float, gamma: float = 5 / 3, energy: float = 1.0, rho: float = 1.0) -> dict:
    """rho, v and P at time t >= 0 of an explosion at the origin into gas without pressure; x: (N, d), d = 1, 2, 3.

    Returns rho, P (N,) and v (N, 3). In 1-D the energy goes to both sides. Raises InputError as sedov_radius.
    """
    x = np.asarray(x, dtype=float)
    dim, r = x.shape[1], np.linalg.norm(x, axis=1)
    R = sedov_radius(t, gamma, dim, energy, rho)
    speed = 2 / (dim + 2) * R / t if t > 0 else 0.0
    scaled = r / R if t > 0 else np.full(len(r), np.inf)  # at t = 0 all gas is ahead
    at, U, G, Z = profile(gamma, dim)[::-1].T
    inside = scaled < 1
    U, G, Z = (np.where(inside, np.interp(scaled, at, f), ahead) for f, ahead in ((U, 0.0), (G, 1.0), (Z, 0.0)))
    U = U * np.minimum(scaled / INNERMOST, 1.0)  # linear through the centre
    v = (speed * U / np.maximum(r, 1e-300))[:, None] * x
    return {"rho": rho * G, "v": np.pad(v, ((0, 0), (0, 3 - dim))), "P": rho * speed**2 * Z}


def sedov_radius(t: float, gamma: float = 5 / 3, dim: int = 2, energy: float = 1.0, rho: float = 1.0) -> float:
    """R(t) of the shock. Raises InputError for gamma <= 1, dim not 1, 2 or 3, t < 0, and energy or rho <= 0."""
    if not (t >= 0 and energy > 0 and rho > 0):
        raise InputError(f"sedov: energy = {energy} and rho = {rho} must be positive, t = {t} at least 0")
    return sedov_xi0(gamma, dim) * (energy * t * t / rho) ** (1 / (dim + 2))


def sedov_time(R: float, gamma: float = 5 / 3, dim: int = 2, energy: float = 1.0, rho: float = 1.0) -> float:
    """When the shock is at R. Raises InputError as sedov_radius."""
    return (R / sedov_radius(1.0, gamma, dim, energy, rho)) ** (0.5 * (dim + 2))


@lru_cache
def sedov_xi0(gamma: float, dim: int) -> float:
    """xi0^-(d+2) = S (2/(d+2))^2 int (G U^2/2 + Z/(gamma - 1)) l^(d-1) dl,   S = 2, 2 pi, 4 pi"""
    at, U, G, Z = profile(gamma, dim).T
    density = (0.5 * G * U**2 + Z / (gamma - 1)) * at**dim  # dl = l d ln l
    simpson = np.tile([2.0, 4.0], STEPS // 2 + 1)[: STEPS + 1]
    simpson[[0, -1]] = 1.0
    within = -np.log(INNERMOST) / STEPS / 3 * (simpson @ density) + density[-1] / dim  # and what is further in
    return float((2, 2 * pi, 4 * pi)[dim - 1] * (2 / (dim + 2)) ** 2 * within) ** (-1 / (dim + 2))


@lru_cache
def profile(gamma: float, dim: int) -> np.ndarray:
    """Rows (lambda, U, G, Z) from the shock inwards, by Runge and Kutta in ln lambda."""
    if not gamma > 1 or dim not in (1, 2, 3):
        raise InputError(f"sedov: gamma = {gamma} must be above 1 and dim = {dim} be 1, 2 or 3")
    step = np.log(INNERMOST) / STEPS
    rows = [np.array([1.0, 2 / (gamma + 1), (gamma + 1) / (gamma - 1), 2 / (gamma + 1)])]
    for _ in range(STEPS):
        rows.append(rk4(lambda y: slope(y, gamma, dim), rows[-1], step))
    return np.array(rows)


def slope(y: np.ndarray, gamma: float, dim: int) -> np.ndarray:
    """d(lambda, U, G, Z)/d ln lambda: the three equations solved for their derivatives."""
    at, U, G, Z = y
    a, behind, spread, c2 = -0.5 * dim, U - at, (dim - 1) * U / at, gamma * Z / G
    dU = (-a * U * behind + c2 * spread + 2 * a * Z / G) / (behind**2 - c2)
    dG = -G * (dU + spread) / behind
    dZ = -G * (a * U + behind * dU)
    return at * np.array([1.0, dU, dG, dZ])
