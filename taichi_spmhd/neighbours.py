"""The padded neighbour list, one fixed-width row a particle, shared by every sum of a step and kept while it is valid.

Particle j is in the row of i if, at the build, r < pad * support * max(h_i, h_j). The list stays valid as long as

    support * h_i + d_i + max_j d_j <= pad * support * h0_i        for all i,

d the distance moved and h0 the smoothing length since the build: then no pair within either support can be missing.
A wide pad is kept for many steps but makes every sum longer; `pad` follows the flow so that a list serves two steps or
more. Rows end with index n (nobody, without mass) up to a whole number of vector lanes.
"""

import numpy as np

from .boundary import LOWER
from .cells import Cells
from .errors import RunError
from .particles import Particles
from .runtime import ti

PADS = (1.04, 1.2)  # list radius over support, at least and at most
BLOCK = 32  # candidates tested together
LANES = 8  # rows are filled up to a multiple of this
STORY = ("builds", "age", "pad", "moved")
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
        self.half = 0.5 * min((box.size[a] for a in range(self.dim) if self.periodic[a]), default=1e30)
        self.images = tuple((image, code_of(image)) for image in boundary.images)
        self.cells = Cells(particles, box, boundary.periodic)
        n = particles.n
        self.width = LANES * int(np.ceil(1.6 * kernel.neighbours * PADS[0] ** self.dim / LANES))
        self.near, self.count = ti.ndarray(ti.i32, (n, self.width)), ti.ndarray(ti.i32, n)
        self.at = ti.ndarray(ti.f32, (self.dim + 1, n + BLOCK))  # compact copies of x0 and of the squared radius
        self.bit = ti.ndarray(ti.i32, BLOCK)
        self.bit.from_numpy((np.uint32(1) << np.arange(BLOCK, dtype=np.uint32)).view(np.int32))
        self.builds, self.age, self.pad, self.moved = 0, 0, PADS[0], 0.0  # age: evaluations since the build
        self.roundoff = 4e-7 * max(box.size)  # of the compact copies

    @ti.kernel
    def compact(self, at: ti.types.ndarray(dtype=ti.f32, ndim=2), pad: float):
        for n in range(self.p.n):
            for a in ti.static(range(self.dim)):
                at[a, n] = ti.cast(self.p.state[n].x0[a] - self.lo[a], ti.f32)
            at[self.dim, n] = ti.cast((self.support * pad * self.p.state[n].h0 + self.roundoff) ** 2, ti.f32)

    @ti.func
    def separation(self, here, other, a: ti.template(), narrow: ti.template()):
        """Distance along axis a; to the nearest image where the box is too narrow for the cells to tell which that is."""
        d = here - other
        if ti.static(narrow and self.periodic[a]):
            half, full = ti.static(0.5 * self.size[a]), ti.static(self.size[a])
            d = ti.select(d > half, d - full, d)
            d = ti.select(d < -half, d + full, d)
        return d

    @ti.func
    def scan(self, n, first, end, here, image, found, near: ti.template(), at: ti.template(), bit: ti.template(),
             narrow: ti.template()):  # fmt: skip
        """Append those of the particles [first, end), at most BLOCK, that n may touch; returns the new count."""
        hit, mine = 0, at[self.dim, n]
        for b in range(BLOCK):
            r2 = ti.cast(0.0, ti.f32)
            for a in ti.static(range(self.dim)):
                d = self.separation(here[a], at[a, first + b], a, narrow)
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
              at: ti.template(), bit: ti.template(), narrow: ti.template()):  # fmt: skip
        """Scan the particles of `cells` neighbouring cells of a row: they are contiguous in memory."""
        start, end = first[base + low], first[base + low + cells]
        while start < end:
            found = self.scan(n, start, end, here, image, found, near, at, bit, narrow)
            start += BLOCK
        return found

    @ti.func
    def shifted(self, here, a: ti.template(), c, shape, narrow: ti.template()):
        """`here` moved by a period where the row of cells c lies beyond the edge."""
        out = here
        if ti.static(self.periodic[a] and not narrow):
            out[a] += ti.cast(ti.select(c < 0, self.size[a], ti.select(c >= shape, -self.size[a], 0.0)), ti.f32)
        return out

    @ti.func
    def around(self, n, here, c, image, found, shape: ti.template(), first: ti.template(), near: ti.template(),
               at: ti.template(), bit: ti.template(), narrow: ti.template()):  # fmt: skip
        """Scan the cells around cell c, rows of them at a time."""
        x, y, z = self.row(0, c[0], shape[0]), ti.Vector([0, 1]), ti.Vector([0, 1])
        if ti.static(self.dim > 1):
            y = self.row(1, c[1], shape[1])
        if ti.static(self.dim > 2):
            z = self.row(2, c[2], shape[2])
        for kz in range(z[1]):
            for ky in range(y[1]):
                cy, cz, there = y[0] + ky, z[0] + kz, here
                if ti.static(self.dim > 1):
                    there = self.shifted(there, 1, cy, shape[1], narrow)
                if ti.static(self.dim > 2):
                    there = self.shifted(there, 2, cz, shape[2], narrow)
                cy += ti.select(cy < 0, shape[1], ti.select(cy >= shape[1], -shape[1], 0))
                cz += ti.select(cz < 0, shape[2], ti.select(cz >= shape[2], -shape[2], 0))
                base = (cz * shape[1] + cy) * shape[0]
                low, end = ti.max(x[0], 0), ti.min(x[0] + x[1], shape[0])
                found = self.strip(n, base, low, end - low, there, image, found, first, near, at, bit, narrow)
                if x[0] < 0:
                    edge = self.shifted(there, 0, -1, shape[0], narrow)
                    found = self.strip(n, base, shape[0] - 1, 1, edge, image, found, first, near, at, bit, narrow)
                if x[0] + x[1] > shape[0]:
                    edge = self.shifted(there, 0, shape[0], shape[0], narrow)
                    found = self.strip(n, base, 0, 1, edge, image, found, first, near, at, bit, narrow)
        return found

    @ti.kernel
    def fill(self, near: ti.types.ndarray(dtype=ti.i32, ndim=2), count: ti.types.ndarray(dtype=ti.i32, ndim=1),
             first: ti.types.ndarray(dtype=ti.i32, ndim=1), at: ti.types.ndarray(dtype=ti.f32, ndim=2),
             bit: ti.types.ndarray(dtype=ti.i32, ndim=1), grid: ti.types.ndarray(ndim=2),
             shape: ti.types.ndarray(dtype=ti.i32, ndim=1), narrow: ti.template()) -> ti.i32:  # fmt: skip
        """Write all rows; returns the largest count, which may exceed the width: then the rows are of no use."""
        most = 0
        for n in range(self.p.n):
            here = ti.Vector.zero(ti.f32, 3)
            for a in ti.static(range(self.dim)):
                here[a] = at[a, n]
            c = self.cells.cell(self.p.state[n].x0, grid, shape)
            found = self.around(n, here, c, 0, 0, shape, first, near, at, bit, narrow)
            for image, code in ti.static(self.images):
                found = self.mirrored(n, here, image, code, found, shape, first, near, at, bit, grid, narrow)
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
                 grid: ti.template(), narrow: ti.template()):  # fmt: skip
        """Neighbours behind walls are those of the mirrored particle: the entry remembers the walls."""
        x, there = self.p.state[n].x0, here
        for a in ti.static(range(self.dim)):
            if ti.static(image[a] != 0):
                wall = self.lo[a] if ti.static(image[a] == LOWER) else self.hi[a]
                x[a] = 2.0 * wall - x[a]
                there[a] = ti.cast(x[a] - self.lo[a], ti.f32)
        return self.around(n, there, self.cells.cell(x, grid, shape), code, found, shape, first, near, at, bit, narrow)

    def list(self) -> None:
        """Rows for the noted positions in the present memory order; widened until no neighbour is dropped."""
        self.compact(self.at, self.pad)
        grid, shape = self.cells.grid.astype(self.p.word), self.cells.shape
        narrow = any(shape[a] < 3 and self.periodic[a] for a in range(self.dim))
        most = self.fill(self.near, self.count, self.cells.first, self.at, self.bit, grid, shape, narrow)
        if most > self.width:
            self.width = LANES * int(np.ceil(1.25 * most / LANES))
            self.near = ti.ndarray(ti.i32, (self.p.n, self.width))
            self.fill(self.near, self.count, self.cells.first, self.at, self.bit, grid, shape, narrow)

    def build(self) -> None:
        """Note the positions, sort the particles into cells, write the rows."""
        self.follow()
        self.cells.wrap()
        self.cells.bin(self.pad * self.support)
        self.fits()
        self.cells.sort()
        self.list()
        self.builds, self.age = self.builds + 1, 0

    def fits(self) -> None:
        """Raises RunError when a pair would meet twice, once through the period: only the nearest image is summed."""
        reach = self.support * self.cells.widest
        if reach > self.half * (1 + 1e-6):
            raise RunError(
                f"density: a kernel support of radius {reach:.3g} has outgrown half the box ({self.half:.3g}); "
                "raise nx, widen the box or take a smaller kernel"
            )

    def story(self) -> dict:
        """What, beside x0 and h0, decides when the next list is built and how wide: it belongs to the state of a run."""
        return {name: getattr(self, name) for name in STORY}

    def retell(self, story: dict) -> bool:
        """Go back to a story; returns whether the list is not the one it tells of, so that `rebuild` must follow."""
        other = self.builds != story["builds"]
        for name in STORY:
            setattr(self, name, story[name])
        return other

    def rebuild(self) -> None:
        """The list as it was when positions x0 were noted: for a state read from disk, already in memory order."""
        self.cells.bin(self.pad * self.support)
        self.list()

    @ti.kernel
    def slack(self, pad: float) -> ti.types.vector(2, ti.f32):
        """min_i ( pad R h0_i - R h_i - d_i ) and max_j d_j / R h_j: how much room is left, and how far particles moved.

        No room either when a support has outgrown half the box: the build that follows says so.
        """
        room, moved, share = ti.cast(1e30, float), ti.cast(0.0, float), ti.cast(0.0, float)
        fits = ti.cast(1e30, float)
        for n in range(self.p.n):
            s = self.p.state[n]
            d = (s.x - s.x0).norm()
            ti.atomic_min(room, self.support * (pad * s.h0 - s.h) - d)
            ti.atomic_max(moved, d)
            ti.atomic_max(share, d * s.hinv)
            ti.atomic_min(fits, self.half * (1.0 + 1e-6) - self.support * s.h)
        return ti.Vector([ti.cast(ti.min(room - moved, fits), ti.f32), ti.cast(share / self.support, ti.f32)])

    def holds(self) -> bool:
        """Whether the list is complete for the present positions and smoothing lengths."""
        room, self.moved = self.slack(self.pad)
        return room >= 0.0

    def follow(self) -> None:
        """Choose the pad for the next list from how far the fastest particle came with the last one."""
        step = 2.0 * self.moved / max(self.age, 1)
        self.pad = float(np.clip(1.0 + 1.1 * step, *PADS)) if self.builds else PADS[0]

    @property
    def bytes_each(self) -> int:
        """Bytes of the list a particle."""
        return 4 * (self.width + 1 + 1 + self.dim + 1)
