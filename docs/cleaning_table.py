"""The cleanings side by side, as Markdown: python docs/cleaning_table.py [nx]   (from the project's root; minutes)

Runs every variant of orszag_tang and mhd_blast: error against the stored grid maps, div B, steps, seconds.
"""

import datetime
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from test_shocks import errors_against  # noqa: E402

from taichi_spmhd import Simulation, load_scene  # noqa: E402
from taichi_spmhd.runtime import hardware, init  # noqa: E402

MAPS = {"orszag_tang": ("ot_t0.50_c128.npz", 0.0), "mhd_blast": ("blast_mhd_t0.15_c128.npz", -0.5)}  # file, corner
HEADERS = (
    "scene", "variant", "error rho", "p", "v", "B", "h div B/B mean", "99 %", "max", "energy drift, unexplained",
    "steps", "stepping",
)  # fmt: skip


def row(name: str, label: str, scene) -> tuple:
    """One run: errors and div B at its end."""
    with Simulation(scene) as sim:
        summary = sim.run().summary()
        error = errors_against(sim, *MAPS[name])
    div_B = (f"{summary['div_B'][key]:.4f}" for key in ("mean", "p99", "max"))
    unexplained = summary["energy_drift"] - summary["energy_drift_predicted"]
    errors = (f"{error[key]:.3f}" for key in ("rho", "p", "v", "B"))
    return f"`{name}`", label, *errors, *div_B, f"{unexplained:.1e}", summary["steps"], f"{summary['seconds']:.1f} s"


def table(nx: int) -> list[str]:
    """Lines of Markdown."""
    rows = [row(name, label, one) for name in MAPS for label, one in load_scene(name, nx=nx).items()]
    day = datetime.datetime.now(datetime.timezone.utc).date()
    lines = [HEADERS, ("---",) * len(HEADERS), *rows]
    return [f"{hardware()}, nx = {nx}, f64, {day}.", "", *("| " + " | ".join(map(str, line)) + " |" for line in lines)]


if __name__ == "__main__":
    init("cpu", "f64", 2)
    print("\n".join(table(int(sys.argv[1]) if len(sys.argv) > 1 else 128)))
