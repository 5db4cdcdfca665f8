"""The ledger of conservation: what a run began with, what it has now, and the drift its own terms predict.

DivBSource does not conserve momentum and energy. What its force adds is integrated beside v, with the same rates and
the same steps (members leak_v, leak_E per mass), so the drift is known beforehand:

    p - p0 = sum_i m_i leak_v,i        E - E0 = sum_i m_i leak_E,i  -  what cleaning's damping took

All sums run over the caller's order in f64, so that they do not depend on the number of threads.
"""

from dataclasses import dataclass

import numpy as np

from ..eos import Radiating


@dataclass
class Ledger:
    """Energy E0, momentum p0 (3,), the largest h (`widest`) at the start; v_rms: the largest at any reading so far."""

    E0: float
    p0: np.ndarray
    v_rms: float
    widest: float

    @classmethod
    def opened(cls, sim) -> "Ledger":
        """The entries of the present state, which is the start."""
        columns = sim.columns()
        E0, p0 = energies(sim, columns)["E_tot"], momentum(sim, columns)
        return cls(E0, p0, speed(columns), float(columns["h"].max()))


def total(columns: dict, values) -> float:
    """sum_i m_i values_i; values (N,) or, squared and summed over components, (N, 3)."""
    values = np.asarray(values, float)
    per_mass = (values**2).sum(axis=1) if values.ndim == 2 else values
    return float((columns["m"].astype(float) * per_mass).sum())


def energies(sim, columns: dict | None = None) -> dict[str, float]:
    """E_kin, E_int, E_mag = sum m B^2/(2 rho), E_clean = sum m y^2/(2 rho), their sum E_tot; 0 if there is none."""
    c = columns or sim.columns()
    out = {"E_kin": 0.5 * total(c, c["v"]), "E_int": internal(sim, c)}
    out["E_mag"] = 0.5 * total(c, c["B"] / np.sqrt(c["rho"])[:, None]) if "B" in c else 0.0
    out["E_clean"] = 0.5 * total(c, c["y"] ** 2 / c["rho"]) if "y" in c else 0.0
    return {**out, "E_tot": sum(out.values())}


def internal(sim, columns: dict) -> float:
    """sum m u; for a gas without u the free energy c^2 (1 + ln(rho V/M)) per mass, which the forces conserve too."""
    eos = sim.scene.eos
    if not isinstance(eos, Radiating):
        return total(columns, columns["u"])
    mean = float(columns["m"].astype(float).sum()) / sim.scene.box.volume
    return total(columns, eos.free_energy(columns, mean))


def momentum(sim, columns: dict | None = None) -> np.ndarray:
    """sum m v, (3,)."""
    c = columns or sim.columns()
    return (c["m"].astype(float)[:, None] * c["v"]).sum(axis=0)


def predicted(sim, columns: dict | None = None) -> tuple[float, np.ndarray]:
    """The changes of energy and momentum (3,) since the start that the terms account for; 0 where all is conserved."""
    c = columns or sim.columns()
    if "leak_E" not in c:
        return 0.0, np.zeros(3)
    kick = (c["m"].astype(float)[:, None] * c["leak_v"]).sum(axis=0) if "leak_v" in c else np.zeros(3)
    return total(c, c["leak_E"]), kick


def speed(columns: dict) -> float:
    """The r.m.s. velocity, weighted by mass."""
    return float(np.sqrt(total(columns, columns["v"]) / columns["m"].astype(float).sum()))


def drifts(sim, columns: dict | None = None) -> dict[str, float]:
    """(E - E0)/E0 and |p - p0|/(M v_rms), measured and predicted; v_rms is the largest at any reading so far."""
    c = columns or sim.columns()
    ledger = sim.ledger
    ledger.v_rms = max(ledger.v_rms, speed(c))
    energy, push = predicted(sim, c)
    E_scale = ledger.E0 or 1.0
    p_scale = float(c["m"].astype(float).sum()) * ledger.v_rms or 1.0
    return {
        "energy_drift": (energies(sim, c)["E_tot"] - ledger.E0) / E_scale,
        "energy_drift_predicted": energy / E_scale,
        "momentum_drift": float(np.linalg.norm(momentum(sim, c) - ledger.p0)) / p_scale,
        "momentum_drift_predicted": float(np.linalg.norm(push)) / p_scale,
    }
