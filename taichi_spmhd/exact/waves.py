"""Waves whose course is known: the linear sound wave and the circularly polarised Alfven wave of any amplitude."""

from math import cos, pi, radians, sin, sqrt

import numpy as np

from ..errors import InputError


def direction(angle: float, tilt: float = 0.0) -> np.ndarray:
    """The unit vector (cos tilt cos angle, cos tilt sin angle, sin tilt), shape (3,); radians.

    angle = 30 degrees is the plane wave of Toth 2000; angle = arcsin(2/sqrt 5), tilt = arcsin(2/3) the 3-D one of
    Gardiner & Stone 2008.
    """
    return np.array([cos(tilt) * cos(angle), cos(tilt) * sin(angle), sin(tilt)])


def frame(k_hat) -> np.ndarray:
    """Rows k, e1, e2: the unit vector along k_hat, e1 = z x k (in the x-y plane) and e2 = k x e1; shape (3, 3).

    k_hat has 1 to 3 components, any length. Raises InputError for anything else and for zero length.
    """
    given = np.asarray(k_hat, dtype=float)
    length = np.linalg.norm(given)
    if given.ndim != 1 or not 1 <= len(given) <= 3 or not (0 < length < np.inf):
        raise InputError(f"k_hat = {k_hat!r}: give a vector of 1 to 3 components that is not zero")
    k = np.zeros(3)
    k[: len(given)] = given / length
    across = np.array([-k[1], k[0], 0.0])
    e1 = across / np.linalg.norm(across) if np.any(across) else np.array([1.0, 0.0, 0.0])
    return np.array([k, e1, np.cross(k, e1)])


def _along(x, k: np.ndarray) -> np.ndarray:
    """x.k of positions (N, d), or of coordinates (N,) along x."""
    x = np.asarray(x, dtype=float)
    if x.ndim > 2 or (x.ndim == 2 and not 1 <= x.shape[1] <= 3):
        raise InputError(f"positions of shape {x.shape}: give (N,) or (N, d) with d = 1, 2 or 3")
    return x * k[0] if x.ndim < 2 else x @ k[: x.shape[1]]


def sound_wave(
    x,
    t: float,
    amplitude: float = 1e-4,
    rho: float = 1.0,
    pressure: float = 0.6,
    gamma: float = 5 / 3,
    wavelength: float = 1.0,
    v: float = 0.0,
) -> dict:
    """rho = rho0 (1 + A sin(k (x - v0 t - c t))), v = v0 + c A sin, P = P0 (1 + gamma A sin), c^2 = gamma P0/rho0.

    The linear sound wave along +x, right to order A^2 (gamma = 1: isothermal). The defaults have c = 1 and period 1
    (physics sheet H1; Phantom's setup_wave). v is the background's velocity. x of shape (N,) gives arrays (N,);
    positions (N, d) give v as vectors (N, 3). Raises InputError for a background without pressure or density.
    """
    if not (rho > 0 and pressure > 0 and gamma >= 1 and wavelength > 0):
        raise InputError("sound_wave: rho, pressure and wavelength must be positive and gamma at least 1")
    c = sqrt(gamma * pressure / rho)
    wave = amplitude * np.sin(2 * pi / wavelength * (_along(x, np.array([1.0, 0, 0])) - (v + c) * t))
    velocity = v + c * wave
    if np.ndim(x) == 2:
        velocity = np.stack([velocity, 0 * wave, 0 * wave], axis=-1)
    return {"rho": rho * (1 + wave), "v": velocity, "P": pressure * (1 + gamma * wave)}


def sound_pulse(
    x,
    t: float,
    amplitude: float = 0.01,
    width: float = 0.1,
    rho: float = 1.0,
    pressure: float = 1.0,
    gamma: float = 5 / 3,
    B_x: float = 0.0,
    period: float = 4.0,
) -> dict:
    """v = (f(x - ct) + f(x + ct))/2,   drho/rho = (f(x - ct) - f(x + ct))/(2c),   f = A exp(-(x/w)^2)

    D'Alembert's two halves of a pulse of v_x in gas at rest, c^2 = gamma P/rho, to first order in A/c. A field along x
    is not felt and stays uniform. Periodic around x = 0; x: (N,) along x or (N, d). Returns rho, P (N,) and v, B
    (N, 3). Raises InputError for rho, P, width or period <= 0.
    """
    if not (rho > 0 and pressure > 0 and width > 0 and period > 0):
        raise InputError("sound_pulse: rho, pressure, width and period must be positive")
    c, along = sqrt(gamma * pressure / rho), _along(x, np.array([1.0, 0, 0]))
    right, left = (amplitude * np.exp(-((_nearest(along - s * c * t, period) / width) ** 2)) for s in (1, -1))
    v, compressed, still = 0.5 * (right + left), (right - left) / (2 * c), np.zeros(len(along))
    return {
        "rho": rho * (1 + compressed),
        "P": pressure * (1 + gamma * compressed),
        "v": np.stack([v, still, still], axis=-1),
        "B": np.stack([still + B_x, still, still], axis=-1),
    }


def _nearest(distance, period: float):
    """The distance to the nearest periodic copy."""
    return distance - period * np.round(distance / period)


def alfven_wave(
    x,
    t: float,
    k_hat=None,
    amplitude: float = 0.1,
    pressure: float = 0.1,
    rho: float = 1.0,
    B_parallel: float = 1.0,
    v_parallel: float = 0.0,
    wavelength: float = 1.0,
) -> dict:
    """B = B0 k + A (sin(phi) e1 + cos(phi) e2), v = v0 k + A/sqrt(rho) (the same), phi = 2 pi (x.k + (v_A - v0) t) / L.

    The circularly polarised Alfven wave, v_A = B0/sqrt(rho): an exact solution of ideal MHD for any amplitude, since
    |B|^2 and with it the total pressure are uniform. It moves against B (v_parallel = v_A: it stands). Toth 2000, JCP
    161, 605; in 3-D Gardiner & Stone 2008. k_hat (default `direction` of 30 degrees) and e1, e2 as in `frame`;
    wavelength: L. x: (N, d), or (N,) along x. Returns rho, P (N,) and v, B (N, 3). Raises InputError for rho, P or
    L <= 0 and for a k_hat of length zero.
    """
    if not (rho > 0 and pressure > 0 and wavelength > 0):
        raise InputError("alfven_wave: rho, pressure and wavelength must be positive")
    k, e1, e2 = frame(direction(radians(30)) if k_hat is None else k_hat)
    v_A = B_parallel / sqrt(rho)
    phase = 2 * pi / wavelength * (_along(x, k) + (v_A - v_parallel) * t)
    circle = amplitude * (np.sin(phase)[:, None] * e1 + np.cos(phase)[:, None] * e2)
    uniform = np.ones(len(phase))
    v, B = v_parallel * k + circle / sqrt(rho), B_parallel * k + circle
    return {"rho": rho * uniform, "v": v, "B": B, "P": pressure * uniform}
