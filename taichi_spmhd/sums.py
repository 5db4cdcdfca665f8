"""What a pair loop leaves behind: a row of sums a particle, which the kernel after it goes on with.

A kernel over lanes holds numbers and lanes only (wide.py); what a particle makes of its sums, with vectors and records
and whatever a term thinks of, is another kernel.
"""

from .runtime import ti
from .types import vec3
from .vector import struct_of, traced


def places(kinds: dict) -> dict[str, range]:
    """{name: columns} of a row that holds these sums one after the other."""
    out, first = {}, 0
    for name, kind in kinds.items():
        size = 3 if kind is vec3 else 1
        out[name] = range(first, first + size)
        first += size
    return out


def width(kinds: dict) -> int:
    """Columns of these sums."""
    return sum(map(len, places(kinds).values()))


@ti.data_oriented
class Sums:
    """`rows` (n, width): room for the largest of several sets of sums {name: type name}."""

    def __init__(self, particles, *sets: dict):
        particles.summed = max(map(width, sets))
        self.rows = ti.ndarray(float, (particles.n, particles.summed))

    @traced
    def keep(self, rows, n, lanes, totals, *more) -> None:
        """Write totals, summed over the lanes, and more numbers after them."""
        parts = [lanes.across(part) for parts in totals.parts.values() for part in parts]
        for column, value in enumerate((*parts, *more)):
            self.put(rows, n, column, value)

    @traced
    def found(self, rows, n, kinds: dict):
        """The sums that were kept, as a struct."""
        return struct_of({name: [self.entry(rows, n, k) for k in columns] for name, columns in places(kinds).items()})

    @ti.func
    def put(self, rows: ti.template(), n, column: ti.template(), value):
        rows[n, column] = value

    @ti.func
    def entry(self, rows: ti.template(), n, column: ti.template()):
        return rows[n, column]
