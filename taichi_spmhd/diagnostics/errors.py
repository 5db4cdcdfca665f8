"""Errors against a scene's exact solution or its stored map."""

import numpy as np

from .reference import reference_errors

AXES = "xyz"


def errors(sim, columns: dict | None = None) -> dict[str, float]:
    """Normalised L1 by member: against the exact solution, else the stored map; {} where there is neither."""
    return {**reference_errors(sim), **exact_errors(sim, columns)}


def exact_errors(sim, columns: dict | None = None) -> dict[str, float]:
    """Normalised L1 at the particles, mean|f - exact| / mean|exact|, by member; {} for a scene without a solution.

    Vectors give one entry for the whole, B: mean |B - exact| / mean |exact| of the lengths, and one a component (B_x,
    B_y, B_z). A component whose exact value vanishes everywhere is measured against the mean magnitude of the vector;
    what vanishes altogether has no relative error and is left out. Frozen ends are left out too: their outermost
    particles have neighbours on one side only.
    """
    if sim.scene.exact is None:
        return {}
    columns = columns or sim.columns()
    free = columns["held"] == 0 if "held" in columns else np.full(len(sim), True)
    out = {}
    for name, solution in sim.scene.exact(columns["x"][free], sim.time).items():
        out.update(member_errors(name, columns[name][free], np.asarray(solution, float)))
    return out


def member_errors(name: str, have: np.ndarray, exact: np.ndarray) -> dict[str, float]:
    """The entries of one member; exact may be a number or a vector that broadcasts."""
    exact = np.broadcast_to(exact, have.shape)
    if have.ndim == 1:
        scale = np.abs(exact).mean()
        return {name: float(np.abs(have - exact).mean() / scale)} if scale > 0 else {}
    magnitude = np.linalg.norm(exact, axis=1).mean()
    if not magnitude > 0:
        return {}
    tiny = 1e-12 * magnitude  # a component that is zero but for round-off
    scale = [part if part > tiny else magnitude for part in np.abs(exact).mean(axis=0)]
    error = np.abs(have - exact).mean(axis=0)
    whole = float(np.linalg.norm(have - exact, axis=1).mean() / magnitude)
    return {name: whole, **{f"{name}_{AXES[a]}": float(error[a] / scale[a]) for a in range(have.shape[1])}}
