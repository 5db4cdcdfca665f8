"""What may be changed in any scene beside its parameters: its choices, its terms and their numbers.

kernel=cubic,quintic   stepper=leapfrog,heun   cleaning=none,constant   cour=0.3,0.15   h_fact=1.2,1.5
Conductivity=on,off    DivBSource.xi=0,0.5
"""

from dataclasses import fields, replace

from .errors import InputError
from .kernels import CubicSpline, Gaussian, QuinticSpline, WendlandC2, WendlandC4, WendlandC6
from .parameters import number, truth
from .picture import suggestion
from .scene import Scene
from .stepper import SSPRK3, Heun, LeapfrogKDK
from .terms import Cleaning, ConstantCleaning, TriccoPrice2012

KERNELS = {
    "cubic": CubicSpline,
    "quintic": QuinticSpline,
    "wendland_c2": WendlandC2,
    "wendland_c4": WendlandC4,
    "wendland_c6": WendlandC6,
    "gaussian": Gaussian,
}
STEPPERS = {"leapfrog": LeapfrogKDK, "heun": Heun, "ssprk3": SSPRK3}
CLEANINGS = {"none": None, "constant": ConstantCleaning, "tricco_2012": TriccoPrice2012, "tricco_2016": Cleaning}
NAMED = {"kernel": KERNELS, "stepper": STEPPERS, "cleaning": CLEANINGS}
NUMBERS = {
    "cour": "stepper",
    "force": "stepper",
    "cool": "stepper",
    "h_fact": "kernel",
}  # the choice whose number it is


def known(scene: Scene) -> list[str]:
    """Every name that may vary in this scene."""
    terms = [type(term).__name__ for term in scene.terms]
    numbers = [f"{type(t).__name__}.{f.name}" for t in scene.terms for f in fields(t) if isinstance(value(t, f), float)]
    return [*NAMED, *NUMBERS, *terms, *numbers]


def value(term, field):
    """The present value of a term's field."""
    return getattr(term, field.name)


def read(scene: Scene, name: str, text: str, option: str = "--vary"):
    """A value from text: a word of the choice, a number, or on and off. Raises InputError, one line, with the cure.

    option: the one that asked, for that line.
    """
    if name in NAMED:
        if text not in NAMED[name]:
            near = suggestion(text, NAMED[name])
            raise InputError(f"{option} {name}={text}: no such {name}{near}; there are {', '.join(NAMED[name])}")
        return text
    if name not in known(scene):
        raise InputError(f"{option} {name}: nothing of that name{suggestion(name, known(scene))}; see --help")
    whole = name in NUMBERS or "." in name
    try:
        return number(text) if whole else truth(text)
    except (ValueError, ZeroDivisionError) as error:
        cure = "give a number" if whole else "give on or off"
        raise InputError(f"{option} {name}={text}: {cure}") from error


def applied(scene: Scene, changes: dict) -> Scene:
    """The scene with every choice made. Raises InputError where a part refuses its number."""
    gone = [name for name, value in changes.items() if value is False]
    scene = scene.without(*gone) if gone else scene  # at once: what is left on the way need not be a scene
    for name in sorted(set(changes) - set(gone), key=order):
        scene = change(scene, name, changes[name])
    return scene


def order(name: str) -> bool:
    """Numbers last: they belong to what was chosen."""
    return name in NUMBERS or "." in name


def change(scene: Scene, name: str, value) -> Scene:
    """The scene with one choice made."""
    if name == "kernel":
        return scene.but(kernel=KERNELS[value]())
    if name == "stepper":
        return scene.but(stepper=STEPPERS[value]())
    if name == "cleaning":
        bare = scene.without(*(kind for kind in CLEANINGS.values() if kind))
        return bare.plus(CLEANINGS[value]()) if CLEANINGS[value] else bare
    if name in NUMBERS:
        choice = NUMBERS[name]
        return scene.but(**{choice: replace(getattr(scene, choice), **{name: value})})
    if "." in name:
        term, _, what = name.partition(".")
        return scene.tuned(term, **{what: value})
    return scene  # a term that stays on
