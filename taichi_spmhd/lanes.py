"""Several neighbours at once: the values a term's line of code works with inside the pair loop.

A term is written for one neighbour, `(i.v - j.v).dot(w.e)`. In the loop the names stand for LANES neighbours: a number
is a Taichi vector with one entry a neighbour, a vector is three of those (Vector3). With wide.py each operation is one
wide machine instruction, whatever the set of terms and whether or not the compiler recognises the loop or the
processor; a plain loop is at its mercy in both (docs/architecture.md). On devices that are parallel by themselves
there is one lane and everything is a plain number.
"""

from functools import partial

from . import runtime
from .errors import InputError
from .runtime import ti
from .types import components, real
from .vector import Record, Vector3, nothing, struct_of, traced

WIDEST = 8


def best() -> int:
    """Lanes for the device that runs: 8 on the CPU (a whole AVX register in f32, two in f64), else 1."""
    return WIDEST if runtime.started()["arch"] == "cpu" else 1


@ti.data_oriented
class Lanes:
    """Loads neighbours into lanes and sums lanes up again; `fields` {name: (field, type name)} can be loaded.

    A component of a vector is loaded from a field of its own, the same memory under another name (wide.py says why).
    """

    def __init__(self, width: int, fields: dict, dim: int):
        self.width, self.dim = width, dim
        sizes = {name: 0 if kind is real else components(kind, dim) for name, (_, kind) in fields.items()}
        self.fields = {name: columns(field, sizes[name]) for name, (field, _) in fields.items()}
        self.vectors = tuple(name for name, (_, kind) in fields.items() if kind is not real)

    @ti.func
    def column(self, field: ti.template(), index: ti.template()):
        return ti.Vector([field[index[k]] for k in ti.static(range(self.width))])

    @ti.func
    def single(self, field: ti.template(), index):
        return field[index]

    @traced
    def one(self, index, names):
        """The record of one particle, from its index, loaded at once."""
        record = Record(self.loads([index], names))
        record.need(names)
        return record

    @traced
    def many(self, index, names):
        """The record of `width` neighbours, from their indices (a list), each member loaded where it is first used."""
        return Record(self.loads(index, names))

    def loads(self, index: list, names) -> dict:
        """{name: function that loads it} for one particle or as many as there are lanes."""
        load, where = (self.column, index) if len(index) > 1 else (self.single, index[0])
        return {name: partial(self.member, load, name, where) for name in names}

    def member(self, load, name: str, index):
        """One member in variables: as bare expressions they would be loaded at every use."""
        parts = [ti.lang.impl.expr_init(load(field, index)) for field in self.fields[name]]
        return Vector3([*parts, 0.0, 0.0][:3]) if name in self.vectors else parts[0]

    @traced
    def totals(self, kinds: dict):
        """Sums that start at zero, in every lane."""
        return Totals({name: [self.start() for _ in range(components(kind, self.dim))] for name, kind in kinds.items()})

    @traced
    def start(self):
        """A new variable, 0 in every lane."""
        return ti.lang.impl.expr_init(self.zero())

    @ti.func
    def zero(self):
        if ti.static(self.width > 1):
            return ti.Vector([ti.cast(0.0, float) for _ in ti.static(range(self.width))])
        else:
            return ti.cast(0.0, float)

    @traced
    def summed(self, totals: "Totals"):
        """Totals over the lanes, as a plain struct."""
        sums = {name: [self.across(part) for part in parts] for name, parts in totals.parts.items()}
        return struct_of({name: row if len(row) > 1 else row[0] for name, row in sums.items()})

    @ti.func
    def slowest(self):
        """The start of a running maximum of positive numbers."""
        if ti.static(self.width > 1):
            return self.zero()
        else:
            return 0

    @ti.func
    def larger(self, most, value):
        """The larger of a running maximum and a value; without lanes as an integer, which the compiler vectorises."""
        if ti.static(self.width > 1):
            most = ti.max(most, value)
        else:
            most = ti.max(most, ti.bit_cast(ti.cast(value, ti.f32), ti.i32))
        return most

    @ti.func
    def speed(self, most):
        """The running maximum as a number. Returned from both sides: a variable that held an integer stays one."""
        if ti.static(self.width == 1):
            return ti.cast(ti.bit_cast(most, ti.f32), float)
        else:
            return most.max()

    @ti.func
    def across(self, part):
        """The sum over the lanes."""
        if ti.static(self.width > 1):
            return part.sum()
        else:
            return part


def columns(field, size: int) -> list:
    """The fields of a member's components; the field itself for a number (size 0)."""
    return [field.get_scalar_field(c) for c in range(size)] if size else [field]


class Totals:
    """Running sums over neighbours, by name."""

    _data_oriented = True

    def __init__(self, parts: dict):
        self.parts = parts

    @traced
    def add(self, part, source) -> None:
        """Add every key of the struct a hook of `source` returned; heat is dropped where no energy is evolved."""
        for name in part.keys:
            if name not in self.parts and name != "u":
                raise InputError(
                    f"{type(source).__name__} returns a rate for {name}, which nothing evolves: declare it in `evolves`"
                )
            values = part[name].parts if isinstance(part[name], Vector3) else [part[name]]
            for total, value in zip(self.parts.get(name, ()), values, strict=False):
                if not nothing(value):
                    total._augassign(value, "Add")
