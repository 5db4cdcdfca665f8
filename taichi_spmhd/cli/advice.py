"""What can be foreseen to go wrong, from the start of a simulation."""

import numpy as np

from ..terms.hyperbolic import Hyperbolic

ROUND = 1e-5  # a disturbance smaller than this share of its background drowns in the rounding of f32


def warnings(sim) -> list[str]:
    """One line each, with the cure; empty where all is well."""
    columns, terms = sim.columns(), {type(term).__name__: term for term in sim.scene.terms}
    found = []
    if "Stress" in terms and "B" in columns:
        found += clumping(columns, getattr(terms.get("DivBSource"), "xi", 0.0))
    cleaning = [name for name, term in terms.items() if isinstance(term, Hyperbolic)]
    if cleaning and "Stress" not in terms:
        found.append(f"{cleaning[0]} without Stress: nothing feels the field that is cleaned; list Stress()")
    if "DivBSource" in terms and "Stress" not in terms:
        found.append("DivBSource without Stress: there is no force along B to take away; list Stress()")
    if sim.particles.word().itemsize == 4:
        found += rounding(columns)
    return found


def clumping(columns: dict, xi: float) -> list[str]:
    """xi against (1 - beta)/2 and against what is known of very low beta."""
    B2 = (columns["B"].astype(float) ** 2).sum(axis=1)
    if not B2.any():
        return []
    lowest = float((2 * columns["P"] / np.maximum(B2, 1e-30)).min())
    need = (1 - lowest) / 2
    if xi < need - 1e-9:
        return [
            f"will clump: the lowest beta is {lowest:.3g}, so particles attract each other along B unless "
            f"xi >= (1 - beta)/2 = {need:.3g}; here xi = {xi:g}: add DivBSource(xi=0.5)"
        ]
    if lowest < 0.01 and xi < 1:
        return [f"xi = {xi:g} is marginal at beta = {lowest:.2g} (below 0.01); take DivBSource(xi=1)"]
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
