"""Readings: what the live plots show of one simulation, a row a few times a second.

The noise is read more often: a lattice is torn up within ten dx/v_A, between a few rows. When depends on the time of
the scene alone.
"""

import time

import numpy as np

from ..diagnostics.clumping import CLOSE, squared_gaps
from ..diagnostics.errors import errors
from ..diagnostics.field import div_B
from ..diagnostics.ledger import drifts
from ..diagnostics.rows import rows
from .growth import Growth, noise

COLUMNS = (
    "t", "ms", "updates", "E_drift", "E_drift_predicted", "p_drift", "p_drift_predicted", "mean_gap", "close_pairs",
    "div_B", "error", "noise",
)  # fmt: skip
OFTEN = 0.5  # dx/v_A between two readings of the noise
RARELY = 20.0  # what takes long to find (an error, the noise of many particles) is found again after so many times that


class Readings:
    """`last`: the last row by name, with "smallest_gap"."""

    def __init__(self):
        self.clear()

    def clear(self) -> None:
        """The run begins anew."""
        self.last, self.rates = {}, Growth()
        self.error, self.error_due, self.noise_due, self.heard = None, 0.0, -np.inf, 0.0

    def listen(self, sim) -> None:
        """After every step: the noise, where it is time for it."""
        clock = time.monotonic()
        if sim.time >= self.noise_due and clock >= self.heard:
            columns = sim.columns()
            self.hear(sim, columns, rows(sim, columns))
            self.heard = clock + RARELY * (time.monotonic() - clock)

    def hear(self, sim, columns: dict, found) -> float:
        """The noise at present."""
        shaken, unit = noise(found, columns), pace(sim, columns)
        self.rates.add(sim.time, shaken, unit)
        self.noise_due = sim.time + OFTEN / unit
        return shaken

    def row(self, sim, ms: float, updates: float) -> list:
        """The numbers of COLUMNS at present; None where a scene has none.

        Drifts as in diagnostics.ledger; error: the scene's `measure`, else the mean of its errors; div_B: the mean of
        h|div B|/|B|; gaps in spacings.
        """
        columns = sim.columns()
        found = rows(sim, columns)
        drift = drifts(sim, columns)
        self.last = {
            "t": sim.time,
            "ms": ms,
            "updates": updates,
            "E_drift": drift["energy_drift"],
            "E_drift_predicted": drift["energy_drift_predicted"],
            "p_drift": drift["momentum_drift"],
            "p_drift_predicted": drift["momentum_drift_predicted"],
            **gaps(sim, columns, found),
            "div_B": float(div_B(sim, columns).mean()) if "B" in columns else None,
            "error": self.measured(sim, columns),
            "noise": self.hear(sim, columns, found),
        }
        return [self.last[name] for name in COLUMNS]

    def measured(self, sim, columns: dict) -> float | None:
        """The error against the exact solution or the stored map; what takes long is not asked every time."""
        clock = time.monotonic()
        if clock >= self.error_due:
            every = errors(sim, columns)
            value = every.get(sim.scene.measure, np.mean(list(every.values())) if every else None)
            self.error = None if value is None else float(value)
            self.error_due = clock + RARELY * (time.monotonic() - clock)
        return self.error

    def growth(self) -> float | None:
        """The rate of the noise in v_A/dx with a field, else in c_s/dx; None where it does not grow.

        dx = (m/rho)^(1/d). Rows of a hexagonal lattice are spaced by 1.075 such dx: per row spacing a rate is larger.
        """
        return self.rates.rate()


def gaps(sim, columns: dict, found) -> dict[str, float]:
    """Mean and smallest distance to the nearest neighbour, in spacings, and the share closer than half a spacing."""
    kernel = sim.neighbours.kernel
    most = sim.neighbours.pad * kernel.support * kernel.h_fact  # of a lonely particle: the least its gap can be
    density = (columns["rho"] / columns["m"])[found.ids] ** (1 / sim.dim)
    values = np.minimum(np.sqrt(squared_gaps(found).astype(float)) * density, most)
    return {
        "mean_gap": float(values.mean()),
        "smallest_gap": float(values.min()),
        "close_pairs": float((values < CLOSE).mean()),
    }


def pace(sim, columns: dict) -> float:
    """v_A/dx, or c_s/dx without a field: r.m.s. speed over the mean spacing."""
    rho = columns["rho"].astype(float)
    speed = columns["vw"].astype(float)
    if "B" in columns and columns["B"].any():
        speed = np.sqrt((columns["B"].astype(float) ** 2).sum(axis=1) / rho)
    dx = ((columns["m"] / rho) ** (1 / sim.dim)).mean()
    return float(np.sqrt((speed**2).mean()) / dx)
