"""Pokes: a push, a pulse of pressure or of field around a place, added to the state of a live run.

All weigh with f(q) = (1 - q^2)^4 within a radius, q = r/radius: smooth, and nothing outside. The radius ends at half
a period, or f would have a kink where the images meet. In a strip, drawn as value against x, r is the distance along x.
The ledger is told what they give, so a poke is no drift. Done in numpy: the same bits for any number of threads.
"""

import numpy as np

from ..recast import Books, again
from ..render.layout import is_profile

LEAST = -0.99  # a pulse takes at most this share of the pressure


def allowed(sim) -> list[str]:
    """The pokes that mean something in this scene."""
    members = sim.particles.members
    kinds = ["push"] + (["pressure"] if {"u", "E"} & set(sim.particles.names) else [])
    return kinds + (["field"] if {"b", "B"} & set(sim.particles.names) and "B" in members else [])


def axes(sim) -> int:
    """How many axes a poke sees."""
    return 1 if is_profile(sim.scene.box) else sim.dim


def periods(sim) -> list[float]:
    """The period of each of them, 0 where there is none."""
    boundary, box = sim.scene.boundary, sim.scene.box
    return [box.size[a] if boundary.periodic[a] else 0.0 for a in range(axes(sim))]


class Touch:
    """The members of all particles in memory order, to be changed and put back."""

    def __init__(self, sim, place, radius: float):
        sim.begin()
        self.books = Books.of(sim)
        self.sim, self.radius = sim, min([radius, *(0.5 * size for size in periods(sim) if size)])
        self.table, self.ids = sim.particles.table()
        self.columns = {name: slice(first, first + kind) for name, kind, first in sim.particles.layout}
        self.d = self.apart(np.asarray(place, float))
        q2 = np.minimum((self.d**2).sum(axis=1) / self.radius**2, 1.0)
        free = 1.0 - self.table[:, self.columns["held"]].ravel() if "held" in self.columns else 1.0
        self.f, self.slope = (1 - q2) ** 4 * free, -8 * (1 - q2) ** 3 * free / self.radius**2  # f, and f'(r)/r

    def apart(self, place: np.ndarray) -> np.ndarray:
        """x - place (N, d), to the nearest image."""
        d = self["x"].astype(float) - place
        for a, size in enumerate(periods(self.sim)):
            if size:
                d[:, a] -= size * np.round(d[:, a] / size)
        d[:, axes(self.sim) :] = 0.0
        return d

    def __getitem__(self, name: str) -> np.ndarray:
        """A member (N,) or (N, components); changing it in place changes the table."""
        part = self.table[:, self.columns[name]]
        return part[:, 0] if part.shape[1] == 1 and name != "x" else part

    def __contains__(self, name: str) -> bool:
        return name in self.columns

    def done(self) -> None:
        """Put the members back; rates, and the ledger, belong to the new state."""
        self.sim.particles.admit(self.table, self.ids)
        again(self.sim)
        self.books.carry(self.sim)


def push(sim, place, velocity, radius: float) -> None:
    """v += velocity f. velocity: (d,) or (3,)."""
    touch = Touch(sim, place, radius)
    kick = np.zeros(3)
    kick[: len(velocity)] = velocity
    dv = touch.f[:, None] * kick
    if "E" in sim.particles.names:
        touch["E"][:] += (touch["v"] * dv).sum(axis=1) + 0.5 * (dv**2).sum(axis=1)
    touch["v"][:] += dv
    touch.done()


def pressure(sim, place, strength: float, radius: float) -> None:
    """u *= 1 + strength f, and P with it; strength is cut at -0.99."""
    touch = Touch(sim, place, radius)
    du = touch["u"] * max(strength, LEAST) * touch.f
    touch["u"][:] += du
    if "E" in sim.particles.names:
        touch["E"][:] += du
    touch.done()


def field(sim, place, strength: float, radius: float) -> None:
    """B += curl(A_z e_z), A_z = strength B0 radius/2 f: a loop of field, without divergence wherever it is added.

    B0 is the r.m.s. field, or where there is none the field whose pressure is that of the gas; the factor makes the
    strongest field of the pulse about strength times B0. In 1-D curl(A_z e_z) is a pulse of B_y. The pressure stays.
    """
    touch = Touch(sim, place, radius)
    rho, B = touch["rho"], touch["B"].astype(float)
    B0 = np.sqrt((B**2).sum(axis=1).mean()) or np.sqrt(2 * touch["P"].mean())
    grad = 0.5 * strength * B0 * touch.radius * touch.slope[:, None] * touch.d
    dB = np.zeros_like(B)
    dB[:, 1] = -grad[:, 0]
    if grad.shape[1] > 1:
        dB[:, 0] = grad[:, 1]
    if "E" in sim.particles.names:
        touch["E"][:] += ((B * dB).sum(axis=1) + 0.5 * (dB**2).sum(axis=1)) / rho
    touch["B"][:] += dB
    if "b" in touch:
        touch["b"][:] += dB / rho[:, None]
    touch.done()
