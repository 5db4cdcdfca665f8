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

    members, evolved: {name: type name}; together: members that lie first, side by side. Everything lives in one field
    tree, which `close` gives back.
    """

    def __init__(self, n: int, dim: int, members: dict, evolved: dict, together: tuple = ()):
        self.n, self.dim = n, dim
        self.members = {**HOT, **{name: members[name] for name in together}, **members, **COLD}
        self.evolved, self.names = evolved, tuple(evolved)
        self.vectors = tuple(name for name, kind in self.members.items() if kind is vec3)
        self.scalars = tuple(name for name, kind in self.members.items() if kind in (real, integer))
        self.State, self.Rate = struct(self.members, dim), struct(evolved, dim)
        self.tree = ti.FieldsBuilder()
        self.state, self.spare = self.place(self.State, n + 1), self.place(self.State, n + 1)
        self.rate, self.old = self.place(self.Rate), self.place(self.Rate)
        self.layout, self.width = layout({name: kind for name, kind in self.members.items() if name != "id"}, dim)
        self.first = {name: first for name, _, first in self.layout}  # the column of a table where a member begins
        self.rate_layout, self.rate_width = layout(evolved, dim)
        self.word = np.float64 if ti.lang.impl.get_runtime().default_fp == ti.f64 else np.float32
        self.companions: list = []  # (field, spare) pairs that follow the state's order
        self.summed = 0  # columns of the rows that neighbour sums are left in (sums.py)

    def place(self, kind, size: int | None = None):
        """A field of a struct type, one record a particle unless a size is given, in this simulation's tree."""
        field = kind.field()
        self.tree.dense(ti.i, size or self.n).place(field)
        return field

    def finish(self) -> None:
        """Allocate: nothing can be placed afterwards, and no companion added."""
        self.followers = ((self.state, self.spare), *self.companions)
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
    def permute(self, order: ti.types.ndarray(dtype=ti.i32, ndim=1)):
        """field[n] <- field[order[n]] for the state and its companions."""
        for n in range(self.n):
            for field, spare in ti.static(self.followers):
                spare[n] = field[order[n]]
        for n in range(self.n):
            for field, spare in ti.static(self.followers):
                field[n] = spare[n]

    @ti.func
    def write_out(self, field: ti.template(), layout: ti.template(), n, out: ti.template()):
        """A record as a row of a table."""
        record = field[n]
        for name, kind, first in ti.static(layout):
            if ti.static(name in self.scalars):
                out[n, first] = ti.cast(record[name], float)
            else:
                for c in ti.static(range(kind)):
                    out[n, first + c] = record[name][c]

    @ti.func
    def read_in(self, field: ti.template(), layout: ti.template(), n, table: ti.template()):
        """The inverse of write_out."""
        for name, kind, first in ti.static(layout):
            if ti.static(name in self.scalars):
                field.get_member_field(name)[n] = ti.cast(table[n, first], field.get_member_field(name).dtype)
            else:
                for c in ti.static(range(kind)):
                    field.get_member_field(name)[n][c] = table[n, first + c]

    @ti.kernel
    def export(self, out: ti.types.ndarray(ndim=2), ids: ti.types.ndarray(dtype=ti.i32, ndim=1)):
        """Every member as columns of one table, in memory order: one kernel, however many members."""
        for n in range(self.n):
            ids[n] = self.state[n].id
            self.write_out(self.state, self.layout, n, out)

    @ti.kernel
    def admit(self, table: ti.types.ndarray(ndim=2), ids: ti.types.ndarray(dtype=ti.i32, ndim=1)):
        """The inverse of export."""
        for n in range(self.n):
            self.state[n].id = ids[n]
            self.read_in(self.state, self.layout, n, table)

    @ti.kernel
    def export_rates(self, out: ti.types.ndarray(ndim=2)):
        """Every rate as columns of one table, in memory order."""
        for n in range(self.n):
            self.write_out(self.rate, self.rate_layout, n, out)

    @ti.kernel
    def admit_table_of_rates(self, table: ti.types.ndarray(ndim=2)):
        """The inverse of export_rates."""
        for n in range(self.n):
            self.read_in(self.rate, self.rate_layout, n, table)

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
        return self.by_name(ordered, self.layout)

    def in_memory(self) -> dict[str, np.ndarray]:
        """All members by name, in memory order."""
        return self.by_name(self.table()[0], self.layout)

    def rates(self) -> dict[str, np.ndarray]:
        """Rates of the last evaluation, in memory order."""
        out = np.empty((self.n, self.rate_width), self.word)
        self.export_rates(out)
        return self.by_name(out, self.rate_layout)

    def admit_rates(self, rates: dict[str, np.ndarray]) -> None:
        """The inverse of rates."""
        self.admit_table_of_rates(np.column_stack([rates[name] for name, *_ in self.rate_layout]).astype(self.word))

    def by_name(self, table: np.ndarray, layout: list) -> dict[str, np.ndarray]:
        """Columns of a table, as views: shapes (n,) or (n, components)."""
        return {
            name: table[:, first] if name in self.scalars else table[:, first : first + kind]
            for name, kind, first in layout
        }


def layout(members: dict, dim: int) -> tuple[list, int]:
    """[(name, columns, first column)] of a table that holds these members, and its width."""
    made, width = [], 0
    for name, kind in members.items():
        made.append((name, components(kind, dim), width))
        width += components(kind, dim)
    return made, width
