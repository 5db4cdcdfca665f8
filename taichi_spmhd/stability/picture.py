"""The picture of a battery: a line a case, a column a preset, a square a value from easy to hard; and xi over beta."""

from ..outputs.figure import finished, sheet
from .battery import shown
from .cases import CASES
from .presets import PRESETS
from .trial import FAILED, SOUND, UNSOUND

COLOURS = {SOUND: "#3a9b57", UNSOUND: "#e8b73a", FAILED: "#c0392b"}


def draw(rows: list[dict], caption: str, path) -> None:
    """Squares framed in black are harder than what is asked."""
    precisions = list(dict.fromkeys(row["precision"] for row in rows))
    columns = [(q, p) for q in precisions for p in PRESETS if any(key(row) == (q, p) for row in rows)]
    names = [name for name in CASES if any(row["case"] == name for row in rows)]
    figure, canvas = sheet(2.6 + 4.0 * len(columns), 1.2 + 0.42 * len(names))
    for axes, column in zip(figure.subplots(1, len(columns), squeeze=False)[0], columns, strict=True):
        for line, name in enumerate(names):
            squares(axes, line, [row for row in rows if row["case"] == name and key(row) == column])
        labelled(axes, names, column, first=column == columns[0])
    finished(figure, canvas, "Hard cases: sound (green), unsound (yellow), failed (red)", caption, path)


def key(row: dict) -> tuple[str, str]:
    """The column of a row."""
    return row["precision"], row["preset"]


def squares(axes, line: int, rows: list[dict]) -> None:
    """One line: the values from left to right, easy to hard."""
    for place, row in enumerate(rows):
        edge = {"edgecolor": "black" if row["beyond_asked"] else "white", "linewidth": 1.2}
        axes.bar(place, 0.8, 0.94, bottom=line - 0.4, color=COLOURS[row["verdict"]], **edge)
        axes.text(place, line, shown(row["value"])[:9], ha="center", va="center", fontsize=6, color="white")


def labelled(axes, names: list[str], column: tuple, first: bool) -> None:
    """Cases beside the first column, the preset on top."""
    most = max(len(CASES[name].values) + len(CASES[name].beyond) for name in names)
    axes.set(xlim=(-0.6, most - 0.4), ylim=(len(names) - 0.5, -0.5), xticks=[])
    words = [f"{name} ({CASES[name].hard})" for name in names] if first else [""] * len(names)
    axes.set_yticks(range(len(names)), words, fontsize=8)
    axes.set_title(f"{column[1]}, {column[0]}", fontsize=10)
    axes.spines[:].set_visible(False)
    axes.tick_params(length=0)
