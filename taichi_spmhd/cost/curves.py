"""What is drawn into the work-precision diagram: methods, anchors, the Pareto front, slopes to compare with."""

from .orders import growth, methods, pareto

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7a5195", "#5b5b5b")  # Okabe & Ito first
MARKERS = ("o", "s", "^", "D", "v", "P", "*", "h")
GREY = "#8a8a8a"
SLOPES = (1, 2)  # orders of convergence drawn for comparison


def curves(axes, plan, rows: list[dict]) -> None:
    """A line for every method: colour and marker by all but the precision, f32 dashed and open; doubts crossed."""
    kinds: dict[str, int] = {}
    for method, there in methods(rows, plan.telling, plan.level).items():
        half = there[0]["setting"]["precision"] == "f32" and "precision" in plan.telling
        kind = kinds.setdefault(kind_of(there[0], plan), len(kinds))
        look = {"color": COLOURS[kind % len(COLOURS)], "marker": MARKERS[kind % len(MARKERS)]}
        look |= {"linestyle": "--", "markerfacecolor": "white"} if half else {"linestyle": "-"}
        curve(axes, there, {**look, "label": method or plan.labels[0]})
        names(axes, there, plan.level, look["color"], above=not half)


def kind_of(row: dict, plan) -> str:
    """The method without its precision."""
    return repr([row["setting"].get(name) for name in plan.telling if name not in (plan.level, "precision")])


def curve(axes, there: list[dict], look: dict) -> None:
    """One method, with the smallest and largest seconds as bars."""
    x, y = [row["seconds"] for row in there], [row["error"] for row in there]
    below = [row["seconds"] - row["seconds_min"] for row in there]
    above = [row["seconds_max"] - row["seconds"] for row in there]
    axes.errorbar(x, y, xerr=[below, above], markersize=6, lw=1.4, elinewidth=0.8, zorder=3, **look)
    wrong = [(row["seconds"], row["error"]) for row in there if row["doubts"]]
    if wrong:
        axes.plot(*zip(*wrong, strict=True), "x", color="black", ms=11, mew=1.3, zorder=5)


def names(axes, there: list[dict], level: str | None, colour: str, above: bool) -> None:
    """The resolution beside each point."""
    for row in there if level else ():
        name(axes, row["setting"][level], (row["seconds"], row["error"]), colour, above)


def name(axes, level: float, point, colour: str, above: bool = True) -> None:
    """A number beside a point: above and right, or below and left."""
    shift, side = ((5, 5), "left") if above else ((-5, -11), "right")
    axes.annotate(f"{level:g}", point, xytext=shift, textcoords="offset points", fontsize=8, color=colour, ha=side)


def anchored(axes, anchor, k: int) -> None:
    """Somebody else's curve, the k-th, in grey."""
    _, x, y = zip(*anchor.points, strict=True)
    look = {"marker": "dp8"[k % 3], "linestyle": (":", "-.", "--")[k % 3]}
    axes.plot(x, y, color=GREY, lw=1.1, ms=5, label=anchor.label, zorder=2, **look)
    for level, seconds, error in anchor.points:
        name(axes, level, (seconds, error), GREY)


def front(axes, rows: list[dict]) -> None:
    """The Pareto front: rings around what nothing cheaper beats, and the steps between them."""
    best = pareto(rows)
    x, y = [row["seconds"] for row in best], [row["error"] for row in best]
    axes.step(x, y, where="post", color="black", lw=0.8, alpha=0.5, zorder=1)
    ring = {"ms": 12, "markerfacecolor": "none", "markeredgecolor": "black", "mew": 1.0}
    axes.plot(x, y, "o", zorder=4, label="Pareto front", **ring)
    if any(row.get("doubts") for row in rows):
        axes.plot([], [], "x", color="black", ms=9, label="marked: see the table")


def slopes(axes, plan, rows: list[dict]) -> None:
    """error ~ seconds^(-p/g): what order p would give where particles times steps go with resolution^g."""
    best, g = pareto(rows), growth(rows, plan)
    if not g or not best:
        return
    x0, y0 = best[0]["seconds"], 1.7 * best[0]["error"]
    x1 = max(axes.get_xlim()[1], 1.01 * x0)
    for p in SLOPES:
        end = y0 * (x1 / x0) ** (-p / g)
        axes.plot([x0, x1], [y0, end], color="#c8c8c8", lw=0.9, zorder=0, scalex=False, scaley=False)
        middle = ((x0 * x1) ** 0.5, (y0 * end) ** 0.5)
        small = {"fontsize": 7.5, "color": "#9a9a9a", "clip_on": True}
        axes.annotate(f"order {p}", middle, xytext=(0, 3), textcoords="offset points", **small)
