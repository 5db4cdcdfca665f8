"""The file of a state, read and checked for what can be checked: nothing of it is believed that would not be used."""

import numpy as np

from .errors import InputError

FORMAT = 2  # 2: the largest h at the start, and the step at the last look
NUMBERS = ("time", "dt", "longest", "seconds", "seconds_compile")
COUNTS = ("steps", "timed", "floors")
LEDGER = ("E0", "v_rms", "widest", "before")  # what energy, momentum and the watch go by
TEXTS = {"precision": 0, "scene": 0, "columns": 1}  # axes of each
SIGNED = ("E0", "used")  # what may be below 0
CURE = "remove it and start anew without --resume"


class Lost(InputError):
    """A state that is not there, or not whole."""


def read(path) -> dict[str, np.ndarray]:
    """All arrays of the file, checked for what can be checked without a scene."""
    try:
        with np.load(path, allow_pickle=False) as file:
            saved = {name: file[name] for name in file.files}
        version, table = int(saved["format"]), saved["table"]
        whole = table.ndim == 2 and np.array_equal(np.sort(saved["ids"]), np.arange(len(table)))
        if any(saved[name].dtype.kind != "U" or saved[name].ndim != axes for name, axes in TEXTS.items()):
            raise ValueError("no text")
    except FileNotFoundError as error:
        raise Lost(f"{path}: there is no such state; leave out --resume to start anew") from error
    except Exception as error:  # a wrong byte can come up in any layer: archive, compression, header, array
        raise Lost(f"{path}: not a state of a run, or damaged; {CURE}") from error
    if version != FORMAT:
        raise InputError(f"{path}: state format {version}, this version reads {FORMAT}; start anew without --resume")
    bad = [name for name, values in saved.items() if values.dtype.kind == "f" and not np.isfinite(values).all()]
    if bad or not whole:
        what = f"{bad[0]} is not finite" if bad else "particles are missing or double"
        raise Lost(f"{path}: {what}; {CURE}")
    return saved


def check_alike(path, saved: dict, wanted: dict[str, np.ndarray]) -> None:
    """Raises Lost unless the file has all of these arrays, in this shape and precision."""
    for name, like in wanted.items():
        if name not in saved:
            raise Lost(f"{path}: {name} is missing; {CURE}")
        found = saved[name]
        if found.shape != like.shape or found.dtype != like.dtype:
            raise Lost(f"{path}: {name} is {found.dtype} {found.shape}, not {like.dtype} {like.shape}; {CURE}")


def number(path, saved: dict, name: str) -> float | int:
    """One number of the file. Raises Lost where it is none."""
    found = saved.get(name)
    if found is None or found.shape or found.dtype.kind not in "iuf" or (found < 0 and name not in SIGNED):
        raise Lost(f"{path}: {name} is no number that a run can have; {CURE}")
    return found.item()
