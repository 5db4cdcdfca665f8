"""GIF films with one fixed palette, no dither, and a limit on their size."""

from collections.abc import Iterable
from math import sqrt
from pathlib import Path

import numpy as np
from PIL import Image

from ..errors import InputError
from .movie import checked, place

MOST_COLOURS = 255  # one of 256 is left for what does not change between frames
FEWER = (128, 64)  # colours tried before the film is made smaller
SMALLEST = 0.2  # scale below which a film is no use


def general_palette() -> np.ndarray:
    """240 colours (n, 3) uint8 for frames of unknown origin: 6 x 6 x 6 levels and greys."""
    levels = np.arange(0, 256, 51)
    cube = np.stack(np.meshgrid(levels, levels, levels), axis=-1).reshape(-1, 3)
    greys = np.linspace(5, 250, 24)[:, None].repeat(3, axis=1)
    return np.concatenate([cube, greys]).astype(np.uint8)


def _distances(colours: np.ndarray, palette: np.ndarray) -> np.ndarray:
    """Squared distances (n, m) between colours (n, 3) and palette (m, 3)."""
    colours, palette = colours.astype(np.float32), palette.astype(np.float32)
    return (colours**2).sum(1)[:, None] - 2 * colours @ palette.T + (palette**2).sum(1)


def lookup(palette: np.ndarray) -> np.ndarray:
    """Index (32768,) uint8 of the palette's nearest colour for each colour of five bits a channel."""
    level = np.arange(32) * 255 / 31
    cube = np.stack(np.meshgrid(level, level, level, indexing="ij"), axis=-1).reshape(-1, 3)
    parts = [_distances(part, palette).argmin(1) for part in np.array_split(cube, 16)]
    return np.concatenate(parts).astype(np.uint8)


def index(rgb: np.ndarray, table: np.ndarray) -> np.ndarray:
    """Palette indices (H, W) uint8 of a frame (H, W, 3)."""
    bits = (rgb >> 3).astype(np.uint16)
    return table[(bits[..., 0] << 10) | (bits[..., 1] << 5) | bits[..., 2]]


def fewer(palette: np.ndarray, count: int) -> np.ndarray:
    """At most `count` colours (n, 3) that stand for those of the palette; black and white stay."""
    strip = Image.fromarray(palette[None]).quantize(count - 2, method=Image.Quantize.MEDIANCUT)
    used = np.array(strip.getpalette(), np.uint8).reshape(-1, 3)[: count - 2]
    return np.unique(np.concatenate([used, [[0, 0, 0], [255, 255, 255]]]).astype(np.uint8), axis=0)


def _image(indices: np.ndarray, palette: np.ndarray) -> Image.Image:
    picture = Image.fromarray(indices)  # an array of bytes opens as grey; the palette makes it colour
    picture.putpalette(palette.tobytes())
    return picture


def _save(path: Path, stack: list, palette: np.ndarray, durations: list[int]) -> int:
    """Write indexed frames and return the size in bytes."""
    first, rest = _image(stack[0], palette), (_image(indices, palette) for indices in stack[1:])
    first.save(
        path, format="GIF", save_all=True, append_images=rest, duration=durations, loop=0, disposal=1, optimize=False
    )
    return path.stat().st_size


def _smaller(stack: list, palette: np.ndarray, scale: float) -> list:
    """The frames at a fraction of their size, in the same palette."""
    high, wide = (max(2, 2 * round(0.5 * scale * n)) for n in stack[0].shape)
    table = lookup(palette)
    return [
        index(np.asarray(_image(s, palette).convert("RGB").resize((wide, high), Image.Resampling.BOX)), table)
        for s in stack
    ]


def _within(path: Path, stack: list, palette: np.ndarray, durations: list[int], limit: int) -> int:
    """Write the film with fewer colours, then smaller, until it is within the limit; its size in bytes."""
    size = _save(path, stack, palette, durations)
    for count in FEWER:
        # fewer colours seldom save more than half: beyond that go on to the scale with the least of them
        if size > limit and len(palette) > count:
            reduced = fewer(palette, count)
            change = _distances(palette, reduced).argmin(1).astype(np.uint8)
            stack, palette = [change[indices] for indices in stack], reduced
            size = _save(path, stack, palette, durations)
    scale, full = 1.0, stack
    while size > limit:
        scale *= min(0.95, sqrt(0.93 * limit / size))
        if scale < SMALLEST:
            raise InputError(f"{path.suffix} film does not fit into {limit} bytes; write fewer frames, or an mp4")
        size = _save(path, _smaller(full, palette, scale), palette, durations)
    return size


def write_gif(
    path, frames: Iterable, seconds_per_frame: float = 0.1, palette=None, limit: int = 4_000_000, hold: float = 1.0
) -> int:
    """Write frames (H, W, 3) uint8 as an endless GIF of at most `limit` bytes; return its size in bytes.

    palette: colours (n, 3) uint8 that matter (Panels.palette()), else a general one; hold: seconds the last frame
    stays. Too large a film gets fewer colours, then fewer pixels. Raises InputError for no frames or unequal sizes.
    """
    palette = (general_palette() if palette is None else np.asarray(palette, np.uint8))[:MOST_COLOURS]
    table = lookup(palette)
    stack = [index(rgb, table) for rgb in checked(frames)]  # one byte a pixel: 100 frames are about 100 MB
    if not stack:
        raise InputError("a film needs at least one frame")
    durations = [max(20, round(1000 * seconds_per_frame))] * len(stack)  # browsers slow down what is faster than 20 ms
    durations[-1] += round(1000 * hold)
    with place(path) as temporary:
        return _within(temporary, stack, palette, durations, limit)
