"""Rows: what dispersion.json and dispersion.csv hold."""

import csv
import io
from numbers import Real

import numpy as np

from ..terms.xi_rules import xi_of
from .branches import NAMES
from .result import Dispersion

SPEEDS = [f"{kind}{name}" for kind in ("", "exact_", "damping_") for name in NAMES]


def row(variant: str, parameters: dict, found: Dispersion) -> dict:
    """One analysed state: what was set, xi and beta, and its fastest-growing mode."""
    best = {**found.best, "eigenvector": {name: [a.real, a.imag] for name, a in found.best["eigenvector"].items()}}
    state = {"xi": xi(found), "beta": found.gas.beta, "lattice": found.patch.name, "kernel": repr(found.scene.kernel)}
    return {"variant": variant, "parameters": parameters, **state, **best, "unit": unit(found)}


def unit(found: Dispersion) -> str:
    """What growth and frequency are measured in."""
    return "v_A/dx" if found.gas.v_A else "c_s/dx"


def xi(found: Dispersion) -> float:
    """What DivBSource takes off at this beta; 0 where the scene has none."""
    term = next((term for term in found.scene.terms if hasattr(term, "xi")), None)
    value = getattr(term, "xi", 0.0)
    return float(value) if isinstance(value, Real) else float(xi_of(term, np.array([found.gas.beta]))[0])


def state(found: Dispersion) -> dict:
    """The uniform state, the arrangement and the equations."""
    gas, scene = found.gas, found.scene
    return {
        "rho": found.background.rho,
        "P": gas.P,
        "B": gas.B,
        "cs": gas.cs,
        "v_A": gas.v_A,
        "unit": unit(found),
        "unit_of_growth": gas.pace / found.patch.dx,
        "lattice": found.patch.name,
        "dx": found.patch.dx,
        "kernel": repr(scene.kernel),
        "terms": [str(term) for term in scene.terms],
        "boundary_xi": 0.5 * (1 - gas.beta) if gas.v_A else None,
    }


def lines(found: Dispersion) -> dict:
    """{angle: columns} of speeds over wavelength."""
    return {f"{angle:g}": columns for angle, columns in found.lines.items()}


def table_of_scan(rows: list[dict]) -> str:
    """CSV: one line an analysed state."""
    names = [name for name in rows[0] if name not in ("parameters", "k", "eigenvector")]
    given = list(rows[0]["parameters"])
    head = [f"set {name}" for name in given] + [*names, "k_x", "k_y", "k_z"]
    return as_csv(head, [[*(r["parameters"][n] for n in given), *(r[n] for n in names), *padded(r["k"])] for r in rows])


def table_of_waves(analysed: dict[str, Dispersion]) -> str:
    """CSV: one line a wave vector of the map (growth), then of the lines (growth and speeds)."""
    head = ["variant", "where", "wavelength", "angle", "turn", "k_x", "k_y", "k_z", "growth", *SPEEDS]
    body = []
    for label, found in analysed.items():
        body += [[label, "map", *rest, *[""] * len(SPEEDS)] for rest in of_map(found)]
        body += [[label, "line", *rest] for rest in of_lines(found)]
    return as_csv(head, body)


def of_map(found: Dispersion):
    """Wavelength, angle, turn, k and growth of every wave vector of the grid."""
    looked, k = found.grid, found.grid.vectors()
    looked_at = (looked.lengths, looked.angles, looked.turns)
    for place in np.ndindex(*found.growth.shape):
        length, angle, turn = (part[n] for part, n in zip(looked_at, place, strict=True))
        yield [2 * np.pi / length, angle, turn, *padded(k[place]), found.growth[place]]


def of_lines(found: Dispersion):
    """The same of the lines, with the speeds."""
    for angle, columns in found.lines.items():
        for n, wavelength in enumerate(columns["wavelength"]):
            speeds = [columns[name][n] if np.ndim(columns[name]) else columns[name] for name in SPEEDS]
            yield [wavelength, angle, 0.0, "", "", "", columns["growth"][n], *speeds]


def padded(k) -> list:
    """Three components."""
    return [*map(float, k), *[0.0] * (3 - len(k))]


def as_csv(head: list[str], body: list[list]) -> str:
    """Text with numbers in nine digits."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(head)
    writer.writerows([[f"{cell:.9g}" if isinstance(cell, float) else cell for cell in line] for line in body])
    return out.getvalue()
