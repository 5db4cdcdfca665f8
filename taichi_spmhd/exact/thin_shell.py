"""A thin shell of swept-up gas, pushed by hot gas in front of which it runs: d/dt[ rho_c s dX/dt ] = P_h(X) - P_c."""

from typing import NamedTuple

import numpy as np

from ..errors import InputError
from .runge_kutta import rk4

STEPS = 400  # of Runge-Kutta to the latest time; 50 give eight digits


class Shell(NamedTuple):
    """At times t: X, the place of the contact; v = dX/dt; P of the hot gas; P_shock behind the shock ahead."""

    X: np.ndarray
    v: np.ndarray
    P: np.ndarray
    P_shock: np.ndarray


def thin_shell(t, hot: tuple = (0.01, 10.0), cold: tuple = (1.0, 0.1), X0: float = 0.2) -> Shell:
    """The shell between hot gas 0 < x < X and cold gas, both (rho, c) at the start, isothermal each, at rest at t = 0.

    s = X - X0 is what the shell has swept, P_h = rho_h c_h^2 X0/X (the hot gas, enclosed by a wall, expands evenly).
    With the momentum p = rho_c s dX/dt, p dp = rho_c s (P_h - P_c) ds, hence

        (dX/dt)^2 = 2/(rho_c s^2) [ P_0 X0 (s - X0 ln(1 + s/X0)) - P_c s^2/2 ],   sqrt((P_0 - P_c)/rho_c) at s = 0

    which a Runge-Kutta method of fourth order integrates. The shell is braked (d2X/dt2 < 0), so the pressure rises in
    it from P_h to that behind the shock, rho_c (dX/dt)^2 + P_c. Right while the shock is strong and the hot gas faster
    than the shell. t: a time or an array of times >= 0. Raises InputError for gas that does not expand.
    """
    (rho_h, c_h), (rho_c, c_c) = hot, cold
    P_0, P_c, times = rho_h * c_h**2, rho_c * c_c**2, np.asarray(t, float)
    if not (rho_c > 0 and X0 > 0 and P_0 > P_c > 0):
        raise InputError(
            "thin_shell: densities, sound speeds and X0 must be positive and the hot gas at higher pressure"
        )
    if not (times >= 0).all():
        raise InputError("thin_shell: the shell starts at t = 0, give times from there on")

    def speed(s):
        q = s / X0
        swept = (
            np.where(q > 1e-3, q - np.log1p(q), q**2 * (1 / 2 - q / 3 + q**2 / 4 - q**3 / 5))
            / np.maximum(q, 1e-30) ** 2
        )
        return np.sqrt(np.maximum(2 * P_0 * np.where(q > 0, swept, 0.5) - P_c, 0.0) / rho_c)

    s, dt = np.zeros_like(times), times / STEPS
    for _ in range(STEPS):
        s = rk4(speed, s, dt)  # every entry has its own step
    v = speed(s)
    return Shell(X0 + s, v, P_0 * X0 / (X0 + s), rho_c * v**2 + P_c)


def shell_profile(x, t: float, hot: tuple = (0.01, 10.0), cold: tuple = (1.0, 0.1), X0: float = 0.2) -> dict:
    """rho, v and P at positions x, (N,) or (N, d), at time t: hot gas, the shell it pushes, and what lies ahead.

    Hot gas expands evenly, v = x dX/dt / X. In the shell P rises from P_h to that behind the shock, in proportion to
    the mass passed (it is braked as one body), so rho = P/c_c^2 rises exponentially; ahead all is at rest.
    """
    x = np.asarray(x, float)
    place = x if x.ndim == 1 else x[:, 0]
    shell = thin_shell(t, hot, cold, X0)
    c2, rise = cold[1] ** 2, max(float(shell.P_shock - shell.P), 0.0)
    swept = cold[0] * float(shell.X - X0)
    scale = swept * c2 / rise if rise * swept > 0 else np.inf  # c^2 / deceleration: the scale height of the shell
    width = scale * np.log(shell.P_shock / shell.P) if np.isfinite(scale) else 0.0
    depth = place - shell.X
    inside, shocked = depth < 0, (depth >= 0) & (depth < width)
    P = np.select([inside, shocked], [shell.P, shell.P * np.exp(np.clip(depth, 0, width) / scale)], cold[0] * c2)
    rho = np.select([inside, shocked], [hot[0] * X0 / shell.X, P / c2], cold[0])
    v = np.select([inside, shocked], [shell.v * place / shell.X, shell.v], 0.0)
    return {"rho": rho, "P": P, "v": v if x.ndim == 1 else np.stack([v, 0 * v, 0 * v], axis=1)}
