"""Particles into a picture: numpy in, uint8 RGB out. The work is done by the Taichi kernels of kernels.py."""

import numpy as np
from PIL import Image, ImageDraw

from ..box import Box
from ..errors import InputError
from ..picture import DRAW, suggestion
from . import kernels
from .binning import Bins, bin_points, place, visible
from .colours import BACKGROUND, fractions, paint

DISC = 0.57  # radius over spacing: neighbours of a square or hexagonal lattice just touch, 5 % stays dark
DOT = 2.6  # radius of the dots of 1-D plots, pixels
SMALLEST_DISC = 0.7  # pixels


def _launch(kernel, out: np.ndarray, bins: Bins, members: np.ndarray) -> np.ndarray:
    """Run a pixel kernel over `out`."""
    members = np.ascontiguousarray(members)
    kernel(out, bins.points, members, bins.start, bins.grid, bins.cell, bins.origin, bins.wraps)
    return out


def empty(size: tuple[int, int]) -> np.ndarray:
    """A panel (H, W, 3) in which nothing is drawn."""
    return np.full((size[1], size[0], 3), BACKGROUND, np.uint8)


def draw_discs(places, colour, radius, size, periodic=(False, False)) -> np.ndarray:
    """Discs of radius (N,) and colour (N, 3) uint8 at places (N, 3), all in pixels, on the dark background."""
    reach = np.maximum(radius, SMALLEST_DISC) + 0.5  # half a pixel more for the smoothed edge
    seen = visible(places, reach, size)
    if not seen.any():
        return empty(size)
    bins = bin_points(places[seen], reach[seen], size, periodic)
    return _launch(kernels.discs, empty(size), bins, colour[seen][bins.order])


def draw_nearest(places, colour, size, periodic=(False, False)) -> np.ndarray:
    """Each pixel in the colour (N, 3) of its nearest place (N, 3): Voronoi cells, in 3-D cut at the middle plane."""
    seen = visible(places, np.ones(len(places)), size)
    if not seen.any():
        return empty(size)
    spacing = np.sqrt(size[0] * size[1] / seen.sum())
    bins = bin_points(places[seen], np.ones(seen.sum()), size, periodic, cell_size=spacing)
    return _launch(kernels.nearest, empty(size), bins, colour[seen][bins.order])


def interpolate(places, values, h, volume, dim, size, periodic=(False, False)) -> np.ndarray:
    """sum m/rho A W(r, h) / sum m/rho W(r, h) at the pixels: (H, W) float32, NaN where no particle reaches.

    places (N, 3) and h (N,) in pixels; volume (N,) = m/rho in any unit; h may differ from particle to particle.
    """
    reach = 2.0 * np.asarray(h, dtype=float)
    seen = visible(places, reach, size) & (np.abs(places[:, 2]) < reach)
    sums = np.zeros((size[1], size[0], 2), np.float32)
    if seen.any():
        bins = bin_points(places[seen], reach[seen], size, periodic)
        weight = volume[seen] / h[seen] ** dim
        terms = np.column_stack([values[seen], weight / weight.max()])[bins.order].astype(np.float32)
        _launch(kernels.interpolate, sums, bins, terms)
    covered = sums[..., 1] > 0
    return np.where(covered, sums[..., 0] / np.where(covered, sums[..., 1], 1), np.float32(np.nan))


def _draw_sph(places, values, h, spacing, dim, size, palette, limits, log, periodic) -> np.ndarray:
    """The interpolated field in colours; the background where no particle reaches."""
    h = np.maximum(h, SMALLEST_DISC)  # below a pixel particles would fall between the pixels
    field = interpolate(places, values, h, spacing**dim, dim, size, periodic)
    rgb = paint(field, palette, limits, log)
    rgb[np.isnan(field)] = BACKGROUND
    return rgb


def draw_profile(box: Box, x, values, size, limits, colour, log=False) -> np.ndarray:
    """Dots of value (N,) against the first coordinate of x (N, d); limits are the ends of the vertical axis."""
    right = (np.asarray(x, dtype=float)[:, 0] - box.lo[0]) * size[0] / box.size[0]
    down = (1 - fractions(values, limits, log)) * size[1]
    places = np.column_stack([right, down, np.zeros(len(right))])
    colours = np.broadcast_to(np.array(colour, np.uint8), (len(right), 3))
    return draw_discs(places, colours, np.full(len(right), DOT), size)


def draw_curve(rgb, box: Box, points, limits, colour, log=False) -> np.ndarray:
    """`rgb` with a line through points (M, 2) of (x, value) on it; None draws nothing."""
    if points is None:
        return rgb
    height, width = rgb.shape[:2]
    right = (points[:, 0] - box.lo[0]) * width / box.size[0]
    down = (1 - fractions(points[:, 1], limits, log)) * height
    image = Image.fromarray(rgb)
    ImageDraw.Draw(image).line(list(zip(right.tolist(), down.tolist(), strict=True)), fill=colour, width=1)
    return np.asarray(image)


def draw(
    kind: str, box: Box, x, values, h, size, palette, limits, *, spacing=None, periodic=(False,) * 3, log=False
) -> np.ndarray:
    """A picture (H, W, 3) uint8 of values (N,) at x (N, d).

    kind: "particles", "nearest" or "sph"; size: (W, H) pixels; h: smoothing lengths (N,); spacing: (m/rho)^(1/d) (N,),
    taken as h where it is missing; palette: (256, 3) uint8; periodic: one bool per axis.
    d = 1 draws dots of value against x; d = 3 the plane through the middle of the third axis ("particles": those
    within half a spacing of it). Raises InputError for an unknown kind.
    """
    if kind not in DRAW:
        raise InputError(f"unknown kind of picture {kind!r}{suggestion(kind, DRAW)}; use {', '.join(DRAW)}")
    x, values = np.asarray(x), np.asarray(values, dtype=np.float32)
    if x.shape[1] == 1:
        return draw_profile(box, x, values, size, limits, palette[200], log)
    h = np.asarray(h, dtype=float)
    spacing = h if spacing is None else np.asarray(spacing, dtype=float)
    places, scale = place(box, x, size, periodic), size[0] / box.size[0]
    if kind == "sph":
        return _draw_sph(places, values, h * scale, spacing * scale, x.shape[1], size, palette, limits, log, periodic)
    colour = paint(values, palette, limits, log)
    if kind == "nearest":
        return draw_nearest(places, colour, size, periodic)
    slab = np.abs(places[:, 2]) <= 0.5 * spacing * scale
    places[:, 2] = 0.0
    return draw_discs(places[slab], colour[slab], DISC * spacing[slab] * scale, size, periodic)
