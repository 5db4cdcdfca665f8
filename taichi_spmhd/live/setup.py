"""What the page may choose: scenes, parameters, parts with their numbers, members to draw. Plain data for JSON."""

import inspect
from functools import lru_cache

from .. import kernels, library, terms
from ..errors import InputError
from ..parameters import parameters
from ..render.colours import palette
from ..render.layout import is_profile
from ..sliding import numbers
from ..terms import Term, XiRule
from .panel import Panel, kind, offered
from .readings import COLUMNS

KERNELS = [kernel.__name__ for kernel in kernels.KERNELS]
SHADES = 33


def setup(session) -> dict:
    """Everything about the present scene; `version` rises whenever some of it changes."""
    scene = session.first.scene
    return {
        "version": session.version,
        **texts(session.path, session.home),
        "scene": session.scene_name,
        "parameters": described_parameters(session),
        "kernels": KERNELS,
        "box": {"lo": scene.box.lo, "hi": scene.box.hi, "dim": scene.dim, "profile": is_profile(scene.box)},
        "device": session.device,
        "t_end": scene.t_end,
        "draw": session.look.described(),
        "palette": shades(session.look.colour_map()),
        "members": session.look.names(session.first.sim),
        "pokes": session.pokes(),
        "columns": list(COLUMNS),
        "panels": [described(panel) for panel in session.panels],
    }


@lru_cache(maxsize=4)
def texts(path, home) -> dict:
    """What the scene files say of themselves: this one, that of the command, and those that ship."""
    there = {home.stem: library.sight(home)} | {entry.name: entry.sight for entry in library.listing()}
    return {
        "title": library.sight(path),
        "about": library.docstring(path),
        "scenes": [{"name": name, "sight": sight} for name, sight in there.items()],
    }


def described_parameters(session) -> list[dict]:
    """Parameters of the scene file with their present values."""
    known = parameters(library.module(session.path).scenes)
    return [
        {"name": p.name, "kind": p.kind.__name__ if p.kind else "str", "value": session.parameters[p.name]}
        | {"choices": list(p.choices)}
        for p in known.values()
    ]


def shades(name: str) -> list[str]:
    """Colours of a map, low to high, as #rrggbb."""
    table = palette(name)
    steps = [round(k * 255 / (SHADES - 1)) for k in range(SHADES)]
    return ["#{:02x}{:02x}{:02x}".format(*table[k]) for k in steps]


def described(panel: Panel) -> dict:
    """One panel: variant, kernel, and its parts; what was said of the same scene is not worked out again."""
    scene = panel.scene
    if panel.words is None or panel.words[0] is not scene:
        panel.words = scene, worded(panel, scene)
    return panel.words[1]


def worded(panel: Panel, scene) -> dict:
    """The same, worked out."""
    there = [entry(term, True, panel) for term in scene.terms]
    return {
        "label": panel.label,
        "variant": panel.variant,
        "variants": list(panel.variants),
        "kernel": kind(scene.kernel),
        "parts": [*there, entry(scene.stepper, True, panel), *(entry(term, False, panel) for term in others(panel))],
    }


def entry(part, on: bool, panel: Panel) -> dict:
    """A part in words, with the numbers that slide and their ranges."""
    part = part.at(panel.scene.dim)
    lines = inspect.cleandoc(type(part).__doc__ or kind(part)).splitlines()
    why = reason(panel.scene, part) if on and isinstance(part, Term) else None
    start = (*panel.variants[panel.variant].terms, panel.scene.stepper)
    begun = {kind(other): numbers(other.at(panel.scene.dim)) for other in start}
    return {
        "name": kind(part),
        "kind": "term" if isinstance(part, Term) else "stepper",
        "on": on,
        "fixed": why is not None or not isinstance(part, Term),
        "why": why,
        "equation": lines[0],
        "advice": "\n".join(lines[1:]).strip(),
        "numbers": [
            {"name": name, "value": value, "start": begun.get(kind(part), {}).get(name, value)}
            | dict(zip(("low", "high"), widened(part.live[name], value), strict=True))
            for name, value in numbers(part).items()
        ],
    }


def widened(limits: tuple[float, float], value: float) -> tuple[float, float]:
    """The range of a slider, with the value the scene has."""
    return min(limits[0], value), max(limits[1], value)


def reason(scene, term) -> str | None:
    """Why a term cannot be switched off, or None if it can."""
    try:
        scene.without(kind(term))
    except InputError as error:
        return str(error)
    return None


def others(panel: Panel) -> list:
    """Terms that could be added: those of the other variants first, then the package's."""
    scene = panel.scene
    names = dict.fromkeys(kind(term) for other in panel.variants.values() for term in other.terms)
    for name in terms.__all__:
        made = getattr(terms, name)
        if inspect.isclass(made) and issubclass(made, Term) and made is not Term and not issubclass(made, XiRule):
            names.setdefault(name)
    found = []
    for name in names:
        if name not in map(kind, scene.terms):
            term = offered(panel.variants, name)
            if fit(scene, term):
                found.append(term)
    return found


def fit(scene, term) -> bool:
    """Whether a scene can have this term, too."""
    try:
        scene.plus(term)
    except InputError:
        return False
    return True
