"""Parameters of a scene file: what `--set name=value` may change, and how text becomes a number."""

import inspect
import math
import typing
from dataclasses import dataclass
from fractions import Fraction
from numbers import Integral, Real

from .errors import InputError
from .picture import suggestion

LONGEST = 60  # characters of a value in a message
YES, NO = ("true", "yes", "on", "1"), ("false", "no", "off", "0")


@dataclass(frozen=True)
class Parameter:
    """One keyword of scenes(): kind is int, float, bool or str, None where anything goes."""

    name: str
    default: object
    kind: type | None
    choices: tuple = ()


def parameters(scenes) -> dict[str, Parameter]:
    """The keyword parameters of a scenes() function. Raises InputError for one without a default."""
    try:
        hints = typing.get_type_hints(scenes)
    except (NameError, TypeError, AttributeError):  # annotations are a courtesy
        hints = {}
    found = {}
    for name, parameter in inspect.signature(scenes).parameters.items():
        if parameter.kind in (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL):
            continue
        if parameter.default is parameter.empty or parameter.kind is parameter.POSITIONAL_ONLY:
            raise InputError(f"scenes(): give the parameter {name!r} a default, as in scenes({name}=1)")
        found[name] = described(name, parameter.default, hints.get(name))
    return found


def described(name: str, default, hint) -> Parameter:
    """Kind and choices from the default, and from the annotation where there is one."""
    parts = [part for part in (typing.get_args(hint) or (hint,)) if part not in (None, type(None))]
    if typing.get_origin(hint) is typing.Literal:
        return Parameter(name, default, type(parts[0]), tuple(parts))
    kind = type(default) if default is not None else next((part for part in parts if part in READ), None)
    return Parameter(name, default, kind if kind in READ else None)


def settled(known: dict[str, Parameter], given: dict, scene: str) -> dict:
    """Every parameter with its value, text turned into what is expected. Raises InputError, one line, with the cure."""
    for name in given:
        if name not in known:
            there = f"it has {', '.join(known)}" if known else "it has none"
            raise InputError(f"{scene} has no parameter {name!r}{suggestion(name, known)}; {there}")
    return {name: read(p, given[name]) if name in given else p.default for name, p in known.items()}


def read(parameter: Parameter, value):
    """The value of a parameter, from text or from Python."""
    example = f"for example {parameter.name}={parameter.default}"
    if value is None and parameter.default is None:
        return None
    try:
        value = READ.get(parameter.kind, anything)(value)
    except (ValueError, TypeError, ZeroDivisionError, OverflowError) as error:
        raise InputError(f"{parameter.name}={shown(value)}: expected {WHAT[parameter.kind]}, {example}") from error
    if parameter.choices and value not in parameter.choices:
        names = ", ".join(map(str, parameter.choices))
        near = suggestion(str(value), map(str, parameter.choices))
        raise InputError(f"{parameter.name}={shown(value)}: expected one of {names}{near}")
    return value


def shown(value) -> str:
    """A value as a message shows it: of one line and no longer than needed to know it again."""
    text = str(value)
    text = text if text.isprintable() else repr(text)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."


def whole(value) -> int:
    """A whole number; 3.5 is none."""
    if isinstance(value, bool) or not isinstance(value, (str, Integral)):
        raise TypeError
    return int(value)


def number(value) -> float:
    """A finite number: 0.5, 1e-3, 1/2."""
    if isinstance(value, bool) or not isinstance(value, (str, Real)):
        raise TypeError
    value = float(Fraction(value)) if isinstance(value, str) and "/" in value else float(value)
    if not math.isfinite(value):
        raise ValueError
    return value


def truth(value) -> bool:
    """true or false."""
    if isinstance(value, bool):
        return value
    text = str(value).lower()
    if text not in YES + NO:
        raise ValueError
    return text in YES


def word(value) -> str:
    """Text."""
    if not isinstance(value, str):
        raise TypeError
    return value


def anything(value):
    """A number where the text is one, else the text as it is."""
    for reader in (whole, number):
        try:
            return reader(value)
        except (ValueError, TypeError, ZeroDivisionError):
            continue
    return value


READ = {int: whole, float: number, bool: truth, str: word}
WHAT = {int: "a whole number", float: "a number", bool: "true or false", str: "a word", None: "a value"}
