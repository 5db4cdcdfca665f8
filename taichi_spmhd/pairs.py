"""From a list entry to a neighbour's record and the pair's geometry: periodic images, mirror images."""

from .boundary import LOWER, UPPER
from .neighbours import IMAGE
from .runtime import ti

TINY = 1e-30  # keeps r > 0 for the pair (i, i), whose unit vector is then zero


@ti.data_oriented
class Pairs:
    """What every loop over neighbours shares."""

    def __init__(self, particles, box, boundary):
        self.p, self.dim = particles, particles.dim
        self.lo, self.hi, self.size = box.lo, box.hi, box.size
        self.periodic = boundary.periodic
        self.walls = tuple(
            tuple(any(image[a] == side for image in boundary.images) for side in (LOWER, UPPER)) for a in range(3)
        )
        self.mirrors = bool(boundary.images)
        self.vectors = particles.vectors

    @ti.func
    def record(self, entry):
        """The neighbour an entry of the list stands for."""
        j = self.p.state[entry & ((1 << IMAGE) - 1) if ti.static(self.mirrors) else entry]
        if ti.static(self.mirrors):
            for a in ti.static(range(self.dim)):
                side = (entry >> (IMAGE + 2 * a)) & 3
                wall = ti.select(side == LOWER, self.lo[a], self.hi[a])
                j.x[a] = ti.select(side == 0, j.x[a], 2.0 * wall - j.x[a])
                sign = ti.select(side == 0, 1.0, -1.0)
                for name in ti.static(self.vectors):
                    j[name][a] *= sign
        return j

    @ti.func
    def between(self, i, j):
        """x_i - x_j to the nearest image, always with three components."""
        d = ti.Vector.zero(float, 3)
        for a in ti.static(range(self.dim)):
            d[a] = i.x[a] - j.x[a]
            if ti.static(self.periodic[a]):
                half, full = ti.static(0.5 * self.size[a]), ti.static(self.size[a])
                d[a] = ti.select(d[a] > half, d[a] - full, d[a])
                d[a] = ti.select(d[a] < -half, d[a] + full, d[a])
        return d
