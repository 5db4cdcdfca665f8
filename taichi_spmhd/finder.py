"""Finding neighbours: every particle tests the particles of the cells around its own and writes a row of indices.

Cells of a row lie side by side in memory, so the candidates of three cells are one contiguous run: they are tested 32
at a time on compact single-precision copies into a bit mask, whose set bits are then written out.
"""

from .boundary import LOWER
from .runtime import ti

BLOCK = 32  # candidates tested together
LANES = 8  # rows are filled up to a multiple of this


@ti.data_oriented
class Finder:
    """The kernel that fills rows, for one box: it knows arrays only and is compiled once for all scenes in that box.

    images: ((walls of axes 0, 1, 2), their code), for every combination of walls a particle can be mirrored at.
    """

    def __init__(self, box, periodic: tuple, images: tuple):
        self.dim, self.lo, self.hi, self.size = box.dim, box.lo, box.hi, box.size
        self.periodic, self.images = periodic, images

    @ti.func
    def separation(self, here, other, a: ti.template(), narrow: ti.template()):
        """Distance along axis a; to the nearest image where the box is too narrow for the cells to tell which."""
        d = here - other
        if ti.static(narrow and self.periodic[a]):
            half, full = ti.static(0.5 * self.size[a]), ti.static(self.size[a])
            d = ti.select(d > half, d - full, d)
            d = ti.select(d < -half, d + full, d)
        return d

    @ti.func
    def scan(self, n, first, end, here, image, found, near: ti.template(), at: ti.template(), bit: ti.template(),
             share, narrow: ti.template()):  # fmt: skip
        """Append those of the particles [first, end), at most BLOCK, that n may touch: the inner ones from the left of
        the row, the others from its right; returns the new counts of both.
        """
        hit, inside, mine = 0, 0, at[self.dim, n]
        for b in range(BLOCK):
            r2 = ti.cast(0.0, ti.f32)
            for a in ti.static(range(self.dim)):
                d = self.separation(here[a], at[a, first + b], a, narrow)
                r2 += d * d
            reach = ti.max(mine, at[self.dim, first + b])
            hit += ti.select(r2 < reach, bit[b], 0)
            inside += ti.select(r2 < share * reach, bit[b], 0)
        if end - first < BLOCK:
            hit &= (1 << (end - first)) - 1
        last = near.shape[1] - 1
        while hit != 0:
            low = hit & (-hit)
            ring = ti.cast((inside & low) != 0, ti.i32)
            place = ti.select(ring == 1, ti.min(found[0], last), ti.max(last - found[1], 0))
            near[n, place] = (first + 31 - ti.math.clz(low)) | image
            hit ^= low
            found[0] += ring
            found[1] += 1 - ring
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
              at: ti.template(), bit: ti.template(), share, narrow: ti.template()):  # fmt: skip
        """Scan the particles of `cells` neighbouring cells of a row: they are contiguous in memory."""
        start, end = first[base + low], first[base + low + cells]
        while start < end:
            found = self.scan(n, start, end, here, image, found, near, at, bit, share, narrow)
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
               at: ti.template(), bit: ti.template(), share, narrow: ti.template()):  # fmt: skip
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
                found = self.strip(n, base, low, end - low, there, image, found, first, near, at, bit, share, narrow)
                if x[0] < 0:
                    edge = self.shifted(there, 0, -1, shape[0], narrow)
                    found = self.strip(
                        n, base, shape[0] - 1, 1, edge, image, found, first, near, at, bit, share, narrow
                    )
                if x[0] + x[1] > shape[0]:
                    edge = self.shifted(there, 0, shape[0], shape[0], narrow)
                    found = self.strip(n, base, 0, 1, edge, image, found, first, near, at, bit, share, narrow)
        return found

    @ti.kernel
    def fill(self, near: ti.types.ndarray(dtype=ti.i32, ndim=2), count: ti.types.ndarray(dtype=ti.i32, ndim=1),
             inner: ti.types.ndarray(dtype=ti.i32, ndim=1), first: ti.types.ndarray(dtype=ti.i32, ndim=1),
             at: ti.types.ndarray(dtype=ti.f32, ndim=2), bit: ti.types.ndarray(dtype=ti.i32, ndim=1), share: ti.f32,
             cell_of: ti.types.ndarray(dtype=ti.i32, ndim=1), grid: ti.types.ndarray(ndim=2),
             shape: ti.types.ndarray(dtype=ti.i32, ndim=1),
             narrow: ti.template()) -> ti.types.vector(2, ti.i32):  # fmt: skip
        """Write all rows; returns the largest and the smallest count, the particle itself included.

        The largest may exceed the width: then the rows are of no use.

        share: of a squared radius, that of the inner ring.
        """
        most, fewest = 0, count.shape[0]
        for n in range(count.shape[0]):
            here = ti.Vector.zero(ti.f32, 3)
            for a in ti.static(range(self.dim)):
                here[a] = at[a, n]
            row = cell_of[n] // shape[0]
            c = ti.Vector([cell_of[n] - row * shape[0], row % shape[1], row // shape[1]])
            found = self.around(n, here, c, 0, ti.Vector([0, 0]), shape, first, near, at, bit, share, narrow)
            for image, code in ti.static(self.images):
                found = self.mirrored(n, here, image, code, found, shape, first, near, at, bit, share, grid, narrow)
            count[n] = self.close_up(n, found, near, count.shape[0])
            inner[n] = ti.min(count[n], (found[0] + LANES - 1) // LANES * LANES)
            ti.atomic_max(most, found[0] + found[1])
            ti.atomic_min(fewest, found[0] + found[1])
        return ti.Vector([most, fewest])

    @ti.func
    def close_up(self, n, found, near: ti.template(), nobody):
        """Move the outer entries beside the inner ones and fill up with nobody; returns the length of the row."""
        width, rest = near.shape[1], found[0] + found[1]
        if rest <= width:
            for k in range(found[1]):
                near[n, found[0] + k] = near[n, width - found[1] + k]
        while rest % LANES != 0 and rest < width:
            near[n, rest] = nobody
            rest += 1
        return rest

    @ti.func
    def mirrored(self, n, here, image: ti.template(), code: ti.template(), found, shape: ti.template(),
                 first: ti.template(), near: ti.template(), at: ti.template(), bit: ti.template(),
                 share, grid: ti.template(), narrow: ti.template()):  # fmt: skip
        """Neighbours behind walls are those of the mirrored particle: the entry remembers the walls."""
        there, c = here, ti.Vector.zero(ti.i32, 3)
        for a in ti.static(range(self.dim)):
            if ti.static(image[a] != 0):
                wall = self.lo[a] if ti.static(image[a] == LOWER) else self.hi[a]
                there[a] = ti.cast(2.0 * (wall - grid[0, a]), ti.f32) - here[a]
            c[a] = ti.min(ti.max(ti.cast(ti.floor(there[a] * ti.cast(grid[1, a], ti.f32)), ti.i32), 0), shape[a] - 1)
        return self.around(n, there, c, code, found, shape, first, near, at, bit, share, narrow)
