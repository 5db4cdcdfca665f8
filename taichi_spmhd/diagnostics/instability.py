"""What the tensile instability shows in: the force that drives it, where neighbours lie, how many attract."""

from .anisotropy import anisotropy
from .force import div_B_force
from .negative_pairs import negative_pairs

MEASURES = {"div_B_force": div_B_force, "anisotropy": anisotropy, "negative_pairs": negative_pairs}


def instability(sim, columns: dict | None = None) -> dict[str, float]:
    """All three of a scene with a field; {} without one."""
    columns = columns or sim.columns()
    return {name: measure(sim, columns) for name, measure in MEASURES.items()} if "B" in columns else {}
