"""The linearised right-hand side: how the rates of all particles answer to a small push of one, by the code itself.

Each member that is evolved, and the positions, are displaced at one particle, by +s, -s, +4s and -4s; density, list,
close, gather and pair loop are those of a run. With r(s) = (rates(+s) - rates(-s))/(2s), the answer is 2 r(s) - r(4s):
what is linear stays, what is of order sqrt(s) (conduction by the pressure's jump) drops out as it does for small waves.
A term with a kink at rest (viscosity acts on approaching pairs alone) is taken as the mean of both sides: half its
strength on all pairs, the energy it takes from a wave. Kinks of second order (beta of the viscosity, |v x e|) vanish.
Godunov's limiters and shock switch are off (Part.smooth), and what it predicts within a step is not there: dt is 0.
The largest numbers of all particles (`most`) are those that the code finds.
"""

import numpy as np

from ..simulation import Simulation
from ..types import components

SMALL = 1e-5  # the push in units of each member, of u itself for the energies: rounding leaves 1e-10 of a rate
FAINT = 1e-10  # of the largest answer: beyond all supports nothing changes, not a bit, but for numbers that are global


class Response:
    """Answers of a uniform state on a patch.

    names: (member, component) of each row; units: of each row; pace: of all rates, in 1/time; answers: for every
    particle of the cell the indices of those that answer, and (columns, those, rows) in units.
    """

    def __init__(self, sim: Simulation, patch, speed: float):
        self.patch = patch
        self.names = rows_of(sim)
        self.units = np.array([unit(sim, name, patch.dx, speed) for name, _ in self.names])
        self.pace = speed / patch.dx
        self.answers = [self.answer(sim, index) for index in patch.cell]

    def answer(self, sim: Simulation, index: int) -> tuple[np.ndarray, np.ndarray]:
        """The answers to every push of one particle: which particles answer, (columns, particles, rows) in units."""
        table, ids = sim.particles.table()
        place = int(np.flatnonzero(ids == index)[0])
        found = np.stack([self.column(sim, table, ids, place, k) for k in range(len(self.names))])
        sim.particles.admit(table, ids)
        in_order = np.empty_like(found)
        in_order[:, ids] = found
        felt = np.abs(in_order).max(axis=(0, 2))
        felt[index] = np.inf
        who = np.flatnonzero(felt > FAINT * np.abs(in_order).max())
        return who, in_order[:, who]

    def column(self, sim: Simulation, table: np.ndarray, ids: np.ndarray, place: int, k: int) -> np.ndarray:
        """(particles, rows): rates per push of one component, in units of both."""
        name, component = self.names[k]
        first = sim.particles.first
        where = first[name] + component
        size = SMALL * (float(table[place, first["u"]]) if name in ("u", "E") else self.units[k])
        near, far = (self.slope(sim, table, ids, place, where, size * factor) for factor in (1.0, 4.0))
        return (2 * near - far) * self.units[k] / (self.units * self.pace)

    def slope(self, sim, table: np.ndarray, ids: np.ndarray, place: int, where: int, size: float) -> np.ndarray:
        """(rates(+size) - rates(-size)) / (2 size), the steps as they are rounded."""
        rates, steps = [], []
        for sign in (1.0, -1.0):
            pushed = table.copy()
            pushed[place, where] += sign * size
            steps.append(pushed[place, where])
            sim.particles.admit(pushed, ids)
            sim.rhs.evaluate(0.0, 0.0)
            rates.append(self.rates(sim, pushed))
        return (rates[0] - rates[1]) / (steps[0] - steps[1])

    def rates(self, sim: Simulation, table: np.ndarray) -> np.ndarray:
        """Rates of all rows, (particles, rows), last evaluated for this table: positions move with its v."""
        rates, v = sim.particles.rates(), sim.particles.first["v"]
        return np.column_stack(
            [table[:, v + c] if name == "x" else rates[name].reshape(len(table), -1)[:, c] for name, c in self.names]
        )


def rows_of(sim: Simulation) -> list[tuple[str, int]]:
    """Positions, then every evolved member but what only the ledger keeps."""
    kinds = {"x": sim.dim, **{n: components(kind, sim.dim) for n, kind in sim.particles.evolved.items()}}
    return [(name, c) for name, count in kinds.items() if not name.startswith("leak") for c in range(count)]


def unit(sim: Simulation, name: str, dx: float, speed: float) -> float:
    """What a member is measured in: spacings, the fastest speed, and what such a speed makes of the others."""
    rho = float(sim["rho"].mean())
    known = {"x": dx, "v": speed, "b": speed / np.sqrt(rho), "u": speed**2, "E": speed**2, "y": speed * np.sqrt(rho)}
    known["u_own"] = speed**2
    known["psi"] = speed**2 * np.sqrt(rho)
    return known.get(name, 1.0)
