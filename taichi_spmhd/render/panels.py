"""Panels: one frame with all variants side by side. Background once, then only what changes."""

from math import isclose

import numpy as np
from PIL import Image, ImageDraw

from ..box import Box
from ..errors import InputError
from ..picture import Picture
from . import text
from .background import background
from .colours import BACKGROUND, BROKEN, auto_limits, palette
from .layout import LINE, TICKS, TITLE, arrange, is_profile
from .pixels import draw, draw_curve, draw_profile

TITLE_SIZE, LABEL_SIZE, SMALL_SIZE, COUNT_SIZE = 20, 17, 12, 15
MOST_LINES = 3  # of small text
DOT, CURVE = (255, 196, 77), (120, 190, 255)  # dots of 1-D plots, and the line of the exact solution


class Panels:
    """Frames of a film. variants: labels, one panel each; box: the region shown; picture: what is drawn.

    title: at the top of every frame; terms: {label: (term, ...)} in words: those that all variants share stand once at
    the foot of the frame, the others under their label; periodic: one bool per axis (images across the edges).
    Limits missing in the picture are taken from the first frame.
    """

    def __init__(
        self, variants, box: Box, picture: Picture, title: str = "", terms=None, periodic=(False, False, False)
    ):
        self.variants, self.box, self.picture, self.title = list(variants), box, picture, title
        if not self.variants:
            raise InputError("a picture needs at least one variant")
        self.periodic = tuple(periodic)
        self.limits = picture.limits
        self._terms = {label: [str(term) for term in (terms or {}).get(label, ())] for label in self.variants}
        self._background: Image.Image | None = None
        self._arrange()

    def _arrange(self):
        """Lay out twice: how many lines the small text takes depends on the width of the panels."""
        first = self._terms[self.variants[0]]
        shared = [term for term in first if all(term in self._terms[label] for label in self.variants)]
        alone = len(self.variants) == 1
        own = {label: [] if alone else [t for t in self._terms[label] if t not in shared] for label in self.variants}
        count = len(self.variants)
        footer = 2 if shared else 0
        trial = arrange(count, self.box, self.picture, MOST_LINES if any(own.values()) else 0, footer)
        wide = trial.fields[0].width
        words = ["everywhere: " + shared[0] if not alone else shared[0], *shared[1:]] if shared else []
        self._shared = text.wrap(words, " + ", trial.width - 40, SMALL_SIZE, 2)
        self._own = {n: text.wrap(["+ " + t for t in own[n]], "  ", wide, SMALL_SIZE, MOST_LINES) for n in own}
        lines = max(len(small) for small in self._own.values())
        self.layout = arrange(count, self.box, self.picture, lines, len(self._shared))
        self._lines = lines

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of a frame in pixels, both even."""
        return self.layout.width, self.layout.height

    def palette(self) -> np.ndarray:
        """The colours (n, 3) uint8 that matter in these frames, for the one fixed palette of a GIF."""
        colours = palette(self.picture.colour_map(self.limits or (0.0, 1.0))).astype(float)
        dark = np.array(BACKGROUND, float)
        shades = [colours[3::5]]
        if self.picture.draw == "particles" and not is_profile(self.box):
            rim = colours[5::11] * 0.62
            shades += [rim, 0.45 * colours[5::11] + 0.55 * dark]
        greys = np.linspace(0, 255, 24)[:, None].repeat(3, axis=1)
        fixed = np.array([BACKGROUND, BROKEN, text.CLOSE, text.FAR, text.INK, DOT], float)
        return np.rint(np.concatenate([fixed, greys, *shades])).astype(np.uint8)

    def _open(self, columns: dict):
        """Fix the limits and draw the background with all text that stays."""
        if self.limits is None:
            values = np.concatenate([np.ravel(columns[label]["values"]) for label in self.variants])
            lo, hi = auto_limits(values, self.picture.log)
            pad = 0.06 * (hi - lo) if is_profile(self.box) and not self.picture.log else 0.0
            self.limits = (lo - pad, hi + pad)
        frame = Image.fromarray(background(self.layout, self.box, self.picture, self.limits))
        pen = ImageDraw.Draw(frame)
        wide, high = self.size
        text.write(pen, 20, 36, text.fit(self.title, wide - 190, TITLE_SIZE, True), TITLE_SIZE, bold=True)
        for n, line in enumerate(reversed(self._shared)):
            text.write(pen, 20, high - 14 - n * LINE, line, SMALL_SIZE, colour=text.GREY)
        for label, field in zip(self.variants, self.layout.fields, strict=True):
            self._label(pen, label, field)
        self._background = frame

    def _label(self, pen, label: str, field):
        """A panel's name and the terms that only it has."""
        base = field.top - 9 - LINE * self._lines
        name = text.fit(label, field.width, LABEL_SIZE, True)
        text.write(pen, field.left + field.width / 2, base, name, LABEL_SIZE, "ms", bold=True)
        for n, line in enumerate(self._own[label]):
            middle = field.left + field.width / 2
            text.write(pen, middle, base + LINE * (n + 1), line, SMALL_SIZE, "ms", text.GREY)

    def _field(self, column: dict, size) -> np.ndarray:
        """The image of one panel."""
        x, picture = np.asarray(column["x"]), self.picture
        if is_profile(self.box):
            dots = draw_profile(self.box, x, column["values"], size, self.limits, DOT, picture.log)
            return draw_curve(dots, self.box, column.get("exact"), self.limits, CURVE, picture.log)
        colours = palette(picture.colour_map(self.limits))
        return draw(
            picture.draw, self.box, x, column["values"], column["h"], size, colours, self.limits,
            spacing=column["spacing"], periodic=self.periodic, log=picture.log,
        )  # fmt: skip

    def frame(self, time: float, columns: dict) -> np.ndarray:
        """One frame (H, W, 3) uint8 at this time.

        columns: {label: {"x": (N, d), "values": (N,), "h": (N,), "spacing": (N,), "gaps": (N,) in spacings}}; gaps only
        where the picture shows them. Raises InputError when a variant is missing.
        """
        missing = [label for label in self.variants if label not in columns]
        if missing:
            raise InputError(f"no particles for panel {missing[0]!r}; there are {', '.join(map(repr, columns))}")
        if self._background is None:
            self._open(columns)
        frame = self._background.copy()
        pen = ImageDraw.Draw(frame)
        for n, label in enumerate(self.variants):
            field = self.layout.fields[n]
            frame.paste(Image.fromarray(self._field(columns[label], field.size)), (field.left, field.top))
            if self.layout.histograms:
                middle, base = field.left + field.width / 2, field.bottom + TICKS + 20
                self._gaps(pen, self.layout.histograms[n], columns[label]["gaps"], middle, base)
        text.write(pen, self.size[0] - 20, TITLE - 22, time_text(time), TITLE_SIZE, "rs")
        return np.asarray(frame)

    def _gaps(self, pen, rect, gaps, middle: float, base: float):
        """Histogram and count below a panel; red where particles are too close."""
        colour = text.CLOSE if text.close_share(gaps) > 0 else text.INK
        line = text.fit(text.close_text(gaps), rect.width + 20, COUNT_SIZE)
        text.write(pen, middle, base, line, COUNT_SIZE, "ms", colour)
        text.histogram(pen, rect, gaps)


def time_text(time: float) -> str:
    """ "t = 0.50": two decimals, more where two would hide the time."""
    digits = 2 if time == 0 or abs(time) >= 0.1 or isclose(round(time, 2), time) else 4
    return f"t = {time:.{digits}f}" if abs(time) >= 1e-3 or time == 0 else f"t = {time:.2e}"
