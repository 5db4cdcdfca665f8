"""What run.json must be before it is believed: it says which files are a run's own, and those are removed."""

from .files import number
from .plan import MOST_FRAMES, MOVIES


def whole(value) -> bool:
    """A whole number that counts frames."""
    return isinstance(value, int) and not isinstance(value, bool) and 1 <= value <= MOST_FRAMES


def labels(value) -> bool:
    """Names of variants."""
    return isinstance(value, list) and bool(value) and all(isinstance(one, str) for one in value)


MUST = {
    "scene": lambda value: isinstance(value, str) and "/" not in value and "\\" not in value,
    "variants": labels,
    "frames": whole,
    "movie": lambda value: value in MOVIES,
}
MAY = {
    "parameters": lambda value: isinstance(value, dict),
    "t_end": number,
    "errors": lambda value: isinstance(value, dict) and all(isinstance(one, str) for one in value.values()),
    "limits": lambda value: isinstance(value, list) and len(value) == 2 and all(map(number, value)),
    "finished": lambda value: isinstance(value, bool),
}


def sound(record) -> bool:
    """Whether a run of ours can have written this."""
    return (
        isinstance(record, dict)
        and all(name in record and fits(record[name]) for name, fits in MUST.items())
        and all(fits(record[name]) for name, fits in MAY.items() if name in record)
        and set(record.get("errors", ())) <= set(record["variants"])
    )
