"""The record of a battery: stability.json, a row a trial, whole after every one; later trials replace earlier ones."""

from pathlib import Path

from ..errors import InputError
from ..machine import machine, words
from ..outputs.files import as_json, folder_at, make, plain, read_json, write_text
from .cases import CASES
from .presets import PRESETS
from .trial import FAILED, SOUND, UNSOUND

KEY = ("case", "value", "preset", "whole", "precision")
WORDS = {"verdict": (SOUND, UNSOUND, FAILED), "whole": (True, False), "beyond_asked": (True, False)}


class Record:
    """Rows in the order in which they were first made; trials of another precision or preset stand beside them."""

    def __init__(self, root, precision: str):
        self.root, self.precision = folder_at(root), precision
        self.rows = earlier(self.path)

    @property
    def path(self) -> Path:
        return self.root / "stability.json"

    def add(self, row: dict) -> None:
        """One more, on the disk when this returns."""
        row = plain({**row, "precision": self.precision, "made": words(machine())})
        same = [n for n, other in enumerate(self.rows) if key(other) == key(row)]
        if same:
            self.rows[same[0]] = row
        else:
            self.rows.append(row)
        make(self.root)
        write_text(self.path, as_json({"rows": self.rows}))


def whole(row) -> bool:
    """Whether a row has what tables and pictures ask of it."""
    names = {*KEY, *WORDS, "hard", "beyond", "t", "made"}
    if not isinstance(row, dict) or not names <= set(row) or row["case"] not in CASES or row["preset"] not in PRESETS:
        return False
    return all(row[name] in words for name, words in WORDS.items()) and isinstance(row["beyond"], list)


def key(row: dict) -> tuple:
    """What two trials of the same thing share."""
    return tuple(row.get(name) for name in KEY)


def earlier(path: Path) -> list[dict]:
    """The rows that are there. Raises InputError where the file is not one of a battery."""
    if not path.exists():
        return []
    found = read_json(path)
    rows = found.get("rows") if isinstance(found, dict) else None
    if not isinstance(rows, list) or not all(map(whole, rows)):
        raise InputError(f"{path}: not the record of a battery, or damaged; remove it or choose another folder")
    return rows
