"""Scene files: finding them, loading them, and saying in one line what is wrong with one.

A scene file is a Python module with a docstring and `scenes(**parameters) -> {label: Scene}`. Loading it runs its code.
"""

import ast
import importlib.util
import linecache
import re
import sys
from functools import lru_cache
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

from .errors import InputError
from .parameters import parameters, settled
from .picture import suggestion
from .scene import Scene
from .scene_code import beside, code_of, compiled

PACKAGE = Path(__file__).resolve().parent
COST = re.compile(r"\babout [^.;,()]*?\b(?:second|minute|hour|min|s|h)s?\b(?: on [^.;,()]*)?", re.IGNORECASE)


class Entry(NamedTuple):
    """A scene that ships: its name, what to see, what it costs, its file."""

    name: str
    sight: str
    cost: str
    path: Path


def shipped() -> dict[str, Path]:
    """The scenes that come with the package, by name: inside it where it is installed, beside it in a checkout."""
    for folder in (PACKAGE / "scenes", PACKAGE.parent / "scenes"):
        if folder.is_dir():
            return {p.stem: p for p in sorted(folder.glob("*.py")) if not p.stem.startswith("_")}
    return {}


def find(scene) -> Path:
    """The file behind a path or a bare name. Raises InputError that names the nearest and lists what there is."""
    text, known = str(scene), shipped()
    if text.endswith(".py") or len(Path(text).parts) != 1:
        if Path(text).is_file():
            return Path(text).resolve()
        near = suggestion(Path(text).stem, known)
        raise InputError(f"no scene file {text}{near}; those that ship: {', '.join(known)}")
    if text in known:
        return known[text]
    own = f"; for the file of this folder write {text}.py" if Path(f"{text}.py").is_file() else ""
    raise InputError(f"no scene {text!r}{suggestion(text, known)}{own}; there are {', '.join(known)}")


def docstring(path: Path) -> str:
    """The docstring of a scene file, read without running it; empty where the file is ill."""
    try:
        return ast.get_docstring(ast.parse(path.read_bytes())) or ""
    except (SyntaxError, ValueError, OSError, RecursionError, MemoryError):
        return ""


def sight(path: Path) -> str:
    """What to see: the first line of the docstring."""
    return (docstring(path).splitlines() or [""])[0].strip()


def listing() -> list[Entry]:
    """The scenes that ship, without loading any."""
    entries = []
    for name, path in shipped().items():
        cost = COST.search(" ".join(docstring(path).split()))
        entries.append(Entry(name, sight(path), cost.group(0) if cost else "", path))
    return entries


@lru_cache(maxsize=64)
def _module(path: Path, stamp: tuple) -> ModuleType:
    name = f"_spmhd_scene_{path.stem}"
    spec = importlib.util.spec_from_file_location(name, path, loader=SourceFileLoader(name, str(path)))
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    linecache.checkcache(str(path))  # Taichi reads the source of terms again
    with code_of(path), beside(path):
        exec(compiled(path), module.__dict__)  # not through a .pyc that may be stale
    if not callable(getattr(module, "scenes", None)):
        raise InputError(f"{path.name} is no scene file: it needs a function scenes(**parameters) -> {{label: Scene}}")
    return module


def module(scene) -> ModuleType:
    """The module of a scene file, run once for each version of the file."""
    path = find(scene)
    try:
        stat = path.stat()
        return _module(path, (stat.st_mtime_ns, stat.st_size))
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}") from error


def parameters_of(scene, **given) -> dict:
    """{name: value} of all parameters of a scene file, defaults where nothing is given."""
    made = module(scene)
    with code_of(Path(made.__file__)):
        return settled(parameters(made.scenes), given, Path(made.__file__).stem)


def load_scene(scene, **given) -> dict[str, Scene]:
    """{label: Scene} of a scene file, or of a scene that ships by its bare name.

    Raises InputError for an unknown scene or parameter, a value of the wrong kind, and whatever the file does wrong.
    """
    values, made = parameters_of(scene, **given), module(scene)
    path = Path(made.__file__)
    with code_of(path), beside(path):
        variants = made.scenes(**values)
    check(path.name, variants)
    return dict(variants)


def slug(label: str) -> str:
    """A label in file names: "/" becomes "-", every other run of characters outside [A-Za-z0-9.+-] becomes "_"."""
    return re.sub(r"[^A-Za-z0-9.+-]+", "_", label.replace("/", "-"))


def check(name: str, variants) -> None:
    """Raises InputError unless variants is {label: Scene} with labels that give different file names."""
    if not isinstance(variants, dict) or not variants:
        raise InputError(f"{name}: scenes() returned {type(variants).__name__}; it must return {{label: Scene}}")
    taken = {}
    for label, variant in variants.items():
        if not isinstance(label, str) or not label.strip() or not isinstance(variant, Scene):
            raise InputError(f"{name}: scenes() returned {label!r}: {type(variant).__name__}; give {{label: Scene}}")
        other = taken.setdefault(slug(label).casefold(), label)
        if other != label:
            raise InputError(f"{name}: the labels {other!r} and {label!r} give one file name {slug(label)}; rename one")
