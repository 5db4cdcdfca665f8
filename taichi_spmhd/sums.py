"""What a pair loop leaves behind: a row of sums a particle, which the kernel after it goes on with.

A kernel over lanes holds numbers and lanes only (wide.py); what a particle makes of its sums, with vectors and records
and whatever a term thinks of, is another kernel.
"""

from .runtime import ti
from .types import components, integer, real
from .vector import struct_of, traced


def places(kinds: dict, dim: int) -> dict[str, range]:
    """{name: columns} of a row that holds these sums one after the other."""
    out, first = {}, 0
    for name, kind in kinds.items():
        size = components(kind, dim)
        out[name] = range(first, first + size)
        first += size
    return out


def width(kinds: dict, dim: int) -> int:
    """Columns of these sums."""
    return sum(map(len, places(kinds, dim).values()))


@ti.data_oriented
class Sums:
    """`rows` (n, width): room for the largest of several sets of sums {name: type name}."""

    def __init__(self, particles, *sets: dict):
        self.dim = particles.dim
        particles.summed = max(width(kinds, self.dim) for kinds in sets)
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
        found = {name: [self.entry(rows, n, k) for k in at] for name, at in places(kinds, self.dim).items()}
        return struct_of({name: row[0] if kinds[name] in (real, integer) else row for name, row in found.items()})

    @ti.func
    def put(self, rows: ti.template(), n, column: ti.template(), value):
        rows[n, column] = value

    @ti.func
    def entry(self, rows: ti.template(), n, column: ti.template()):
        return rows[n, column]
