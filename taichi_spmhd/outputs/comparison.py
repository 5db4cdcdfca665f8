"""table.md: the variants of a run beside each other, one row each, to be read and to be pasted into a report.

Columns that are empty for all variants are left out: div B where there is no field, errors where nothing is known.
"""

import datetime
from collections.abc import Callable

from ..runtime import hardware

NOTE = (
    "Gaps and the first peak of the pair correlation are in mean spacings (a first peak of 0: there is none); close "
    "pairs: particles whose nearest neighbour is within half a spacing; drift: change since the start, of momentum in "
    "M v_rms and of energy in E, as measured and as the terms predict it; div B: h |div B| / |B|; errors: normalised "
    "L1; seconds: of stepping."
)


def figure(form: str, *path: str) -> Callable[[dict], str]:
    """A column: the number at this path of a variant's summary, formatted; empty where there is none."""

    def cell(entry: dict) -> str:
        for name in path:
            entry = entry.get(name) if isinstance(entry, dict) else None
        return "" if entry is None else form.format(entry)

    return cell


COLUMNS = {
    "steps": figure("{}", "steps"),
    "seconds": figure("{:.3g}", "seconds"),
    "mean gap": figure("{:.3f}", "mean_gap"),
    "close pairs": figure("{:.1%}", "close_pairs"),
    "first peak": figure("{:.3f}", "first_peak"),
    "momentum drift": figure("{:.2e}", "momentum_drift"),
    "momentum predicted": figure("{:.2e}", "momentum_drift_predicted"),
    "energy drift": figure("{:.2e}", "energy_drift"),
    "energy predicted": figure("{:.2e}", "energy_drift_predicted"),
    "div B mean": figure("{:.2e}", "div_B", "mean"),
    "div B 99 %": figure("{:.2e}", "div_B", "p99"),
    "div B max": figure("{:.2e}", "div_B", "max"),
}


def comparison(made: dict, measures: dict[str, str | None]) -> str:
    """Markdown: what ran, the table, a note. made: the summary of a run; measures: {label: the member to quote}."""
    entries = list(made["variants"].values())
    columns = {**COLUMNS, **error_columns(made["variants"], measures), "went wrong": figure("{}", "error")}
    cells = {name: [cell(entry) for entry in entries] for name, cell in columns.items()}
    cells = {"variant": list(made["variants"]), **{name: column for name, column in cells.items() if any(column)}}
    lines = [row(cells), row("---" for _ in cells), *map(row, zip(*cells.values(), strict=True))]
    return "\n".join([*head(made), "", *lines, "", NOTE, "", foot(made), ""])


def error_columns(variants: dict, measures: dict[str, str | None]) -> dict[str, Callable]:
    """A column for every error there is; of a variant whose scene names the one to quote, only for that."""
    quoted: dict[str, None] = {}
    for label, entry in variants.items():
        found = entry.get("errors", {})
        quoted.update(dict.fromkeys([measures[label]] if measures.get(label) in found else found))
    return {f"error {name}": figure("{:.2e}", "errors", name) for name in quoted}


def row(cells) -> str:
    """One line of the table; a bar in a label is no border."""
    return "| " + " | ".join(str(cell).replace("|", "\\|").replace("\n", " ") for cell in cells) + " |"


def head(made: dict) -> list[str]:
    """The scene and the parameters it ran with."""
    numbers = " ".join(f"{name}={value}" for name, value in made["parameters"].items())
    return [
        f"# {made['scene']}, t = {made['t_end']:g}",
        "",
        f"Parameters: {numbers or 'none'}; {made['frames']} frames.",
    ]


def foot(made: dict) -> str:
    """The program, the machine and the day: seconds mean nothing without them."""
    day = datetime.datetime.now(datetime.timezone.utc).date()
    threads = f"{made['threads']} thread{'s' if made['threads'] > 1 else ''}, {made['precision']}"
    return f"Made by taichi_spmhd {made['version']} on {hardware()}, {made['arch']}, {threads}, {day}."
