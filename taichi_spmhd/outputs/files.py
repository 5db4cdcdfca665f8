"""Writing files whole or not at all; a disk that refuses is the user's to mend, in one line."""

import errno
import json
import math
from contextlib import contextmanager
from pathlib import Path

from ..errors import InputError
from ..replacing import replacing

FULL = {errno.ENOSPC, getattr(errno, "EDQUOT", errno.ENOSPC)}
CLOSED = {errno.EROFS, errno.EACCES, errno.EPERM}


@contextmanager
def writing(path):
    """OSError becomes InputError: which file, why, the cure. What was written before stays."""
    try:
        yield
    except OSError as error:
        raise InputError(f"cannot write {path}: {cure(error)}") from error


def cure(error: OSError) -> str:
    """Why the disk refused and what to do about it."""
    if error.errno in FULL:
        return "the disk is full; free some space and go on with --resume, or choose another folder with --out"
    if error.errno in CLOSED:
        return "the folder is not writable; choose another with --out"
    return f"{error.strerror or error}; choose another folder with --out"


def folder_at(out) -> Path:
    """A path for a folder. Raises InputError where a file is in its way."""
    out = Path(out)
    for part in (out, *out.parents):
        if part.exists() and not part.is_dir():
            raise InputError(f"--out {out}: {part} is a file; give a folder")
    return out


def make(folder: Path) -> None:
    """Make a folder and those above it, where they are not there yet."""
    with writing(folder):
        folder.mkdir(parents=True, exist_ok=True)


def write_text(path: Path, text: str) -> None:
    """Replace a text file in one piece; it is on the disk when this returns."""
    with writing(path), replacing(path) as part:
        put(part, text)


def put(path: Path, text: str) -> None:
    """Write a text file; `replacing` waits for the disk."""
    with open(path, "w", encoding="utf-8", newline="\n") as file:
        file.write(text)


def as_json(value) -> str:
    """JSON text with plain numbers; what is not finite becomes null."""
    return json.dumps(plain(value), indent=1) + "\n"


def plain(value):
    """Python numbers, strings, lists and dicts from numpy ones and tuples."""
    if isinstance(value, dict):
        return {str(name): plain(part) for name, part in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(part) for part in value]
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value if isinstance(value, (str, int, float, bool, type(None))) else str(value)


def read_json(path: Path):
    """What a JSON file holds, or None where there is no such file or it is no JSON."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return None


def number(value) -> bool:
    """Whether a value from a file is a finite number."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < float("inf")
