"""The present settings as a scene file: what somebody found by sliding, to be run again."""

from dataclasses import fields
from pathlib import Path

from .. import kernels, stepper, terms
from ..library import shipped
from ..scene import Scene
from ..sliding import numbers
from .panel import Panel, kind

HEAD = '''"""{title}

Settings found in the sandbox, {where}. Run it with `spmhd run` and the name of this file.
"""
'''


def script(path: Path, parameters: dict, panels: list[Panel], picture, title: str) -> str:
    """A scene file whose variants are the panels as they are set now, from the scene's start."""
    edits = {panel.label: edited(panel) for panel in panels}
    shown = replaced(picture)
    words = " ".join(edits.values()) + shown
    given = ", ".join(f"{name}={value!r}" for name, value in parameters.items())
    passed = "".join(f", {name}={name}" for name in parameters)
    known = shipped().get(path.stem) == path
    lines = [HEAD.format(title=title or path.stem, where=f"{path.stem}.py" if known else path.name)]
    lines += imports(words)
    lines += ["", "", f"def scenes({given}):", '    """The scene as it was set."""']
    lines += [f"    variants = load_scene({path.stem if known else str(path)!r}{passed})", f"    picture = {shown}"]
    lines += ["    return {"]
    for panel in panels:
        name = f"{panel.label}: {panel.variant}" if len(panels) > 1 else panel.variant
        lines += [f"        {name!r}: variants[{panel.variant!r}]{edits[panel.label]}.but(picture=picture),"]
    return "\n".join([*lines, "    }", ""])


def imports(words: str) -> list[str]:
    """The import lines for the class names in a text."""
    own = [name for module in (kernels, stepper) for name in vars(module) if name[:1].isupper()]
    names = sorted({name for name in own if f"{name}(" in words} | {"Picture", "load_scene"})
    listed = sorted(name for name in terms.__all__ if f"{name}(" in words)
    extra = [f"from taichi_spmhd.terms import {', '.join(listed)}"] if listed else []
    return [f"from taichi_spmhd import {', '.join(names)}", *extra]


def edited(panel: Panel) -> str:
    """The calls that lead from the variant to the panel's scene."""
    old, new = panel.variants[panel.variant], panel.scene
    gone = [kind(term) for term in old.terms if kind(term) not in map(kind, new.terms)]
    calls = [f".without({', '.join(map(repr, gone))})"] if gone else []
    for term in new.terms:
        before = next((other for other in old.terms if kind(other) == kind(term)), None)
        if before is None:
            calls.append(f".plus({replaced(term)})")
        elif numbers(term) != numbers(before):
            changed = {k: v for k, v in numbers(term).items() if numbers(before).get(k) != v}
            calls.append(f".tuned({kind(term)!r}, {', '.join(f'{k}={v!r}' for k, v in changed.items())})")
    return "".join([*calls, *choices(old, new)])


def choices(old: Scene, new: Scene) -> list[str]:
    """Kernel and stepper where they are others."""
    changed = {name: getattr(new, name) for name in ("kernel", "stepper") if getattr(new, name) != getattr(old, name)}
    return [f".but({', '.join(f'{name}={replaced(value)}' for name, value in changed.items())})"] if changed else []


def replaced(part) -> str:
    """A dataclass as Python writes it, without what is the default."""
    values = [(f, getattr(part, f.name)) for f in fields(part) if f.init]
    given = [f"{f.name}={value!r}" for f, value in values if value != f.default]
    return f"{type(part).__name__}({', '.join(given)})"
