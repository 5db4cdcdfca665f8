"""Several neighbours at once: the values a term's line of code works with inside the pair loop.

A term is written for one neighbour, `(i.v - j.v).dot(w.e)`. In the loop the names stand for LANES neighbours: a number
is a Taichi vector with one entry a neighbour, a vector is three of those (Vector3). The compiler turns each into one
wide machine instruction, whatever the set of terms and whether or not it recognises the loop or the processor:
what the compiler makes of a plain loop in f64 depends on the set of terms and on whether it knows the processor; with
lanes the rates kernel is up to 2.2 times faster and never slower than 5 % (docs/architecture.md). In f32, and on
devices that are parallel by themselves, there is one lane and everything is a plain number.
"""

from . import runtime
from .errors import InputError
from .runtime import ti
from .types import real, vec3, vecd
from .vector import Record, Vector3, nothing, traced

WIDEST = 8


def best() -> int:
    """Lanes for the device and precision that run: 8 in f64 on the CPU, else 1.

    In f32 the compiler vectorises the plain loop as well as lanes do or better; in f64 often not at all.
    """
    running = runtime.started()
    return WIDEST if running["arch"] == "cpu" and running["precision"] == "f64" else 1


@ti.data_oriented
class Lanes:
    """Loads neighbours into lanes and sums lanes up again; `fields` {name: (field, type name)} can be loaded."""

    def __init__(self, width: int, fields: dict, dim: int):
        self.width, self.dim = width, dim
        self.fields = {name: (field, {vec3: 3, vecd: dim, real: 0}[kind]) for name, (field, kind) in fields.items()}

    @ti.func
    def column(self, field: ti.template(), index: ti.template()):
        return ti.Vector([field[index[k]] for k in ti.static(range(self.width))])

    @ti.func
    def component(self, field: ti.template(), index: ti.template(), c: ti.template()):
        return ti.Vector([field[index[k]][c] for k in ti.static(range(self.width))])

    @ti.func
    def single(self, field: ti.template(), index):
        return field[index]

    @ti.func
    def single_component(self, field: ti.template(), index, c: ti.template()):
        return field[index][c]

    @traced
    def one(self, index, names):
        """The record of one particle, from its index."""
        out = {}
        for name in names:
            field, size = self.fields[name]
            parts = [self.single_component(field, index, c) for c in range(size)]
            out[name] = Vector3([*parts, 0.0, 0.0][:3]) if size else self.single(field, index)
        return Record(out)

    @traced
    def many(self, index, names):
        """The record of `width` neighbours, from their indices (a list)."""
        if self.width == 1:
            return self.one(index[0], names)
        out = {}
        for name in names:
            field, size = self.fields[name]
            parts = [self.component(field, index, c) for c in range(size)]
            out[name] = Vector3([*parts, 0.0, 0.0][:3]) if size else self.column(field, index)
        return Record(out)

    @traced
    def totals(self, kinds: dict):
        """Sums that start at zero, one number per lane."""
        return Totals(
            self.across, {name: [self.start() for _ in range(3 if kind is vec3 else 1)] for name, kind in kinds.items()}
        )

    @traced
    def start(self):
        """A new variable, 0 in every lane."""
        return ti.lang.impl.expr_init(ti.cast(0.0, float))

    @traced
    def summed(self, totals: "Totals"):
        """Totals over the lanes, as a plain struct."""
        rows = {name: list(parts) for name, parts in totals.parts.items()}
        return ti.Struct(
            {name: ti.lang.matrix.make_matrix(row) if len(row) == 3 else row[0] for name, row in rows.items()}
        )

    @ti.func
    def slowest(self):
        """The start of a running maximum of positive numbers."""
        return ti.cast(0.0, float) if ti.static(self.width > 1) else 0

    @ti.func
    def larger(self, most, value):
        """The larger of a running maximum and a value; without lanes as an integer, which the compiler vectorises."""
        if ti.static(self.width > 1):
            most = ti.max(most, value.max())
        else:
            most = ti.max(most, ti.bit_cast(ti.cast(value, ti.f32), ti.i32))
        return most

    @ti.func
    def speed(self, most):
        """The running maximum as a number. Returned from both sides: a variable that held an integer stays one."""
        if ti.static(self.width == 1):
            return ti.cast(ti.bit_cast(most, ti.f32), float)
        else:
            return most

    @ti.func
    def across(self, part):
        return part.sum()


class Totals:
    """Running sums over neighbours, by name."""

    _data_oriented = True

    def __init__(self, across, parts: dict):
        self.across, self.parts = across, parts

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
                    total._augassign(self.across(value) if getattr(value, "is_tensor", bool)() else value, "Add")
