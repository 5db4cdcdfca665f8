"""Where everything in a frame lies: plain rectangles in pixels, from the top left corner."""

from dataclasses import dataclass
from math import ceil

from ..box import Box
from ..errors import InputError
from ..picture import Picture

LEFT, RIGHT = 74, 126  # axis labels; colour bar and its numbers
TITLE, LABEL, LINE = 58, 30, 17  # heights of the title, a panel's label, a line of small text
TICKS = 50  # tick labels and axis label below a panel
COUNT, HISTOGRAM, HISTOGRAM_TICKS = 30, 96, 46
GUTTER, BOTTOM = 38, 14
TALLEST, LEAST_HEIGHT = 0.82, 600  # of the width: frames fit a projector; but pixels enough for what is asked
SIDE_BY_SIDE = 0.75  # a row of panels may be this much smaller than a block of them and is still preferred
PROFILE_RATIO = 6.0  # boxes longer than this are strips: value against x says more than a ribbon of particles


@dataclass(frozen=True)
class Rect:
    """left, top, width, height in pixels."""

    left: int
    top: int
    width: int
    height: int

    @property
    def size(self) -> tuple[int, int]:
        return self.width, self.height

    @property
    def right(self) -> int:
        return self.left + self.width

    @property
    def bottom(self) -> int:
        return self.top + self.height


@dataclass(frozen=True)
class Layout:
    """The frame's size (both even, as films need it), a field rectangle per variant, histograms, the colour bar."""

    width: int
    height: int
    fields: tuple[Rect, ...]
    histograms: tuple[Rect, ...]
    bar: Rect | None
    columns: int


def is_profile(box: Box) -> bool:
    """Whether panels show value against x: in 1-D, and for long strips."""
    return box.dim == 1 or box.size[0] > PROFILE_RATIO * box.size[1]


def _shape(box: Box) -> tuple[float, float]:
    """Width and height of a field in the units of the box."""
    return (4.0, 3.0) if is_profile(box) else (box.size[0], box.size[1])


def _margins(picture: Picture, lines: int) -> tuple[int, int]:
    """Pixels above and below a field within its panel."""
    below = TICKS + (COUNT + HISTOGRAM + HISTOGRAM_TICKS if picture.gaps else 0)
    return LABEL + LINE * lines, below


def _scale(count, columns, box, picture, lines, footer) -> float:
    """Pixels per unit length of the box with this many columns of panels."""
    rows, (above, below) = ceil(count / columns), _margins(picture, lines)
    wide = (picture.width - LEFT - RIGHT - GUTTER * (columns - 1)) / columns
    high = (max(TALLEST * picture.width, LEAST_HEIGHT) - TITLE - BOTTOM - LINE * footer) / rows - above - below
    return min(wide / _shape(box)[0], high / _shape(box)[1])


def arrange(count: int, box: Box, picture: Picture, lines: int = 0, footer: int = 0) -> Layout:
    """The layout for `count` panels: as many side by side as go without making them much smaller.

    lines: lines of small text under each label; footer: lines of small text at the foot of the frame.
    Raises InputError where the panels would be too small to see.
    """
    scales = {n: _scale(count, n, box, picture, lines, footer) for n in range(1, count + 1)}
    columns = max(n for n in scales if scales[n] >= SIDE_BY_SIDE * max(scales.values()))
    scale = max(scales[columns], 0.0)
    wide, high = (round(scale * length) for length in _shape(box))
    if min(wide, high) < 24:
        raise InputError(f"Picture: {count} panels do not fit into width={picture.width}; give a larger width")
    (above, below), rows = _margins(picture, lines), ceil(count / columns)
    fields = [
        Rect(LEFT + n % columns * (wide + GUTTER), TITLE + n // columns * (above + high + below) + above, wide, high)
        for n in range(count)
    ]
    histograms = [Rect(f.left, f.bottom + TICKS + COUNT, wide, HISTOGRAM) for f in fields] if picture.gaps else []
    bar = None if is_profile(box) else Rect(fields[columns - 1].right + 22, fields[0].top, 18, high)
    right = fields[columns - 1].right + (RIGHT if bar else 30)
    bottom = TITLE + rows * (above + high + below) + LINE * footer + BOTTOM
    width = min(max(right, 480), picture.width)
    return Layout(width + width % 2, bottom + bottom % 2, tuple(fields), tuple(histograms), bar, columns)
