"""The price list as bars: what each term and choice adds to a step, and the phases of a step."""

from ...bench.clocks import PHASES
from ...outputs.figure import finished, sheet

COLOURS = {"f64": "#0072b2", "f32": "#e69f00"}
SHADES = ("#4d4d4d", "#8a8a8a", "#56b4e9", "#0072b2", "#d0d0d0")  # of the phases, in their order


def draw(name: str, found: dict[str, dict], where: str, caption: str, path) -> None:
    """Write the PNG; found: {precision: prices}."""
    good = {precision: made for precision, made in found.items() if "wrong" not in made}
    labels = list(dict.fromkeys(one["name"] for made in good.values() for one in rows(made)))
    height = 1.8 + 0.34 * len(labels) + 0.45 * len(good)
    figure, canvas = sheet(9.0, height, dpi=120)
    ratio = [0.34 * len(labels) + 0.6, 0.45 * len(good) + 0.4]
    top, bottom = figure.subplots(2, 1, height_ratios=ratio)
    bars(top, labels, good)
    phases(bottom, good)
    finished(figure, canvas, f"{name}: the price list ({where})", caption, path)


def rows(made: dict) -> list[dict]:
    """Terms and choices that have a price."""
    return [one for one in (*made["terms"], *made["choices"]) if one["ms"] is not None]


def bars(axes, labels: list[str], good: dict[str, dict]) -> None:
    """ms a step that each adds, the spread as a line."""
    thick = 0.8 / len(good)
    for k, (precision, made) in enumerate(good.items()):
        there = {one["name"]: one for one in rows(made)}
        at = [n + (k - 0.5 * (len(good) - 1)) * thick for n, label in enumerate(labels) if label in there]
        own = [there[label] for label in labels if label in there]
        spread = [one.get("spread_ms", 0.0) for one in own]
        look = {"color": COLOURS.get(precision, "#555555"), "label": precision, "ecolor": "#333333"}
        axes.barh(at, [one["ms"] for one in own], 0.9 * thick, xerr=spread, error_kw={"elinewidth": 0.8}, **look)
    axes.set_yticks(range(len(labels)), labels, fontsize=8.5)
    axes.invert_yaxis()
    axes.axvline(0, color="black", lw=0.8)
    axes.grid(True, axis="x", color="#e4e4e4", lw=0.7)
    axes.set_axisbelow(True)
    axes.set_xlabel(
        "ms a step: of a term, what it adds; of a choice, what it adds instead of the scene's own", fontsize=8.5
    )
    axes.legend(fontsize=8, frameon=False, ncols=2, loc="lower right", bbox_to_anchor=(1.0, 1.0))


def phases(axes, good: dict[str, dict]) -> None:
    """A step from left to right, phase by phase."""
    for k, made in enumerate(good.values()):
        left = 0.0
        for phase, shade in zip(PHASES, SHADES, strict=True):
            axes.barh(k, made["phases"][phase], 0.7, left=left, color=shade, label=phase if k == 0 else None)
            left += made["phases"][phase]
    axes.set_yticks(range(len(good)), list(good), fontsize=8.5)
    axes.invert_yaxis()
    axes.set_xlabel("ms: the phases of a step", fontsize=8.5)
    axes.legend(fontsize=8, frameon=False, ncols=len(PHASES), loc="lower left", bbox_to_anchor=(0.0, 1.0))
