"""Noh's implosion: cold gas stops behind a shock that walks outwards at constant speed."""

import numpy as np

from ..errors import InputError


def noh(x, t: float, gamma: float = 5 / 3) -> dict:
    """rho, v and P of cold gas that falls inwards at speed 1 from t = 0 on; x: (N, d) from the centre, d = 1, 2, 3.

    Behind R = (gamma - 1) t/2 it rests, rho = ((gamma + 1)/(gamma - 1))^d and P = (gamma - 1) rho/2; ahead
    rho = (1 + t/r)^(d - 1), v_r = -1, P = 0 (Noh 1987, JCP 72, 78). Returns rho, P (N,) and v (N, 3). Raises InputError
    for gamma <= 1 and t < 0.
    """
    if not (gamma > 1 and t >= 0):
        raise InputError(f"noh: gamma = {gamma} must be above 1 and t = {t} at least 0")
    x = np.asarray(x, dtype=float)
    dim, r = x.shape[1], np.linalg.norm(x, axis=1)
    behind, away = r < 0.5 * (gamma - 1) * t, np.maximum(r, 1e-300)
    dense = ((gamma + 1) / (gamma - 1)) ** dim
    v = np.pad(np.where(behind[:, None], 0.0, -x / away[:, None]), ((0, 0), (0, 3 - dim)))
    with np.errstate(over="ignore"):
        rho = np.where(behind, dense, (1 + t / away) ** (dim - 1))
    return {"rho": rho, "v": v, "P": np.where(behind, 0.5 * (gamma - 1) * dense, 0.0)}
