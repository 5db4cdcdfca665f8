"""The part of a frame that never changes: axes, ticks, colour bar, drawn by matplotlib once per film."""

import numpy as np

from ..box import Box
from ..picture import Picture
from .colours import palette
from .layout import Layout, Rect, is_profile

DPI = 100
SMALL, LARGE = 10, 12  # points
INK = "#20222a"
GAP_RANGE = 1.5  # of the histograms, in spacings


def _axes(figure, layout: Layout, rect: Rect):
    """Axes that fill a rectangle to the pixel."""
    bottom = layout.height - rect.bottom
    wide, high = layout.width, layout.height
    axes = figure.add_axes([rect.left / wide, bottom / high, rect.width / wide, rect.height / high])
    axes.tick_params(labelsize=SMALL, color=INK, labelcolor=INK, length=4)
    for spine in axes.spines.values():
        spine.set_color(INK)
    return axes


def _ticks(axis, length: int, apart: int):
    """Round tick values, at most one every `apart` pixels, so that labels never touch."""
    from matplotlib.ticker import MaxNLocator

    axis.set_major_locator(MaxNLocator(nbins=max(1, min(6, length // apart)), steps=[1, 2, 5, 10]))


def _field(figure, layout: Layout, n: int, box: Box, picture: Picture, limits):
    """Axes of panel n."""
    rect, profile = layout.fields[n], is_profile(box)
    axes = _axes(figure, layout, rect)
    axes.set_xlim(box.lo[0], box.hi[0])
    axes.set_ylim(*(limits if profile else (box.lo[1], box.hi[1])))
    if profile and picture.log:
        axes.set_yscale("log")
    else:
        _ticks(axes.yaxis, rect.height, 50)
    _ticks(axes.xaxis, rect.width, 52)
    axes.set_xlabel("x", fontsize=LARGE, labelpad=1, color=INK)
    if n % layout.columns == 0:
        axes.set_ylabel(picture.tex if profile else "y", fontsize=LARGE, labelpad=2, color=INK)
    else:
        axes.set_yticklabels([])


def _histogram(figure, layout: Layout, n: int):
    """Axes below panel n; bars and the mark at half a spacing are drawn per frame."""
    axes = _axes(figure, layout, layout.histograms[n])
    axes.set_xlim(0, GAP_RANGE)
    axes.set_xticks([0, 0.5, 1, 1.5], ["0", "½", "1", "1½"])
    axes.set_yticks([])
    axes.set_xlabel("nearest neighbour / spacing", fontsize=SMALL, labelpad=1, color=INK)


def _colour_bar(figure, layout: Layout, picture: Picture, limits):
    """The colour bar beside the first row."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import ListedColormap, LogNorm, Normalize

    colours = ListedColormap(palette(picture.colour_map(limits)) / 255)
    norm = (LogNorm if picture.log else Normalize)(*limits)
    axes = _axes(figure, layout, layout.bar)
    bar = figure.colorbar(ScalarMappable(norm, colours), cax=axes)
    bar.ax.tick_params(labelsize=SMALL, labelcolor=INK)
    bar.ax.set_title(picture.tex, fontsize=LARGE, color=INK, pad=9, loc="left")
    if not picture.log:
        _ticks(bar.ax.yaxis, layout.bar.height, 60)


def background(layout: Layout, box: Box, picture: Picture, limits: tuple[float, float]) -> np.ndarray:
    """The frame (H, W, 3) uint8 without fields, bars and changing text."""
    # not pyplot: its figures are global and pile up
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(layout.width / DPI, layout.height / DPI), dpi=DPI, facecolor="white")
    canvas = FigureCanvasAgg(figure)
    for n in range(len(layout.fields)):
        _field(figure, layout, n, box, picture, limits)
    for n in range(len(layout.histograms)):
        _histogram(figure, layout, n)
    if layout.bar:
        _colour_bar(figure, layout, picture, limits)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].copy()
