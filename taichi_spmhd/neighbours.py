"""The padded neighbour list, one fixed-width row a particle, shared by every sum of a step and kept while it is valid.

Particle j is in the row of i if, at the build, r < PAD * support * max(h_i, h_j). The list stays valid as long as

    support * h_i + d_i + max_j d_j <= PAD * support * h0_i        for all i,

d the distance moved and h0 the smoothing length since the build: then no pair within either support can be missing.
Rows end with index n (nobody, without mass) up to a whole number of vector lanes.
"""

import numpy as np

from .boundary import LOWER
from .cells import Cells
from .particles import Particles
from .runtime import ti

PAD = 1.1  # list radius over support
BLOCK = 32  # candidates tested together
LANES = 8  # rows are filled up to a multiple of this
IMAGE = 26  # bits of an entry that hold the particle; above them, per axis, which wall it is mirrored at


def code_of(image: tuple[int, int, int]) -> int:
    """The walls of an image as the upper bits of a signed 32-bit entry."""
    code = sum(side << (IMAGE + 2 * a) for a, side in enumerate(image))
    return code - 2**32 if code >= 2**31 else code


@ti.data_oriented
class Neighbours:
    """Builds the list and knows whether it still holds."""

    def __init__(self, particles: Particles, box, boundary, kernel):
        self.p, self.dim, self.kernel, self.support = particles, particles.dim, kernel, kernel.support
        self.lo, self.hi, self.size, self.periodic = box.lo, box.hi, box.size, boundary.periodic
        self.images = tuple((image, code_of(image)) for image in boundary.images)
        self.cells = Cells(particles, box, boundary.periodic)
        n = particles.n
        self.width = LANES * int(np.ceil(1.6 * kernel.neighbours * PAD**self.dim / LANES))
        self.near, self.count = ti.ndarray(ti.i32, (n, self.width)), ti.ndarray(ti.i32, n)
        self.at = ti.ndarray(ti.f32, (self.dim + 1, n + BLOCK))  # compact copies of x0 and of the squared radius
        self.bit = ti.ndarray(ti.i32, BLOCK)
        self.bit.from_numpy((np.uint32(1) << np.arange(BLOCK, dtype=np.uint32)).view(np.int32))
        self.builds = 0
        self.roundoff = 4e-7 * max(box.size)  # of the compact copies

    @ti.kernel
    def compact(self, at: ti.types.ndarray(dtype=ti.f32, ndim=2)):
        for n in range(self.p.n):
            for a in ti.static(range(self.dim)):
                at[a, n] = ti.cast(self.p.state[n].x0[a] - self.lo[a], ti.f32)
            at[self.dim, n] = ti.cast((self.support * PAD * self.p.state[n].h0 + self.roundoff) ** 2, ti.f32)

    @ti.func
    def separation(self, here, other, a: ti.template()):
        """Distance along axis a to the nearest image."""
        d = here - other
        if ti.static(self.periodic[a]):
            half, full = ti.static(0.5 * self.size[a]), ti.static(self.size[a])
            d = ti.select(d > half, d - full, d)
            d = ti.select(d < -half, d + full, d)
        return d

    @ti.func
    def scan(self, n, first, end, here, image, found, near: ti.template(), at: ti.template(), bit: ti.template()):
        """Append those of the particles [first, end), at most BLOCK, that n may touch; returns the new count."""
        hit, mine = 0, at[self.dim, n]
        for b in range(BLOCK):
            r2 = ti.cast(0.0, ti.f32)
            for a in ti.static(range(self.dim)):
                d = self.separation(here[a], at[a, first + b], a)
                r2 += d * d
            hit += ti.select(r2 < ti.max(mine, at[self.dim, first + b]), bit[b], 0)
        if end - first < BLOCK:
            hit &= (1 << (end - first)) - 1
        while hit != 0:
            low = hit & (-hit)
            near[n, ti.min(found, near.shape[1] - 1)] = (first + 31 - ti.math.clz(low)) | image
            hit ^= low
            found += 1
        return found

    @ti.func
    def row(self, a: ti.template(), c, shape):
        """First cell and number of cells to look at along axis a; the first may be -1 where the axis is periodic."""
        low, high = ti.max(c - 1, 0), ti.min(c + 1, shape - 1)
        if ti.static(self.periodic[a]):
            if shape >= 3:
                low, high = c - 1, c + 1
        return ti.Vector([low, high - low + 1])

    @ti.func
    def strip(self, n, base, low, cells, here, image, found, first: ti.template(), near: ti.template(),
              at: ti.template(), bit: ti.template()):  # fmt: skip
        """Scan the particles of `cells` neighbouring cells of a row: they are contiguous in memory."""
        start, end = first[base + low], first[base + low + cells]
        while start < end:
            found = self.scan(n, start, end, here, image, found, near, at, bit)
            start += BLOCK
        return found

    @ti.func
    def around(self, n, here, c, image, found, shape: ti.template(), first: ti.template(), near: ti.template(),
               at: ti.template(), bit: ti.template()):  # fmt: skip
        """Scan the cells around cell c."""
        x, y, z = self.row(0, c[0], shape[0]), ti.Vector([0, 1]), ti.Vector([0, 1])
        if ti.static(self.dim > 1):
            y = self.row(1, c[1], shape[1])
        if ti.static(self.dim > 2):
            z = self.row(2, c[2], shape[2])
        for kz in range(z[1]):
            for ky in range(y[1]):
                cy, cz = y[0] + ky, z[0] + kz
                cy += ti.select(cy < 0, shape[1], ti.select(cy >= shape[1], -shape[1], 0))
                cz += ti.select(cz < 0, shape[2], ti.select(cz >= shape[2], -shape[2], 0))
                base = (cz * shape[1] + cy) * shape[0]
                low, end = ti.max(x[0], 0), ti.min(x[0] + x[1], shape[0])
                found = self.strip(n, base, low, end - low, here, image, found, first, near, at, bit)
                if x[0] < 0:
                    found = self.strip(n, base, shape[0] - 1, 1, here, image, found, first, near, at, bit)
                if x[0] + x[1] > shape[0]:
                    found = self.strip(n, base, 0, 1, here, image, found, first, near, at, bit)
        return found

    @ti.kernel
    def fill(self, near: ti.types.ndarray(dtype=ti.i32, ndim=2), count: ti.types.ndarray(dtype=ti.i32, ndim=1),
             first: ti.types.ndarray(dtype=ti.i32, ndim=1), at: ti.types.ndarray(dtype=ti.f32, ndim=2),
             bit: ti.types.ndarray(dtype=ti.i32, ndim=1), grid: ti.types.ndarray(ndim=2),
             shape: ti.types.ndarray(dtype=ti.i32, ndim=1)) -> ti.i32:  # fmt: skip
        """Write all rows; returns the largest count, which may exceed the width: then the rows are of no use."""
        most = 0
        for n in range(self.p.n):
            here = ti.Vector.zero(ti.f32, 3)
            for a in ti.static(range(self.dim)):
                here[a] = at[a, n]
            found = self.around(n, here, self.cells.cell(self.p.state[n].x0, grid, shape), 0, 0, shape, first, near, at, bit)
            for image, code in ti.static(self.images):
                found = self.mirrored(n, here, image, code, found, shape, first, near, at, bit, grid)
            rest = found
            while rest % LANES != 0 and rest < near.shape[1]:
                near[n, rest] = self.p.n
                rest += 1
            count[n] = rest
            ti.atomic_max(most, found)
        return most

    @ti.func
    def mirrored(self, n, here, image: ti.template(), code: ti.template(), found, shape: ti.template(),
                 first: ti.template(), near: ti.template(), at: ti.template(), bit: ti.template(),
                 grid: ti.template()):  # fmt: skip
        """Neighbours behind walls are those of the mirrored particle: the entry remembers the walls."""
        x, there = self.p.state[n].x0, here
        for a in ti.static(range(self.dim)):
            if ti.static(image[a] != 0):
                wall = self.lo[a] if ti.static(image[a] == LOWER) else self.hi[a]
                x[a] = 2.0 * wall - x[a]
                there[a] = ti.cast(x[a] - self.lo[a], ti.f32)
        return self.around(n, there, self.cells.cell(x, grid, shape), code, found, shape, first, near, at, bit)

    def list(self) -> None:
        """Rows for the noted positions in the present memory order; widened until no neighbour is dropped."""
        self.compact(self.at)
        grid, shape = self.cells.grid.astype(self.p.word), self.cells.shape
        most = self.fill(self.near, self.count, self.cells.first, self.at, self.bit, grid, shape)
        if most > self.width:
            self.width = LANES * int(np.ceil(1.25 * most / LANES))
            self.near = ti.ndarray(ti.i32, (self.p.n, self.width))
            self.fill(self.near, self.count, self.cells.first, self.at, self.bit, grid, shape)

    def build(self) -> None:
        """Note the positions, sort the particles into cells, write the rows."""
        self.cells.wrap()
        self.cells.bin(PAD * self.support)
        self.cells.sort()
        self.list()
        self.builds += 1

    def rebuild(self) -> None:
        """The list as it was when positions x0 were noted: for a state read from disk, already in memory order."""
        self.cells.bin(PAD * self.support)
        self.list()

    @ti.kernel
    def slack(self) -> ti.f32:
        """min_i ( PAD R h0_i - R h_i - d_i ) - max_j d_j: the list holds every neighbour while this is not negative."""
        room, moved = ti.cast(1e30, float), ti.cast(0.0, float)
        for n in range(self.p.n):
            s = self.p.state[n]
            d = (s.x - s.x0).norm()
            ti.atomic_min(room, self.support * (PAD * s.h0 - s.h) - d)
            ti.atomic_max(moved, d)
        return ti.cast(room - moved, ti.f32)

    def holds(self) -> bool:
        """Whether the list is complete for the present positions and smoothing lengths."""
        return self.slack() >= 0.0

    @property
    def bytes_each(self) -> int:
        """Bytes of the list a particle."""
        return 4 * (self.width + 1 + 1 + self.dim + 1)
