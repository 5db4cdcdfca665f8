"""Picture: what a scene's frames show. Frozen settings, checked at the door; drawing is in render/."""

import re
from dataclasses import dataclass
from difflib import get_close_matches
from math import isfinite
from numbers import Real

from .errors import InputError

DRAW = ("particles", "nearest", "sph")
VECTORS = ("x", "v", "B", "b")
PSEUDO = {  # what is worked out for pictures alone: symbol, tex, colour map
    "div_B": ("h|div B|/|B|", r"$h\,|\nabla\cdot B|\,/\,|B|$", "inferno"),
    "gap": ("gap / spacing", "nearest neighbour, in spacings", "plasma_r"),
}
GREEK = ("rho", "psi", "xi", "alpha", "eta", "Omega", "phi", "gamma", "beta")
AXES = "xyz"


def suggestion(name: str, known) -> str:
    """The question "did you mean 'sph'?" for the known name nearest to `name`, or nothing."""
    near = get_close_matches(str(name), list(known), n=1, cutoff=0.5)
    return f" (did you mean {near[0]!r}?)" if near else ""


@dataclass(frozen=True)
class Picture:
    """What to draw of every particle, and how.

    member: a particle member ("rho", "B", "P", "v", ...), or "div_B", which is h |div B| / |B|, or "gap", the distance
            to the nearest neighbour in spacings (m/rho)^(1/d).
    axis:   0, 1, 2 for one component of a vector; None for its magnitude.
    limits: (lo, hi) of the colours; None takes them from the first frame and keeps them, so that a film never flickers.
    draw:   "particles" (discs; what a tensile scene needs, smoothing hides the clumps), "nearest" (each pixel has the
            value of its nearest particle) or "sph" (normalised interpolation with the particles' own h).
    colours: a matplotlib colour map; None: RdBu_r for limits symmetric about 0, inferno for div_B, plasma_r for gap
            (clumps glow), else viridis.
    log:    logarithmic colours.
    gaps:   True adds the histogram of nearest-neighbour distances and "n % closer than half a spacing".
    width:  largest width of a frame in pixels; the height follows from the box.

    Raises InputError for whatever cannot be drawn.
    """

    member: str = "rho"
    axis: int | None = None
    limits: tuple[float, float] | None = None
    draw: str = "particles"
    colours: str | None = None
    log: bool = False
    gaps: bool | None = None
    width: int = 1200

    def __post_init__(self):
        self._check_member()
        self._check_limits()
        if self.draw not in DRAW:
            raise InputError(f"Picture: unknown draw={self.draw!r}{suggestion(self.draw, DRAW)}; use {', '.join(DRAW)}")
        if isinstance(self.width, bool) or not isinstance(self.width, int) or not 240 <= self.width <= 8000:
            raise InputError(f"Picture: width={self.width!r} must be a whole number of pixels from 240 to 8000")
        if self.colours is not None:
            self._check_colours()

    def _check_member(self):
        if not isinstance(self.member, str):
            raise InputError(f'Picture: member={self.member!r} must be a name such as "rho" or "B"')
        component = re.fullmatch(r"([vBbx])_?([xyz])", self.member)
        if component:
            vector, axis = component.groups()
            cure = f'Picture("{vector}", axis={AXES.index(axis)})'
            raise InputError(f"Picture: {self.member!r} is a component; write {cure}")
        if not self.member.isidentifier():
            known = ("rho", "div_B", "gap", "B", "P", "v", "u", "h", "psi")
            raise InputError(f"Picture: {self.member!r} is not the name of a member{suggestion(self.member, known)}")
        if self.axis is not None and (isinstance(self.axis, bool) or self.axis not in (0, 1, 2)):
            raise InputError(f"Picture: axis={self.axis!r} must be 0, 1 or 2, or None for the magnitude")

    def _check_limits(self):
        if self.limits is None:
            return
        pair = tuple(self.limits) if isinstance(self.limits, (tuple, list)) else ()
        if len(pair) != 2 or not all(isinstance(number, Real) and isfinite(number) for number in pair):
            raise InputError(f"Picture: limits={self.limits!r} must be two numbers (lowest, highest)")
        if not pair[0] < pair[1]:
            raise InputError(f"Picture: limits={self.limits!r} must rise: write ({pair[1]}, {pair[0]})")
        if self.log and pair[0] <= 0:
            raise InputError(f"Picture: limits={self.limits!r} must be positive with log=True")
        object.__setattr__(self, "limits", (float(pair[0]), float(pair[1])))

    def _check_colours(self):
        # matplotlib takes a third of a second to load; only scenes that name a map pay for it here
        from matplotlib import colormaps

        if self.colours not in colormaps:
            near = suggestion(self.colours, colormaps)
            raise InputError(f"Picture: no colour map {self.colours!r}{near}; viridis, RdBu_r and inferno are usual")

    @property
    def symbol(self) -> str:
        """Plain text for captions: B_z, |v|, rho, h|div B|/|B|."""
        if self.member in PSEUDO:
            return PSEUDO[self.member][0]
        if self.axis is not None:
            return f"{self.member}_{AXES[self.axis]}"
        return f"|{self.member}|" if self.member in VECTORS else self.member

    @property
    def tex(self) -> str:
        """The same as matplotlib's mathtext, for axes and colour bars."""
        if self.member in PSEUDO:
            return PSEUDO[self.member][1]
        name, _, index = self.member.partition("_")
        letter = f"\\{name}" if name in GREEK else name
        if index:
            letter += f"_{{{index}}}"
        if self.axis is not None:
            return f"${{{letter}}}_{AXES[self.axis]}$"
        return f"$|{letter}|$" if self.member in VECTORS else f"${letter}$"

    def colour_map(self, limits: tuple[float, float]) -> str:
        """The colour map for these limits."""
        if self.colours is not None:
            return self.colours
        if self.member in PSEUDO:
            return PSEUDO[self.member][2]
        lo, hi = limits
        return "RdBu_r" if abs(lo + hi) <= 1e-6 * (hi - lo) else "viridis"
