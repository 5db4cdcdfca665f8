"""Text and histogram bars that change from frame to frame, drawn with Pillow in the font that matplotlib ships."""

from functools import cache
from pathlib import Path

import numpy as np
from PIL import ImageDraw, ImageFont

from .background import GAP_RANGE
from .layout import Rect

INK, GREY = (32, 34, 42), (92, 96, 108)
CLOSE, FAR = (200, 40, 40), (96, 125, 160)  # bars below and above half a spacing
BINS = 30


@cache
def font(size: int, bold: bool = False):
    """DejaVu Sans of matplotlib: there on every system, with Greek and mathematical signs."""
    from matplotlib import get_data_path

    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    return ImageFont.truetype(str(Path(get_data_path()) / "fonts" / "ttf" / name), size)


def fit(text: str, width: int, size: int, bold: bool = False) -> str:
    """The text, cut with an ellipsis where it is wider than `width` pixels."""
    if font(size, bold).getlength(text) <= width:
        return text
    while text and font(size, bold).getlength(text + "…") > width:
        text = text[:-1]
    return text.rstrip(" ,+") + "…"


def wrap(words: list[str], joint: str, width: int, size: int, most: int) -> list[str]:
    """Words joined into at most `most` lines no wider than `width` pixels."""
    lines: list[str] = []
    for n, word in enumerate(words):
        piece = word + (joint if n + 1 < len(words) else "")
        if lines and font(size).getlength(lines[-1] + piece.rstrip()) <= width:
            lines[-1] += piece
        else:
            lines.append(piece)
    if len(lines) > most:
        lines = [*lines[: most - 1], "".join(lines[most - 1 :])]
    return [fit(line.rstrip(), width, size) for line in lines]


def write(pen: ImageDraw.ImageDraw, x, y, text: str, size: int, anchor="ls", colour=INK, bold=False):
    """Text with its baseline at y; anchor as in Pillow: "ls" left, "ms" middle, "rs" right."""
    pen.text((x, y), text, font=font(size, bold), fill=colour, anchor=anchor)


def close_share(gaps) -> float:
    """Percentage of particles whose nearest neighbour is closer than half a spacing; gaps (N,) in spacings."""
    gaps = np.asarray(gaps)
    return 100.0 * float(np.mean(gaps < 0.5)) if len(gaps) else 0.0


def close_text(gaps) -> str:
    """The line under a tensile panel, "12 % closer than half a spacing"; one digit more below 10 %."""
    share = close_share(gaps)
    number = f"{share:.1f}" if 0.0 < share < 9.95 else f"{share:.0f}"
    return f"{number} % closer than half a spacing"


def histogram(pen: ImageDraw.ImageDraw, rect: Rect, gaps):
    """Bars of the nearest-neighbour distances, the tallest nearly as high as the rectangle; a mark at one half."""
    counts, edges = np.histogram(np.asarray(gaps), bins=BINS, range=(0.0, GAP_RANGE))
    highest = max(int(counts.max()), 1)
    for count, lo, hi in zip(counts, edges[:-1], edges[1:], strict=True):
        if count:
            left = rect.left + round(lo / GAP_RANGE * rect.width) + 1
            right = rect.left + round(hi / GAP_RANGE * rect.width) - 1
            high = max(1, round(0.9 * (rect.height - 2) * count / highest))
            fill = CLOSE if hi <= 0.5 + 1e-9 else FAR
            pen.rectangle((left, rect.bottom - 1 - high, right, rect.bottom - 2), fill=fill)
    half = rect.left + round(0.5 / GAP_RANGE * rect.width)
    for top in range(rect.top + 1, rect.bottom - 1, 8):
        pen.line((half, top, half, min(top + 4, rect.bottom - 2)), fill=INK)
