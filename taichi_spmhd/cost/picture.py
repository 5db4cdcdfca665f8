"""The work-precision diagram: log error over log seconds, a line for every method, its points named by resolution."""

import statistics

from ..outputs.figure import PALE, finished, sheet
from .calibration import STANDARD
from .curves import anchored, curves, front, slopes

FEW = 3000  # range up to which 2 and 5 are written too


def draw(plan, rows: list[dict], error: str, where: str, caption: str, path) -> None:
    """Write the PNG. where: device and precision, for the axes; caption: machine, version, date."""
    figure, canvas = sheet(9.6, 6.4, dpi=120)
    axes = figure.add_subplot(xscale="log", yscale="log")
    curves(axes, plan, rows)
    for k, anchor in enumerate(plan.anchors):
        anchored(axes, anchor, k)
    front(axes, rows)
    room(axes)
    slopes(axes, plan, rows)
    labels(axes, plan, error, where)
    second_scale(axes, rows)
    legend(axes, plan)
    finished(figure, canvas, f"{plan.name}: what accuracy costs in time", caption, path)


def room(axes) -> None:
    """A little more than the points need."""
    for get, put in ((axes.get_xlim, axes.set_xlim), (axes.get_ylim, axes.set_ylim)):
        lo, hi = get()
        put(lo / 1.3, hi * 1.5)


def labels(axes, plan, error: str, where: str) -> None:
    """What the axes are, in plain numbers."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axes.set_xlabel(f"seconds of stepping to t = {plan.t_end:g} ({where})")
    axes.set_ylabel(f"error in {error}: mean |difference| / mean |exact|")
    axes.grid(True, which="major", color="#e4e4e4", lw=0.7)
    axes.set_axisbelow(True)
    for axis, (lo, hi) in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if hi < FEW * lo else (1.0,)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(NullFormatter())


def second_scale(axes, rows: list[dict]) -> None:
    """Scaled seconds along the top, by the median of what the calibration loop said."""
    from matplotlib.ticker import FuncFormatter

    factor = statistics.median(row["seconds_scaled"] / row["seconds"] for row in rows if row["error"] is not None)
    top = axes.secondary_xaxis("top", functions=(lambda x: x * factor, lambda x: x / factor))
    top.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    what = f"scaled seconds (a machine whose calibration loop takes {1e3 * STANDARD:.0f} ms)"
    top.set_xlabel(what, fontsize=8.5, color=PALE)
    top.tick_params(labelsize=8, colors=PALE)


def legend(axes, plan) -> None:
    """Methods first, in the order of the study; then what marks them."""
    marks = ("Pareto front", "marked: see the table")
    every = sorted(zip(*axes.get_legend_handles_labels(), strict=True), key=lambda one: one[1] in marks)
    named = {handle: label for handle, label in every if hasattr(handle, "has_xerr")}  # bars come last in matplotlib
    rest = {handle: label for handle, label in every if handle not in named}
    both = {**named, **rest}
    place = {"loc": "upper left", "bbox_to_anchor": (1.01, 1.0), "frameon": False, "alignment": "left"}
    title = f"numbers: {plan.level}" if plan.level else None
    axes.legend(both.keys(), both.values(), fontsize=8, title=title, title_fontsize=8, **place)
