"""From numbers to colours: limits, palettes, fixed backgrounds."""

from functools import cache

import numpy as np

BACKGROUND = (16, 17, 22)  # behind the particles; dark, so that missing particles are seen
BROKEN = (255, 0, 255)  # values that are not numbers
DECADES = 4  # shown at most by logarithmic colours without limits


@cache
def _palette(name: str) -> np.ndarray:
    from matplotlib import colormaps

    # maps that begin in black would hide their low end in front of the background
    lowest = 0.15 if sum(colormaps[name](0.0)[:3]) < 0.25 else 0.0
    colours = colormaps[name](np.linspace(lowest, 1.0, 256))[:, :3]
    fixed = np.rint(255 * colours).astype(np.uint8)
    fixed.setflags(write=False)
    return fixed


def palette(name: str) -> np.ndarray:
    """The colours of a matplotlib map, (256, 3) uint8."""
    return _palette(name)


def auto_limits(values: np.ndarray, log: bool = False) -> tuple[float, float]:
    """Limits for values (N,): the finite range; symmetric about 0 where it has both signs; at most 4 decades if log."""
    finite = np.asarray(values, dtype=float)[np.isfinite(values)]
    if log:
        top = float(finite.max(initial=0.0)) or 1.0
        positive = finite[finite > 0]
        return max(float(positive.min(initial=top)) * 0.999, top * 10.0**-DECADES), top
    lo, hi = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 1.0)
    if lo < 0 < hi and min(-lo, hi) > 0.1 * max(-lo, hi):
        return -max(-lo, hi), max(-lo, hi)
    if hi - lo > 1e-6 * max(abs(lo), abs(hi)):
        return lo, hi
    return (0.0, 1.0) if lo == 0 else (lo - 0.5 * abs(lo), lo + 0.5 * abs(lo))


def fractions(values: np.ndarray, limits: tuple[float, float], log: bool = False) -> np.ndarray:
    """Where values lie between the limits, 0 to 1; NaN stays NaN."""
    lo, hi = limits
    values = np.asarray(values, dtype=np.float32)
    if log:
        values, lo, hi = np.log(np.maximum(values, np.float32(1e-30))), np.log(lo), np.log(hi)
    return np.clip((values - np.float32(lo)) * np.float32(1.0 / (hi - lo)), 0.0, 1.0)


def paint(values: np.ndarray, colours: np.ndarray, limits: tuple[float, float], log: bool = False) -> np.ndarray:
    """Colours (..., 3) uint8 of values (...); what is not a number is drawn in magenta."""
    where = fractions(values, limits, log)
    broken = np.isnan(where)
    index = (np.where(broken, 0.0, where) * 255 + 0.5).astype(np.uint8)
    rgb = colours[index]
    if broken.any():
        rgb[broken] = BROKEN
    return rgb
