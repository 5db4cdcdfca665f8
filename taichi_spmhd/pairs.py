"""From list entries to the records of neighbours and the pair's geometry: periodic images, mirror images, lanes."""

from functools import partial

from .boundary import LOWER, UPPER
from .lanes import Lanes
from .runtime import ti
from .search import IMAGE
from .types import integer, real, slopes
from .vector import Record, Vector3, named, nothing, traced

TINY = 1e-30  # keeps r > 0 for the pair (i, i), whose unit vector is then zero


def slope_of(kind) -> int | None:
    """The axis of the component whose slope a member of this type is; None for a vector."""
    axes = [a for a, slope in enumerate(slopes.values()) if slope is kind]
    return axes[0] if axes else None


@ti.data_oriented
class Pairs:
    """What every loop over neighbours shares: `mine` and `theirs` are the records i and j of a term's line."""

    def __init__(self, particles, box, boundary, lanes: int):
        self.p, self.dim = particles, particles.dim
        self.lo, self.hi, self.size = box.lo, box.hi, box.size
        self.periodic = boundary.periodic
        self.mirrors = bool(boundary.images)
        kinds = {name: kind for name, kind in particles.members.items() if kind is not integer}
        fields = {name: (particles.state.get_member_field(name), kind) for name, kind in kinds.items()}
        self.vectors = {name: slope_of(kind) for name, kind in kinds.items() if kind is not real}
        self.lanes, self.names = Lanes(lanes, fields, self.dim), tuple(kinds)

    @ti.func
    def entries(self, near: ti.template(), n, block):
        """The list entries of one block of lanes."""
        return [near[n, block * self.lanes.width + k] for k in ti.static(range(self.lanes.width))]

    @ti.func
    def particle(self, entry):
        return entry & ((1 << IMAGE) - 1)

    @ti.func
    def side(self, entry, a: ti.template()):
        return (entry >> (IMAGE + 2 * a)) & 3

    @traced
    def mine(self, n, names=None):
        """Particle n as a record; names: the members that are looked at (default all)."""
        return self.lanes.one(n, names or self.names)

    @traced
    def theirs(self, near, n, block, names=None):
        """The neighbours of n in one block of its row, as one record."""
        entries = self.entries(near, n, block)
        if not self.mirrors:
            return self.lanes.many(entries, names or self.names)
        sides = [self.column([self.side(entry, a) for entry in entries]) for a in range(self.dim)]
        loads = self.lanes.loads([self.particle(entry) for entry in entries], names or self.names)
        for name in self.vectors:
            if name in loads:
                loads[name] = partial(self.mirrored, name, loads[name], sides)
        return Record(loads)

    def column(self, values):
        return ti.lang.impl.expr_init(ti.lang.matrix.make_matrix(values)) if self.lanes.width > 1 else values[0]

    def mirrored(self, name: str, load, sides: list):
        """A vector of neighbours, of their mirror images where they are behind walls; sides: which, axis by axis."""
        parts = list(load().parts)
        for a, side in enumerate(sides):
            sign = ti.select(side == 0, 1.0, -1.0)
            wall = ti.select(side == LOWER, 2.0 * self.lo[a], ti.select(side == UPPER, 2.0 * self.hi[a], 0.0))
            parts[a] = parts[a] * sign + (wall if name == "x" else 0.0)
            if self.vectors[name] == a:  # the slope of a component that changes its sign itself
                parts = [part if nothing(part) else part * sign for part in parts]
        return named(Vector3(parts))

    @traced
    def between(self, i, j):
        """x_i - x_j to the nearest image, always with three components."""
        return Vector3(self.nearest(i.x[a] - j.x[a], a) if a < self.dim else 0.0 for a in range(3))

    @ti.func
    def apart(self, x, y):
        """x - y to the nearest image, of two positions."""
        d = x - y
        for a in ti.static(range(self.dim)):
            d[a] = self.nearest(d[a], a)
        return d

    @ti.func
    def nearest(self, d, a: ti.template()):
        """A distance along axis a, to the nearest periodic image."""
        if ti.static(self.periodic[a]):
            half, full = ti.static(0.5 * self.size[a]), ti.static(self.size[a])
            if ti.static(self.lanes.width > 1):
                d = d - full * ti.floor(d * ti.static(1.0 / self.size[a]) + 0.5)
            else:
                d = ti.select(d > half, d - full, d)
                d = ti.select(d < -half, d + full, d)
        return d
