"""What a battery says: a table of cases and presets, what failed and where, margins."""

from pathlib import Path

from ..outputs.files import write_text, writing
from ..outputs.words import say
from ..replacing import replacing
from . import picture
from .battery import best_of, margin, shown
from .cases import CASES
from .presets import PRESETS
from .trial import FAILED, SOUND, UNSOUND

SIGNS = {SOUND: "green", UNSOUND: "YELLOW", FAILED: "RED"}


def finish(root: Path, rows: list[dict]) -> None:
    """stability.md and stability.png of each precision's whole battery, or of its quick one where that is all."""
    rows = [row for row in rows if row["whole"] or not any(r["whole"] for r in rows if same(r, row))]
    caption = "; ".join(dict.fromkeys(row["made"].rsplit(" ", 2)[0] for row in rows))  # without the time of the day
    write_text(root / "stability.md", markdown(rows, caption))
    with writing(root / "stability.png"), replacing(root / "stability.png") as part:
        picture.draw(rows, caption, part)


def same(one: dict, other: dict) -> bool:
    """Of the same precision."""
    return one["precision"] == other["precision"]


def markdown(rows: list[dict], caption: str) -> str:
    """The tables, one for each precision."""
    out = []
    for precision in dict.fromkeys(row["precision"] for row in rows):
        own = [row for row in rows if row["precision"] == precision]
        out += [f"### {precision}", "", *table(own), "", *troubles(own), ""]
    told = [f"- `{name}`: {PRESETS[name].about}" for name in PRESETS if any(row["preset"] == name for row in rows)]
    return "\n".join([*out, *told, "", f"Made by `spmhd stability`; {caption}.", ""])


def table(rows: list[dict]) -> list[str]:
    """A line a case: parameter and values, each preset's verdicts, the margin of the best, its worst measures."""
    presets = [name for name in PRESETS if any(row["preset"] == name for row in rows)]
    best = best_of(presets)
    head = ["case", "what is made harder", *presets, f"margin ({best})", "energy", "close pairs", "div B"]
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    for name in CASES:
        own = [row for row in rows if row["case"] == name]
        if own:
            kept = [row for row in own if row["preset"] == best]
            asked = [row for row in kept if not row["beyond_asked"]]
            worst = [largest(asked, measure) for measure in ("energy", "close", "div_B")]
            cells = [f"`{name}`: {CASES[name].about}", range_of(asked or own), *(verdicts(own, p) for p in presets)]
            lines.append("| " + " | ".join([*cells, margin(CASES[name], kept), *worst]) + " |")
    return lines


def range_of(rows: list[dict]) -> str:
    """beta = 10 ... 1e-06."""
    values = list(dict.fromkeys(shown(row["value"]) for row in rows if not row["beyond_asked"]))
    return f"{rows[0]['hard']} = {values[0] if len(values) == 1 else f'{values[0]} ... {values[-1]}'}"


def verdicts(rows: list[dict], preset: str) -> str:
    """green where all values are; else which are not."""
    own = [row for row in rows if row["preset"] == preset and not row["beyond_asked"]]
    bad = [f"{SIGNS[row['verdict']]} at {shown(row['value'])}" for row in own if row["verdict"] != SOUND]
    if len(bad) > 2:
        return (
            f"{bad[0]} ... {shown(own[-1]['value'])}" if len(bad) == len(own) else f"{bad[0]} and {len(bad) - 1} more"
        )
    return "" if not own else ", ".join(bad) if bad else "green"


def largest(rows: list[dict], measure: str) -> str:
    """The largest of a measure over rows, in two digits."""
    found = [row[measure] for row in rows if row.get(measure) is not None]
    return f"{max(found):.1e}" if found else ""


def troubles(rows: list[dict]) -> list[str]:
    """Every trial that is not sound: when, where and why."""
    return [f"- {SIGNS[row['verdict']]}: {named(row)}: {why(row)}" for row in rows if row["verdict"] != SOUND]


def named(row: dict) -> str:
    """Case, value and preset."""
    return f"`{row['case']}` at {row['hard']} = {shown(row['value'])}, {row['preset']}"


def why(row: dict) -> str:
    """In words."""
    if row["verdict"] == UNSOUND:
        return "; ".join(row["beyond"])
    return f"at {100 * row['t']:.0f} % of the time, {row.get('why', 'failed')}"


def tell(row: dict, quiet: bool) -> None:
    """One trial, in one line."""
    if quiet:
        return
    what = f"{row['case']} ({row['hard']} = {shown(row['value'])}), {row['preset']}"
    rest = "" if row["verdict"] == SOUND else f": {why(row)}"
    say(f"  {SIGNS[row['verdict']]:6} {what}, {row['steps']} steps, {row['seconds']:.1f} s{rest}")


def summary(rows: list[dict]) -> str:
    """How many are what."""
    asked = [row for row in rows if not row["beyond_asked"]]
    counts = {verdict: sum(row["verdict"] == verdict for row in asked) for verdict in SIGNS}
    return f"{len(asked)} trials: {counts[SOUND]} sound, {counts[UNSOUND]} unsound, {counts[FAILED]} failed"
