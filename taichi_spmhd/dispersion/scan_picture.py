"""The picture of a scan: growth against one name, or a map over two with the boundary of linear theory."""

from numbers import Real

import numpy as np

from ..outputs.figure import finished, sheet
from .result import STILL

TOP = "#7ad151"


def draw(name: str, scanned: dict[str, list], rows: list[dict], caption: str, path) -> None:
    """A map where two names vary and one state belongs to each pair; curves over the first of them otherwise."""
    figure, canvas = sheet(8.4, 5.6)
    axes, unit = figure.add_subplot(), " or ".join(sorted({row["unit"] for row in rows}))
    if len(scanned) == 2 and len(rows) == np.prod([len(values) for values in scanned.values()]):
        mapped(figure, axes, scanned, rows, unit)
    else:
        curves(axes, scanned, rows, unit)
    finished(figure, canvas, f"{name}: largest growth of small waves", caption, path)


def mapped(figure, axes, scanned: dict[str, list], rows: list[dict], unit: str) -> None:
    """Growth over both; the second name lies along x."""
    from matplotlib.colors import LogNorm

    (up, ys), (across, xs) = scanned.items()
    growth = np.array([row["growth"] for row in rows]).reshape(len(ys), len(xs))
    top = max(growth.max(), 10 * STILL)
    cells = edges(xs), edges(ys)
    shown = axes.pcolormesh(*cells, np.clip(growth, STILL, None), norm=LogNorm(STILL, top), cmap="inferno")
    figure.colorbar(shown, ax=axes, label=f"growth [{unit}]; black: below {STILL:g}")
    along(axes.xaxis, axes.set_xscale, across, xs)
    along(axes.yaxis, axes.set_yscale, up, ys)
    axes.set(xlim=(cells[0].min(), cells[0].max()), ylim=(cells[1].min(), cells[1].max()))
    boundary(axes, scanned)


def edges(values: list) -> np.ndarray:
    """Where the cells of these values begin and end: half way between, in the logarithm where that is their axis."""
    x = np.array(values, float) if numeric(values) else np.arange(len(values), dtype=float)
    x = np.log(x) if logarithmic(values) else x
    middle = 0.5 * (x[1:] + x[:-1]) if len(x) > 1 else x
    out = np.concatenate([[2 * x[0] - middle[0]], middle, [2 * x[-1] - middle[-1]]])
    return np.exp(out) if logarithmic(values) else out


def along(axis, scale, name: str, values: list) -> None:
    """An axis of numbers, or of words."""
    axis.set_label_text(name)
    if not numeric(values):
        axis.set_ticks(range(len(values)), [str(value) for value in values])
    elif logarithmic(values):
        scale("log")


def boundary(axes, scanned: dict[str, list]) -> None:
    """xi = (1 - beta)/2 where these two are what varies."""
    if set(scanned) != {"xi", "beta"}:
        return
    beta = np.geomspace(max(1e-6, min(scanned["beta"])), max(scanned["beta"]), 400)
    line = (beta, 0.5 * (1 - beta))
    axes.plot(*(line if next(iter(scanned)) == "xi" else line[::-1]), color=TOP, lw=2, label="xi = (1 - beta)/2")
    axes.legend(loc="upper right", fontsize=9)


def curves(axes, scanned: dict[str, list], rows: list[dict], unit: str) -> None:
    """Growth over the first name; a curve for each variant and choice of the others."""
    first, *others = scanned
    several = 1 < len({row["variant"] for row in rows}) < len(rows)
    series: dict = {}
    for row in rows:
        given = row["parameters"]
        words = [f"{name} = {given[name]}" for name in others] + ([row["variant"]] if several else [])
        place = given[first] if numeric(scanned[first]) else scanned[first].index(given[first])
        series.setdefault(", ".join(words), []).append((place, max(row["growth"], STILL / 10)))
    for words, points in series.items():
        axes.plot(*zip(*points, strict=True), "o-", ms=4, label=words)
    along(axes.xaxis, axes.set_xscale, first, scanned[first])
    axes.set(ylabel=f"largest growth [{unit}]", yscale="log")
    axes.axhline(STILL, color="#999999", lw=0.8, ls=":")
    if any(series):
        axes.legend(fontsize=8, frameon=False)


def numeric(values: list) -> bool:
    """Whether these are numbers."""
    return all(isinstance(value, Real) and not isinstance(value, bool) for value in values)


def logarithmic(values: list) -> bool:
    """Whether these numbers are best seen on a logarithmic axis."""
    return numeric(values) and min(values) > 0 and max(values) >= 50 * min(values)
