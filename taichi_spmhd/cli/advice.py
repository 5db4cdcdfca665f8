"""What can be foreseen to go wrong, from the start of a simulation."""

import numpy as np

from ..terms import DivBSource, StressShift, xi_of
from ..terms.hyperbolic import Hyperbolic

ROUND = 1e-5  # a disturbance smaller than this share of its background drowns in the rounding of f32


def warnings(sim) -> list[str]:
    """One line each, with the cure; empty where all is well."""
    columns, terms = sim.columns(), {type(term).__name__: term for term in sim.scene.terms}
    found = []
    if "Stress" in terms and "B" in columns:
        found += clumping(columns, terms)
    of_stress = [name for name, term in terms.items() if isinstance(term, Hyperbolic | DivBSource | StressShift)]
    if "Stress" not in terms:
        found += [f"{name} without Stress: nothing feels the field it acts on; list Stress()" for name in of_stress]
    if sim.particles.word().itemsize == 4:
        found += rounding(columns)
    return found


def clumping(columns: dict, terms: dict) -> list[str]:
    """xi against (1 - beta)/2, and against what is known of very low beta."""
    B2 = (columns["B"].astype(float) ** 2).sum(axis=1)
    if not B2.any() or getattr(terms.get("StressShift"), "lift", 0.0) >= 1:
        return []
    beta = 2 * columns["P"].astype(float) / np.maximum(B2, 1e-30)
    xi, need = xi_of(terms.get("DivBSource"), beta), (1 - beta) / 2
    lacking = np.flatnonzero(xi < need - 1e-9)
    if len(lacking):
        k, late = lacking[np.argmin(beta[lacking])], "; Repulsion only delays it" if "Repulsion" in terms else ""
        return [
            f"will clump: the lowest beta is {beta[k]:.3g}, so particles attract each other along B unless "
            f"xi >= (1 - beta)/2 = {need[k]:.3g}; here xi = {xi[k]:g}: add DivBSource(xi=0.5){late}"
        ]
    k = int(np.argmin(beta))
    if beta[k] < 0.01 and xi[k] < 1:
        return [f"xi = {xi[k]:g} is marginal at beta = {beta[k]:.2g} (below 0.01); take DivBSource(xi=1)"]
    return []


def rounding(columns: dict) -> list[str]:
    """Members whose disturbance f32 cannot hold."""
    found = []
    for name in ("v", "B", "P"):
        if name in columns:
            values = columns[name].astype(float)
            scale = np.abs(columns["vw"]).max() if name == "v" else np.abs(values).max()
            spread = float(np.ptp(values, axis=0).max())
            if 1e-7 * scale < spread < ROUND * scale:
                found.append(f"{name} varies by {spread / scale:.0e} of its size and f32 keeps 7 digits; take f64")
    return found
