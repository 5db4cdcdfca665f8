"""Scans: parameters of a scene, or its choices (choices.py), over ranges or lists; every combination of them."""

from itertools import product
from pathlib import Path

import numpy as np

from .. import choices
from ..errors import InputError
from ..library import load_scene, module
from ..outputs.plan import chosen
from ..parameters import Parameter, parameters, read
from ..scene import Scene

MOST = 10_000  # combinations: more is a slip of the pen
WIDE = 100.0  # ratio of the ends from which a range is divided evenly in the logarithm
EXAMPLE = "write NAME=FROM:TO:COUNT or NAME=A,B,C, for example --scan xi=0:1:21"


class Scan:
    """scanned: {name: values}; given: the parameters of --set; wanted: labels of variants, all where None.

    A name is a parameter of the scene, or else kernel, stepper, cleaning, a term or a term's number as in `cost`. What
    has a single value is set, not scanned: it does not count among `varied`.
    """

    def __init__(self, path: Path, given: dict, words: list[str], wanted=None):
        self.path, self.given, self.wanted = path, given, wanted
        self.known = parameters(module(path).scenes)
        loaded = load_scene(path, **given)  # what is wrong shows before anything is computed
        scene = next((loaded[label] for label in loaded if label in (wanted or loaded)), next(iter(loaded.values())))
        self.scanned = ranges(words, self.known, scene)
        for name in set(self.scanned) & set(given):
            raise InputError(f"--set and --scan: {name} is in both; leave it out of one of them")
        self.varied = {name: values for name, values in self.scanned.items() if len(values) > 1}
        if not self.varied:
            self.variants(self.points()[0])

    def points(self) -> list[dict]:
        """Every choice of one value of each name, the last varying fastest."""
        return [dict(zip(self.scanned, values, strict=True)) for values in product(*self.scanned.values())]

    def variants(self, point: dict) -> dict[str, Scene]:
        """The variants at a point; in a scan, labels that come and go with a parameter are no mistake."""
        own = {name: value for name, value in point.items() if name in self.known}
        changes = {name: value for name, value in point.items() if name not in own}
        loaded = load_scene(self.path, **{**self.given, **own})
        if self.varied and self.wanted:
            kept = {label: scene for label, scene in loaded.items() if label in self.wanted}
        else:
            kept = chosen(loaded, self.wanted)
        return {label: choices.applied(scene, changes) for label, scene in kept.items()}


def ranges(given: list[str], known: dict[str, Parameter], scene: Scene) -> dict[str, list]:
    """{name: values} of --scan. Raises InputError for what can be changed in no way, or is no range."""
    found = {}
    for text in given:
        name, sign, rest = (part.strip() for part in text.partition("="))
        if not sign or not name or not rest:
            raise InputError(f"--scan {text}: {EXAMPLE}")
        if name in found:
            raise InputError(f"--scan: {name} is given twice")
        words = divided(text, rest) if ":" in rest else [part.strip() for part in rest.split(",")]
        found[name] = list(dict.fromkeys(value(name, word, known, scene) for word in words))
    if np.prod([len(each) for each in found.values()], dtype=float) > MOST:
        raise InputError(f"--scan asks for more than {MOST} combinations; take fewer values")
    return found


def value(name: str, word, known: dict[str, Parameter], scene: Scene):
    """One value, of the kind that its name wants."""
    if name not in known:
        return choices.read(scene, name, str(word), "--scan")
    return read(known[name], round(word) if known[name].kind is int and isinstance(word, float) else word)


def divided(text: str, rest: str) -> list[float]:
    """FROM:TO:COUNT evenly, or evenly in the logarithm where both ends are positive and far apart."""
    try:
        low, high, count = rest.split(":")
        low, high, count = float(low), float(high), int(count)
    except ValueError:
        raise InputError(f"--scan {text}: {EXAMPLE}") from None
    if not (np.isfinite([low, high]).all() and low != high and 2 <= count <= MOST):
        raise InputError(f"--scan {text}: give two different ends and a count from 2; {EXAMPLE}")
    far = min(low, high) > 0 and max(low, high) >= WIDE * min(low, high)
    # twelve digits: nobody means 0.30000000000000004
    return [float(f"{x:.12g}") for x in (np.geomspace if far else np.linspace)(low, high, count)]
