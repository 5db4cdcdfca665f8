"""history_<variant>.csv: one row a frame, on the disk as soon as it is known."""

import os
from pathlib import Path

from ..errors import InputError
from .files import write_text, writing


def begin(path: Path) -> None:
    """An empty history in place of an earlier one."""
    write_text(path, "")


def add(path: Path, row: dict) -> None:
    """Append a row, under a header where the file is empty; numbers are written with all their digits."""
    with writing(path), open(path, "a", encoding="utf-8", newline="") as file:
        if file.tell() == 0:
            file.write(",".join(row) + "\n")
        file.write(",".join(repr(value) for value in row.values()) + "\n")
        file.flush()
        os.fsync(file.fileno())


def cut(path: Path, time: float, rows: int) -> None:
    """Drop rows later than `time`, and one that a kill left unfinished. Raises InputError unless `rows` are left."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines(keepends=True) if path.exists() else []
        kept = [line for line in lines[1:] if line.endswith("\n") and float(line.split(",", 1)[0]) <= time]
    except ValueError:
        kept = []
    if len(kept) != rows:
        raise InputError(f"{path}: {len(kept)} rows are left of {rows}; it was changed: start anew without --resume")
    write_text(path, "".join([*lines[:1], *kept]) if kept else "")
