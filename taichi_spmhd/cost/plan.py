"""Plan: what `spmhd cost` was asked to measure, checked before anything is computed."""

import hashlib
import os
from dataclasses import dataclass
from pathlib import Path

from .. import library
from ..errors import InputError
from ..outputs.files import plain
from ..outputs.plan import chosen
from ..parameters import parameters, settled
from ..scene import Scene
from ..study import Anchor, Study
from . import grid
from .setting import Setting

REPEAT = 3  # runs of every setting, of which the median counts


@dataclass(frozen=True, eq=False)
class Plan:
    """fixed: the scene's parameters, those that vary at their defaults; varied: {name: values}; error: the member to
    quote, None for the first there is; settings: cheapest first."""

    path: Path
    fixed: dict
    varied: dict[str, list]
    labels: list[str]
    settings: list[Setting]
    error: str | None
    anchors: tuple[Anchor, ...]
    t_end: float
    dim: int
    arch: str = "cpu"
    repeat: int = REPEAT
    budget: float | None = None

    @property
    def name(self) -> str:
        return self.path.stem

    @property
    def level(self) -> str | None:
        """The axis of resolution: nx, or else the first parameter of the scene that varies in numbers."""
        numeric = [n for n, v in self.varied.items() if n in self.fixed and len(v) > 1 and number(v[0])]
        return "nx" if "nx" in numeric else next(iter(numeric), None)

    @property
    def telling(self) -> list[str]:
        """Names in which the settings differ, the resolution last."""
        values = {name: {repr(s.values().get(name)) for s in self.settings} for name in self.settings[0].values()}
        return sorted((name for name, there in values.items() if len(there) > 1), key=lambda name: name == self.level)

    def rank(self, values: dict) -> list[int]:
        """Where a setting stands among all, by the order in which its values were given."""
        axes = {"variant": self.labels, **self.varied}
        return [axes[name].index(values[name]) for name in self.telling if name in axes]

    def order(self, setting: Setting) -> dict:
        """What a worker needs to know; a scene that ships goes by its name, another machine has it elsewhere."""
        own = {"parameters": {**self.fixed, **setting.parameters}, "changes": setting.changes}
        place = {"precision": setting.precision, "threads": setting.threads}
        return {
            "path": self.name if self.path in library.shipped().values() else str(self.path),
            **own,
            "variant": setting.variant,
            "t_end": self.t_end,
            "key": setting.key,
            **place,
        }

    def record(self) -> dict:
        """What --resume compares."""
        return plain(
            {
                "scene": self.name,
                "scene file": hashlib.sha256(self.path.read_bytes()).hexdigest(),
                "parameters": self.fixed,
                "vary": self.varied,
                "variants": self.labels,
                "t_end": self.t_end,
                "arch": self.arch,
                "places": sorted({f"{s.precision}, {s.threads}" for s in self.settings}),
            }
        )


def number(value) -> bool:
    """Whether it is one."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def study_of(path: Path) -> Study:
    """The STUDY of a scene file, an empty one where it has none."""
    study = getattr(library.module(path), "STUDY", None) or Study()
    if not isinstance(study, Study):
        raise InputError(f"{path.name}: STUDY must be a Study(...), not {type(study).__name__}")
    return study


def planned(scene, given: dict, vary: list[str], labels, error, t_end, **rest) -> Plan:
    """The plan of a command line; rest: arch, precision, threads, repeat, budget. Raises InputError."""
    path = library.find(scene)
    known, study = parameters(library.module(path).scenes), study_of(path)
    fixed = settled(known, given, path.stem)
    asked = grid.words(vary) or {n: v for n, v in study.vary.items() if n not in given} or grid.default(known)
    clash = next((name for name in asked if name in given), None)
    if clash:
        raise InputError(f"{clash} is given by --set and varies as well; leave one of them out")
    labels = labels or list(study.variants) or None
    scenes = chosen(library.load_scene(path, **fixed), labels, t_end)
    first = next(iter(scenes.values()))
    varied = grid.axes(asked, known, first)
    varied = {name: sorted(values) if all(map(number, values)) else values for name, values in varied.items()}
    place = {"precision": rest["precision"], "threads": rest["threads"] or os.cpu_count() or 1}
    return Plan(
        path=path,
        fixed=fixed,
        varied=varied,
        labels=list(scenes),
        settings=grid.settings(path, fixed, varied, list(scenes), t_end, place),
        error=error or study.error or first.measure,
        anchors=study.anchors if comparable(study, error, t_end) else (),
        t_end=float(first.t_end),
        dim=first.dim,
        arch=rest["arch"],
        **checked(rest),
    )


def single(scene, given: dict, labels, **place) -> tuple[Plan, Scene]:
    """A scene as it is, in one variant (the last unless named), and that variant; place: arch, precision, threads."""
    path = library.find(scene)
    fixed = settled(parameters(library.module(path).scenes), given, path.stem)
    label, one = list(chosen(library.load_scene(path, **fixed), labels).items())[-1]
    setting = Setting({}, {}, label, place["precision"], place["threads"])
    own = {"path": path, "fixed": fixed, "varied": {}, "labels": [label], "settings": [setting], "error": None}
    return Plan(**own, anchors=(), t_end=float(one.t_end), dim=one.dim, arch=place["arch"]), one


def comparable(study: Study, error, t_end) -> bool:
    """Whether the anchors are about what is measured."""
    return t_end is None and error in (None, study.error)


def checked(rest: dict) -> dict:
    """repeat and budget, in bounds."""
    repeat, budget = REPEAT if rest["repeat"] is None else rest["repeat"], rest["budget"]
    if not 1 <= repeat <= 100:
        raise InputError(f"--repeat {repeat}: give a whole number from 1 to 100")
    if budget is not None and not 0 < budget < float("inf"):
        raise InputError(f"--budget {budget:g}: give seconds, for example --budget 120")
    return {"repeat": repeat, "budget": budget}


def measurable(plan: Plan) -> None:
    """Raises InputError where there is nothing to compare with."""
    scenes = chosen(library.load_scene(plan.path, **plan.fixed), plan.labels, plan.t_end).values()
    if all(scene.exact is None and scene.reference is None for scene in scenes):
        raise InputError(
            f"{plan.name} has neither an exact solution nor a stored map, so there is no error to set beside the "
            "seconds; give its file exact= or reference=, or ask for its price list with --effects"
        )
