"""The rows of the neighbour list on plain arrays: what the measures of the particles' arrangement loop over.

A kernel that takes nothing but arrays is compiled once a process and not once a simulation. Mirror images are no
particles: they are skipped.
"""

from typing import NamedTuple

import numpy as np

from ..runtime import ti


class Rows(NamedTuple):
    """x (n, 3) in memory order, missing coordinates 0; period (2, 3): length and its inverse, 0 where there is none.

    near, count: the neighbour list; ids (n,): the caller's index of each.
    """

    x: np.ndarray
    period: np.ndarray
    near: object
    count: object
    ids: np.ndarray


def rows(sim, columns: dict) -> Rows:
    """The rows of a simulation whose members are `columns`, in the caller's order."""
    word, wraps = sim.particles.word, np.array(sim.scene.boundary.periodic[: sim.dim])
    period = np.zeros((2, 3), word)
    period[0, : sim.dim] = np.where(wraps, sim.scene.box.size, 0)
    period[1, : sim.dim] = np.where(wraps, 1 / np.array(sim.scene.box.size), 0)
    ids = sim.particles.state.get_member_field("id").to_numpy()[: len(sim)]
    x = np.ascontiguousarray(np.pad(columns["x"][ids], ((0, 0), (0, 3 - sim.dim))), word)
    return Rows(x, period, sim.neighbours.near, sim.neighbours.count, ids)


def sorted_as(found: Rows, values: np.ndarray) -> np.ndarray:
    """Values of the caller's order in memory order, in the precision of the positions."""
    return np.ascontiguousarray(values[found.ids], found.x.dtype)


@ti.func
def somebody(x: ti.template(), n, j):
    """Whether entry j of the row of n is another particle: neither n, nor nobody, nor a mirror image."""
    return j != n and j >= 0 and j < x.shape[0]


@ti.func
def apart(x: ti.template(), period: ti.template(), n, j):
    """x_n - x_j to the nearest periodic image, three components."""
    d = ti.Vector([x[n, a] - x[j, a] for a in range(3)])
    for a in ti.static(range(3)):
        d[a] -= period[0, a] * ti.floor(d[a] * period[1, a] + 0.5)
    return d
