"""What stands beside the seconds of a run: errors, and whether it is right in what the error does not see."""

from ..diagnostics.clumping import clumping
from ..diagnostics.errors import errors
from ..diagnostics.field import div_B_figures
from ..diagnostics.ledger import drifts


def figures(sim) -> dict:
    """Size, steps, errors by member, drifts measured and predicted, div B, clumping, floors."""
    columns = sim.columns()
    out = {
        "particles": len(sim),
        "steps": int(sim.steps),
        "t": float(sim.time),
        "bytes_per_particle": int(sim.particles.bytes_each + sim.neighbours.bytes_each),
        "errors": errors(sim, columns),
        **drifts(sim, columns),
        "close_pairs": clumping(sim, columns).get("close_pairs"),
        "floors": int(sim.floors),
    }
    return {**out, "div_B": div_B_figures(sim, columns)} if "B" in columns else out
