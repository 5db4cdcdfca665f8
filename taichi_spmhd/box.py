"""The simulated region: one interval per axis, in the literature's coordinates."""

from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Real

from .errors import InputError


@dataclass(frozen=True)
class Box:
    """An axis-parallel region, lo[a] <= x[a] < hi[a], in 1, 2 or 3 dimensions."""

    lo: tuple[float, ...]
    hi: tuple[float, ...]

    @property
    def dim(self) -> int:
        return len(self.lo)

    @property
    def size(self) -> tuple[float, ...]:
        return tuple(hi - lo for lo, hi in zip(self.lo, self.hi, strict=True))

    @property
    def volume(self) -> float:
        """Length, area or volume."""
        volume = 1.0
        for length in self.size:
            volume *= length
        return volume


def as_box(spec: "Box | Sequence") -> Box:
    """A Box from lengths `(1.0, 2.0)` (lower corner 0) or from intervals `((-0.5, 0.5), (0, 1))`.

    Raises InputError for anything that is not one to three positive lengths.
    """
    if isinstance(spec, Box):
        return spec
    if not isinstance(spec, Sequence) and not hasattr(spec, "__len__"):
        raise InputError(f"box {spec!r}: give a length or (lower, upper) per axis, for example (1.0, 2.0)")
    axes = [(0.0, axis) if isinstance(axis, Real) else tuple(axis) for axis in spec]
    if not 1 <= len(axes) <= 3 or any(len(axis) != 2 or not axis[1] > axis[0] for axis in axes):
        raise InputError(f"box {spec!r}: give 1 to 3 positive lengths or (lower, upper) intervals")
    return Box(tuple(float(lo) for lo, _ in axes), tuple(float(hi) for _, hi in axes))
