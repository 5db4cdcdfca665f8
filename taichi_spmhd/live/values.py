"""What a single value in a wish may be: each check returns the value, or raises InputError with one line that cures.

A check is a function of (key, value, setup); the ones with bounds or words are made by functions.
"""

import math
from collections.abc import Callable

from ..errors import InputError

MOST_TEXT = 200  # characters


def shown(value) -> str:
    """A value in a message: short, whatever it is."""
    text = repr(value)
    return text if len(text) <= 40 else text[:37] + "..."


def number(low: float, high: float) -> Callable:
    """A finite number within bounds."""

    def check(key: str, value, setup: dict) -> float:
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not low <= value <= high:
            raise InputError(f"{key}: {shown(value)} must be a number from {low:g} to {high:g}")
        return float(value)

    return check


def one_of(*words) -> Callable:
    """One of these words."""

    def check(key: str, value, setup: dict):
        if not isinstance(value, str) or value not in words:
            raise InputError(f"{key}: {shown(value)} must be one of {', '.join(words)}")
        return value

    return check


def listed(words: Callable) -> Callable:
    """One of the words the setup lists."""
    return lambda key, value, setup: one_of(*words(setup))(key, value, setup)


def truth(key: str, value, setup: dict) -> bool:
    if not isinstance(value, bool):
        raise InputError(f"{key}: {shown(value)} must be true or false")
    return value


def text(key: str, value, setup: dict) -> str:
    if not isinstance(value, str) or not 0 < len(value) <= MOST_TEXT:
        raise InputError(f"{key}: {shown(value)} must be a word of at most {MOST_TEXT} letters")
    return value


def whole(low: int, high: int) -> Callable:
    """A whole number within bounds."""

    def check(key: str, value, setup: dict) -> int:
        if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
            raise InputError(f"{key}: {shown(value)} must be a whole number from {low} to {high}")
        return value

    return check


def panel(key: str, value, setup: dict) -> int:
    return whole(0, len(setup["panels"]) - 1)(key, value, setup)


def axis(key: str, value, setup: dict) -> int | None:
    return None if value is None else whole(0, 2)(key, value, setup)


def limits(key: str, value, setup: dict) -> list[float] | None:
    """Two finite numbers that rise, or null."""
    if value is None:
        return None
    if not isinstance(value, list) or len(value) != 2:
        raise InputError(f"{key}: {shown(value)} must be null or two numbers")
    low, high = (number(-1e30, 1e30)(key, one, setup) for one in value)
    if not low < high:
        raise InputError(f"{key}: {shown(value)} must rise")
    return [low, high]


def parameters(key: str, value, setup: dict) -> dict:
    """{name: value} of the scene's parameters; whether they suit, the scene says."""
    if not isinstance(value, dict) or len(value) > 64:
        raise InputError(f"{key}: give an object of parameters")
    for name, one in value.items():
        plain = isinstance(one, (bool, int, str)) or (isinstance(one, float) and math.isfinite(one)) or one is None
        if len(name) > MOST_TEXT or not plain or len(str(one)) > MOST_TEXT:
            raise InputError(f"{key}: {shown(name)} = {shown(one)} must be a number or a short word")
    return value


def radius(key: str, value, setup: dict) -> float:
    size = max(high - low for low, high in zip(setup["box"]["lo"], setup["box"]["hi"], strict=True))
    return number(1e-6 * size, size)(key, value, setup)


def place(a: int) -> Callable:
    """A coordinate within the box or near it."""

    def check(key: str, value, setup: dict) -> float:
        lo, hi = (setup["box"][end][min(a, setup["box"]["dim"] - 1)] for end in ("lo", "hi"))
        return number(lo - (hi - lo), hi + (hi - lo))(key, value, setup)

    return check
