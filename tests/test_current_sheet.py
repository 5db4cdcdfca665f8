"""Current sheets: the field only decays, and what it loses is accounted for."""

import numpy as np
import pytest

from taichi_spmhd import Simulation, load_scene
from taichi_spmhd.diagnostics import energies


def course(label: str, nx: int, t_end: float, samples: int) -> tuple[np.ndarray, dict]:
    """Magnetic energies at equal times, the start included, and the summary at the end."""
    with Simulation(load_scene("current_sheet", nx=nx, t_end=t_end)[label]) as sim:
        field = [energies(frame)["E_mag"] for frame in sim.frames(samples)]
        assert all(np.isfinite(values).all() for values in sim.columns().values())
        return np.array(field), sim.summary()


def unexplained(summary) -> float:
    """The relative energy drift that the ledger does not predict."""
    return abs(summary["energy_drift"] - summary["energy_drift_predicted"])


@pytest.mark.slow
@pytest.mark.parametrize("label, left, drift", [
    ("xi = 0", (0.0, 0.2), 1e-4),
    ("without resistivity", (1.2, 1.8), 1e-3),
    ("with resistivity", (1.0, 1.5), 1e-4),
])  # fmt: skip
def test_the_sheets_survive_and_lose_what_each_scheme_takes(label, left, drift):
    # measured at t = 5, nx = 32, of 2.0: .102 at xi = 0 (the lattice tears up, resistivity eats the field), 1.41
    # without and 1.25 with resistivity. Energy that the ledger does not explain: 2e-5, 9e-5, 6e-6
    field, summary = course(label, 32, 5.0, 11)
    assert field[0] == pytest.approx(2.0, rel=1e-3)  # B^2/2 over a box of 4
    assert left[0] < field[-1] < left[1]
    # the bending flow has 0.01 to give, and wraps the field up a little: measured 0.0067 in the first half unit
    assert (np.diff(field) < 0.01).all() and (np.diff(field)[1:] < 0).all()
    assert unexplained(summary) < drift
    assert summary["floors"] == 0
