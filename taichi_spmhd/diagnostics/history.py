"""One row of history_<variant>.csv: what a frame's state contains, so that a run can be followed as numbers."""

from .clumping import clumping
from .correlation import first_peak
from .field import div_B_figures
from .instability import MEASURES, instability
from .ledger import drifts, energies, momentum, predicted

COLUMNS = (
    "t", "step", "dt", "E_kin", "E_int", "E_mag", "E_clean", "E_tot", "p_x", "p_y", "p_z", "E_drift_predicted",
    "p_drift_predicted_x", "p_drift_predicted_y", "p_drift_predicted_z", "smallest_gap", "mean_gap", "close_pairs",
    "div_B_mean", "div_B_p99", "div_B_max", "floors", "first_peak", "anisotropy", "negative_pairs", "div_B_force",
)  # fmt: skip


def history_row(sim) -> dict[str, float]:
    """The columns in their order. Predicted drifts are absolute, as E_tot and p are; what a scene lacks is 0."""
    columns = sim.columns()
    drifts(sim, columns)  # notes the largest v_rms so far
    energy, push = predicted(sim, columns)
    row = {"t": float(sim.time), "step": int(sim.steps), "dt": float(sim.dt), **energies(sim, columns)}
    row.update(by_axis("p", momentum(sim, columns)))
    row["E_drift_predicted"] = energy
    row.update(by_axis("p_drift_predicted", push))
    row.update({**clumping(sim, columns), "first_peak": first_peak(sim, columns)})
    figures = div_B_figures(sim, columns) if "B" in columns else dict.fromkeys(("mean", "p99", "max"), 0.0)
    row.update({f"div_B_{name}": value for name, value in figures.items()})
    row.update(instability(sim, columns) or dict.fromkeys(MEASURES, 0.0))
    row["floors"] = int(sim.floors)
    return {name: row[name] for name in COLUMNS}


def by_axis(name: str, vector) -> dict[str, float]:
    """name_x, name_y, name_z."""
    return {f"{name}_{axis}": float(value) for axis, value in zip("xyz", vector, strict=True)}
