"""The picture of a scan: growth against one parameter, or a map over two with the boundary of linear theory."""

import numpy as np

from .picture import STILL, finished, sheet

TOP = "#7ad151"


def draw(name: str, scanned: dict[str, list], rows: list[dict], unit: str, caption: str, path) -> None:
    """A map where two parameters vary and one state belongs to each pair; curves over the first of them otherwise."""
    figure, canvas = sheet(8.4, 5.6)
    axes = figure.add_subplot()
    if len(scanned) == 2 and len(rows) == np.prod([len(values) for values in scanned.values()]):
        mapped(figure, axes, scanned, rows, unit)
    else:
        curves(axes, scanned, rows, unit)
    finished(figure, canvas, f"{name}: largest growth of small waves", caption, path)


def mapped(figure, axes, scanned: dict[str, list], rows: list[dict], unit: str) -> None:
    """Growth over both; the second parameter lies along x."""
    from matplotlib.colors import LogNorm

    (up, ys), (across, xs) = scanned.items()
    growth = np.array([row["growth"] for row in rows]).reshape(len(ys), len(xs))
    top = max(growth.max(), 10 * STILL)
    shown = axes.pcolormesh(
        xs, ys, np.clip(growth, STILL, None), norm=LogNorm(STILL, top), cmap="inferno", shading="nearest"
    )
    figure.colorbar(shown, ax=axes, label=f"growth [{unit}]; black: below {STILL:g}")
    for axis, values in ((axes.set_xscale, xs), (axes.set_yscale, ys)):
        axis("log" if logarithmic(values) else "linear")
    axes.set(xlabel=across, ylabel=up, xlim=(min(xs), max(xs)), ylim=(min(ys), max(ys)))
    boundary(axes, scanned)


def boundary(axes, scanned: dict[str, list]) -> None:
    """xi = (1 - beta)/2 where these two are what varies."""
    if set(scanned) != {"xi", "beta"}:
        return
    beta = np.geomspace(max(1e-6, min(scanned["beta"])), max(scanned["beta"]), 400)
    line = (beta, 0.5 * (1 - beta))
    axes.plot(*(line if next(iter(scanned)) == "xi" else line[::-1]), color=TOP, lw=2, label="xi = (1 - beta)/2")
    axes.legend(loc="upper right", fontsize=9)


def curves(axes, scanned: dict[str, list], rows: list[dict], unit: str) -> None:
    """Growth over the first parameter; a curve for each variant and choice of the others."""
    along, *others = scanned
    series: dict = {}
    several = len({row["variant"] for row in rows}) > 1 and len({row["variant"] for row in rows}) < len(rows)
    for row in rows:
        words = [f"{name} = {row[name]}" for name in others] + ([row["variant"]] if several else [])
        series.setdefault(", ".join(words), []).append((row[along], max(row["growth"], STILL / 10)))
    for words, points in series.items():
        axes.plot(*zip(*points, strict=True), "o-", ms=4, label=words)
    if logarithmic(scanned[along]):
        axes.set_xscale("log")
    axes.set(xlabel=along, ylabel=f"largest growth [{unit}]", yscale="log")
    axes.axhline(STILL, color="#999999", lw=0.8, ls=":")
    if any(series):
        axes.legend(fontsize=8, frameon=False)


def logarithmic(values: list) -> bool:
    """Whether these numbers are best seen on a logarithmic axis."""
    numbers = [v for v in values if isinstance(v, (int, float)) and not isinstance(v, bool)]
    return len(numbers) == len(values) and min(numbers) > 0 and max(numbers) >= 50 * min(numbers)
