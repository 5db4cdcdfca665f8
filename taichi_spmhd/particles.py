"""Particles: one record each, with the members the parts of a scene ask for and no others; numpy in and out."""

import numpy as np

from .runtime import ti
from .types import components, integer, real, struct, vec3, vecd

HOT = {"x": vecd, "m": real, "hinv": real, "g": real, "v": vec3}  # what every pair loads
COLD = {"h": real, "rho": real, "Omega": real, "id": integer, "x0": vecd, "h0": real}  # x0, h0: at the last list build


@ti.data_oriented
class Particles:
    """The state in memory order (sorted by cell at the last list build), its rates, and the permutation of both.

    Record n is nobody, who fills the neighbour rows up to whole vectors: without mass from the start (fields are zero
    when they are made), and with the other members of particle 0 from the first evaluation on.

    members, evolved: {name: type name}. Everything lives in one field tree, which `close` gives back.
    """

    def __init__(self, n: int, dim: int, members: dict, evolved: dict):
        self.n, self.dim = n, dim
        self.members = {**HOT, **members, **COLD}
        self.evolved, self.names = evolved, tuple(evolved)
        self.vectors = tuple(name for name, kind in self.members.items() if kind is vec3)
        self.scalars = tuple(name for name, kind in self.members.items() if kind in (real, integer))
        self.State, self.Rate = struct(self.members, dim), struct(evolved, dim)
        self.tree = ti.FieldsBuilder()
        self.state, self.spare = self.place(self.State, n + 1), self.place(self.State, n + 1)
        self.rate, self.old = self.place(self.Rate), self.place(self.Rate)
        self.layout, self.width = [], 0
        for name, kind in self.members.items():
            if name != "id":
                self.layout.append((name, components(kind, dim), self.width))
                self.width += components(kind, dim)
        self.word = np.float64 if ti.lang.impl.get_runtime().default_fp == ti.f64 else np.float32
        self.companions: list = []  # (field, spare) pairs that follow the state's order
        self.summed = 0  # columns of the rows that neighbour sums are left in (sums.py)

    def place(self, kind, size: int | None = None):
        """A field of a struct type, one record a particle unless a size is given, in this simulation's tree."""
        field = kind.field()
        self.tree.dense(ti.i, size or self.n).place(field)
        return field

    def finish(self) -> None:
        """Allocate: nothing can be placed afterwards."""
        self.owner = self.tree.finalize()
        ti.lang.impl.get_runtime().materialize()  # Taichi 1.7.4 crashes on fields destroyed before it looked at them

    def close(self) -> None:
        """Give the memory back."""
        if getattr(self, "owner", None) is not None:
            self.owner.destroy()
            self.owner = None

    @property
    def bytes_each(self) -> int:
        """Bytes of memory a particle: state and permutation buffers, rates, neighbour sums; the neighbour list not."""
        word = self.word().itemsize
        size = {
            kind: (4 if kind is integer else word * components(kind, self.dim)) for kind in set(self.members.values())
        }
        state = sum(size[kind] for kind in self.members.values())
        rate = sum(word * components(kind, self.dim) for kind in self.evolved.values())
        return 2 * state + (2 + 2 * len(self.companions)) * rate + word * self.summed

    @ti.kernel
    def permute(self, field: ti.template(), spare: ti.template(), order: ti.types.ndarray(dtype=ti.i32, ndim=1)):
        """field[n] <- field[order[n]]"""
        for n in range(self.n):
            spare[n] = field[order[n]]
        for n in range(self.n):
            field[n] = spare[n]

    @ti.kernel
    def export(self, out: ti.types.ndarray(ndim=2), ids: ti.types.ndarray(dtype=ti.i32, ndim=1)):
        """Every member as columns of one table, in memory order: one kernel, however many members."""
        for n in range(self.n):
            record = self.state[n]
            ids[n] = record.id
            for name, kind, first in ti.static(self.layout):
                if ti.static(name in self.scalars):
                    out[n, first] = ti.cast(record[name], float)
                else:
                    for c in ti.static(range(kind)):
                        out[n, first + c] = record[name][c]

    @ti.kernel
    def admit(self, table: ti.types.ndarray(ndim=2), ids: ti.types.ndarray(dtype=ti.i32, ndim=1)):
        """The inverse of export."""
        for n in range(self.n):
            self.state[n].id = ids[n]
            for name, kind, first in ti.static(self.layout):
                if ti.static(name in self.scalars):
                    self.state.get_member_field(name)[n] = ti.cast(
                        table[n, first], self.state.get_member_field(name).dtype
                    )
                else:
                    for c in ti.static(range(kind)):
                        self.state.get_member_field(name)[n][c] = table[n, first + c]

    def table(self) -> tuple[np.ndarray, np.ndarray]:
        """(n, columns) of all members but id, and the caller's index (n,), in memory order."""
        out, ids = np.empty((self.n, self.width), self.word), np.empty(self.n, np.int32)
        self.export(out, ids)
        return out, ids

    def read(self) -> dict[str, np.ndarray]:
        """All members by name, in the order in which the particles were given, shapes (n,) or (n, components)."""
        out, ids = self.table()
        ordered = np.empty_like(out)
        ordered[ids] = out
        return {
            name: ordered[:, first] if name in self.scalars else ordered[:, first : first + kind]
            for name, kind, first in self.layout
        }

    def rates(self) -> dict[str, np.ndarray]:
        """Rates of the last evaluation, in memory order."""
        return {name: self.rate.get_member_field(name).to_numpy() for name in self.evolved}

    def admit_rates(self, rates: dict[str, np.ndarray]) -> None:
        """The inverse of rates."""
        for name in self.evolved:
            self.rate.get_member_field(name).from_numpy(rates[name])
