"""The grid: what varies, by the command line, the scene file's STUDY, or a rule; all settings, the cheapest first."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import product

from .. import choices
from ..errors import InputError
from ..library import load_scene
from ..outputs.plan import chosen
from ..parameters import Parameter
from ..parameters import read as parameter_value
from ..runtime import PRECISIONS
from ..scene import Scene
from .setting import PLACES, Setting, work

LEVELS = (0.5, 0.7071, 1.0)  # of the scene's own nx, where nobody says more
MOST = 2000  # settings: more is a slip of the pen


def words(given: list[str]) -> dict[str, list[str]]:
    """{name: texts} of --vary NAME=A,B,C."""
    found = {}
    for word in given:
        name, sign, text = (part.strip() for part in word.partition("="))
        values = [part.strip() for part in text.split(",")]
        if not sign or not name or not all(values):
            raise InputError(f"--vary {word}: write NAME=VALUE,VALUE, for example --vary nx=16,32,64")
        if name in found:
            raise InputError(f"--vary: {name} is given twice; put all its values behind one {name}=")
        if len(set(values)) < len(values):
            raise InputError(f"--vary {word}: a value is there twice")
        found[name] = values
    return found


def default(known: dict[str, Parameter]) -> dict[str, list]:
    """Three resolutions up to the scene's own; nothing where it has no nx."""
    nx = known["nx"].default if "nx" in known else None
    return {"nx": [2 * round(nx * level / 2) for level in LEVELS]} if isinstance(nx, int) else {}


def axes(asked: dict, known: dict[str, Parameter], scene: Scene) -> dict[str, list]:
    """{name: values} of the right kinds; a scene's own parameter comes before a choice of the same name."""
    return {name: [value(name, one, known, scene) for one in values] for name, values in asked.items()}


def value(name: str, given, known: dict[str, Parameter], scene: Scene):
    """One value of one axis, from text or from Python. Raises InputError, one line, with the cure."""
    if name in known:
        return parameter_value(known[name], given)
    if name == "precision" and given not in PRECISIONS:
        raise InputError(f"--vary precision={given}: choose of {', '.join(PRECISIONS)}")
    if name == "threads":
        if not (str(given).isdigit() and 1 <= int(given) <= 1024):
            raise InputError(f"--vary threads={given}: give whole numbers from 1 to 1024")
        return int(given)
    return given if name == "precision" else choices.read(scene, name, str(given))


def combinations(varied: dict[str, list]) -> Iterator[dict]:
    """Every choice of one value an axis."""
    for values in product(*varied.values()):
        yield dict(zip(varied, values, strict=True))


def settings(path, fixed: dict, varied: dict[str, list], labels, t_end, place: dict) -> list[Setting]:
    """The product of all axes and variants, cheapest first; fixed: parameters that do not vary; place: precision and
    threads where they do not. Raises InputError for a setting that cannot be built."""
    own = {name: values for name, values in varied.items() if name in fixed}
    rest = {name: values for name, values in varied.items() if name not in own and name not in PLACES}
    places = [{**place, **spot} for spot in combinations({name: varied[name] for name in PLACES if name in varied})]
    found = []
    for parameters in combinations(own):
        scenes = chosen(load_scene(path, **{**fixed, **parameters}), labels, t_end)
        for (label, scene), changes in product(scenes.items(), list(combinations(rest))):
            made = Setting(parameters, changes, label, work=work(choices.applied(scene, changes)))
            found += [replace(made, **spot) for spot in places]
        if len(found) > MOST:
            raise InputError(f"--vary asks for more than {MOST} settings; vary less")
    return sorted(found, key=lambda setting: setting.work)
