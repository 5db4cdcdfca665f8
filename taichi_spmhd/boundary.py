"""What happens at the edges of the box, per axis and side: periodic, frozen ends, reflecting walls, or open."""

from dataclasses import dataclass
from itertools import product

from .errors import InputError

LOWER, UPPER = 1, 2  # which wall an image is mirrored at


@dataclass(frozen=True)
class Periodic:
    """What leaves on one side comes in on the other."""


@dataclass(frozen=True)
class Open:
    """Vacuum outside; the cells follow the particles."""


@dataclass(frozen=True)
class Frozen:
    """Particles that start within `width` of this end keep v, u and B/rho and move with their own constant v.

    They are ordinary neighbours otherwise. Give at least two supports, so that the edge is not felt inside.
    """

    width: float

    def __post_init__(self):
        if not self.width > 0:
            raise InputError(f"Frozen: width = {self.width} must be positive (two supports is usual)")


@dataclass(frozen=True)
class Reflecting:
    """A wall: neighbours behind it are mirror images with reversed normal components of v and B."""


KINDS = (Periodic, Open, Frozen, Reflecting)


@dataclass(frozen=True)
class Boundary:
    """One entry per axis: a single kind for both sides, or a pair (lower, upper). A missing axis is Open."""

    x: object = None
    y: object = None
    z: object = None

    def __post_init__(self):
        for name, sides in zip("xyz", self.sides, strict=True):
            if not all(isinstance(side, KINDS) for side in sides):
                kinds = ", ".join(kind.__name__ + "()" for kind in KINDS)
                raise InputError(f"Boundary: {name} = {getattr(self, name)!r}; give one of {kinds} or a pair of them")
            if sum(isinstance(side, Periodic) for side in sides) == 1:
                raise InputError(f"Boundary: {name} is periodic on one side only; give Periodic() for both")

    @property
    def sides(self) -> list[tuple]:
        """(lower, upper) of each of the three axes."""
        axes = [Open() if axis is None else axis for axis in (self.x, self.y, self.z)]
        return [tuple(axis) if isinstance(axis, (tuple, list)) else (axis, axis) for axis in axes]

    @property
    def periodic(self) -> tuple[bool, ...]:
        """Which axes have a period."""
        return tuple(isinstance(lower, Periodic) for lower, _ in self.sides)

    @property
    def images(self) -> list[tuple[int, ...]]:
        """Every combination of walls a particle can be mirrored at, as (axis 0, axis 1, axis 2) of 0, LOWER, UPPER."""
        walls = [
            [0, *(side for side, kind in ((LOWER, low), (UPPER, high)) if isinstance(kind, Reflecting))]
            for low, high in self.sides
        ]
        return [image for image in product(*walls) if any(image)]

    def room(self, axis: int, size: float) -> float:
        """The widest support an axis has room for: half of it if periodic, all of it between two walls; else 0."""
        walls = sum(isinstance(side, Reflecting) for side in self.sides[axis])
        return 0.5 * size if self.periodic[axis] else size if walls == 2 else 0.0

    @property
    def frozen(self) -> list[tuple[int, int, float]]:
        """(axis, LOWER or UPPER, width) of the frozen ends."""
        return [
            (axis, side, kind.width)
            for axis, kinds in enumerate(self.sides)
            for side, kind in zip((LOWER, UPPER), kinds, strict=True)
            if isinstance(kind, Frozen)
        ]


def everywhere() -> Boundary:
    """Periodic along every axis: the default."""
    return Boundary(Periodic(), Periodic(), Periodic())
