"""The padded neighbour list, one fixed-width row a particle, shared by every sum of a step and kept while it is valid.

Particle j is in the row of i if, at the build, r < pad * support * max(h_i, h_j); the support is the kernel's, or what
the pairs of the density's choice reach (`reach`). The list stays valid as long as

    support * h_i + d_i + max_j d_j <= pad * support * h0_i        for all i,

d the distance moved and h0 the smoothing length since the build: then no pair within either support can be missing.
While that is true of the inner ring, too (search.INNER for pad), only the beginning of each row is needed: `rows`.
A wide pad is kept for many steps but makes every sum longer; `pad` follows the flow so that a list serves two steps or
more. Rows end with index n (nobody, without mass) up to a whole number of vector lanes.
"""

import numpy as np

from .boundary import LOWER, UPPER
from .cures import GROWN, PASSED_WALL
from .errors import RunError
from .particles import Particles
from .runtime import ti
from .search import INNER, Search

PADS = (1.04, 1.2)  # list radius over support, at least and at most
SPARE = 1.06  # a step may use up so much more of a list than the last one did
STORY = ("builds", "age", "pad", "used")


@ti.data_oriented
class Neighbours(Search):
    """Builds the list and knows whether it still holds."""

    def __init__(self, particles: Particles, box, boundary, kernel, reach: float = 1.0):
        expected = kernel.neighbours * (reach * PADS[0]) ** particles.dim
        super().__init__(particles, box, boundary, reach * kernel.support, expected)
        self.kernel = kernel
        self.walls = [{image[a] for image in boundary.images} for a in range(3)]
        self.half = min((room for a in range(self.dim) if (room := boundary.room(a, box.size[a]))), default=1e30)
        self.builds, self.age, self.pad, self.used = 0, 0, PADS[0], 0.0  # age: evaluations with this list
        self.rows = self.count

    def build(self) -> None:
        """Note the positions, sort the particles into cells, write the rows."""
        self.follow()
        self.cells.bin(self.pad * self.support)
        self.fits()
        self.cells.sort()
        self.list(self.pad)
        self.builds, self.age, self.rows = self.builds + 1, 0, self.inner

    def fits(self) -> None:
        """Raises RunError when a pair would meet twice, once through the period or a wall: one image is summed."""
        for a in range(self.dim):
            low, high = self.cells.span[a], self.cells.span[3 + a]
            if (LOWER in self.walls[a] and low < self.lo[a]) or (UPPER in self.walls[a] and high > self.hi[a]):
                what = f"boundary: a particle has passed the reflecting wall along {'xyz'[a]}"
                raise RunError(what, PASSED_WALL, "add Viscosity()")
        reach = self.support * self.cells.widest
        if reach > self.half * (1 + 1e-6):
            what = f"density: a kernel support of radius {reach:.3g} has outgrown the box (room: {self.half:.3g})"
            raise RunError(what, GROWN, "raise nx, widen the box or take a smaller kernel")

    def story(self) -> dict:
        """What, beside x0 and h0, decides when the next list is built and how wide: part of the state of a run."""
        return {name: getattr(self, name) for name in STORY}

    def retell(self, story: dict) -> bool:
        """Go back to a story; returns whether the list is not the one it tells of, so that `rebuild` must follow."""
        other = self.builds != story["builds"]
        for name in STORY:
            setattr(self, name, story[name])
        return other

    def forget(self) -> None:
        """As before the first build."""
        self.builds, self.age, self.pad, self.used = 0, 0, PADS[0], 0.0

    def rebuild(self) -> None:
        """The list as it was when positions x0 were noted: for a state read from disk, already in memory order."""
        self.cells.bin(self.pad * self.support, fold=False)
        self.list(self.pad)
        self.rows = self.count

    @ti.kernel
    def slack(self, pad: float, ring: float) -> ti.types.vector(4, ti.f32):
        """min_i ( pad R h0_i - R h_i - d_i ) - max_j d_j, how much room is left; the same for the ring; the smallest
        and the largest h0.

        No room either when a support has outgrown half the box: the build that follows says so.
        """
        room, inner, moved = ti.cast(1e30, float), ti.cast(1e30, float), ti.cast(0.0, float)
        small, large, fits = ti.cast(1e30, float), ti.cast(0.0, float), ti.cast(1e30, float)
        for n in range(self.p.n):
            s = self.p.state[n]
            d = (s.x - s.x0).norm()
            ti.atomic_min(room, self.support * (pad * s.h0 - s.h) - d)
            ti.atomic_min(inner, self.support * (ring * s.h0 - s.h) - d)
            ti.atomic_max(moved, d)
            ti.atomic_min(small, s.h0)
            ti.atomic_max(large, s.h0)
            ti.atomic_min(fits, self.half * (1.0 + 1e-6) - self.support * s.h)
        room, inner = ti.min(room - moved, fits), ti.min(inner - moved, fits)
        return ti.Vector(
            [ti.cast(room, ti.f32), ti.cast(inner, ti.f32), ti.cast(small, ti.f32), ti.cast(large, ti.f32)]
        )

    def holds(self) -> bool:
        """Whether the list is complete for the present positions and smoothing lengths; rows: as much as is needed.

        used: by how much pad must at most exceed 1 for this, had the list been made with it.
        """
        room, inner, small, large = self.slack(self.pad, min(INNER, self.pad))
        self.rows = self.inner if inner >= 0.0 else self.count
        self.used = self.pad - 1.0 - room / (self.support * (large if room > 0.0 else small))
        return room >= 0.0

    def follow(self) -> None:
        """Choose the pad for the next list so that it is of use once more: by what a step used up of the last one."""
        step = SPARE * self.used / max(self.age, 1)
        self.pad = float(np.clip(1.0 + step, *PADS)) if self.builds else PADS[0]

    @property
    def bytes_each(self) -> int:
        """Bytes of the list a particle."""
        return 4 * (self.width + 2 + self.dim + 1 + 3)  # entries, how many, compact copies; cell, index and order
