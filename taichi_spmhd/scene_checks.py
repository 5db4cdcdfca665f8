"""The checks at the door of a scene: what cannot be simulated is refused with the cure, before anything is built."""

from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from .boundary import Boundary
from .density import Summation
from .energy import Energy
from .errors import InputError
from .godunov.between import BETWEEN
from .guard import Guard
from .kernels import Kernel
from .stepper import Stepper
from .terms import Choice, Part

if TYPE_CHECKING:
    from .scene import Scene

KINDS = {
    "eos": Choice,
    "density": Summation,
    "energy": Energy,
    "stepper": Stepper,
    "kernel": Kernel,
    "boundary": Boundary,
    "guard": Guard,
}


def check_kinds(scene: "Scene") -> None:
    """Choices are instances of their kind, terms a tuple, start a function."""
    for name, kind in KINDS.items():
        if not isinstance(getattr(scene, name), kind):
            raise InputError(
                f"Scene: {name} = {getattr(scene, name)!r}; give an instance, for example {EXAMPLES[name]}"
            )
    if isinstance(scene.terms, Part) or not isinstance(scene.terms, tuple | list):
        raise InputError(f"Scene: terms = {scene.terms!r}; give a tuple, for example (Pressure(), Viscosity())")
    if not callable(scene.start):
        raise InputError("Scene: start must be a function of the positions that returns a dict")


def numbers(positions) -> np.ndarray:
    """Positions as an array of floats."""
    try:
        return np.ascontiguousarray(positions, dtype=float)
    except (TypeError, ValueError) as error:
        raise InputError("Scene: positions must be an array of numbers (N, d)") from error


EXAMPLES = {
    "eos": "Adiabatic(5 / 3)",
    "density": "SumMass()",
    "energy": "Thermal()",
    "stepper": "LeapfrogKDK()",
    "kernel": "CubicSpline()",
    "boundary": "Boundary(x=Periodic())",
    "guard": "Guard(drift=0.05)",
}
GIVEN = {"x", "v", "m", "h", "rho", "Omega"}  # members every particle has
CURES = {
    "B": "list Induction() (Stress and everything magnetic need an evolved field)",
    "u": "use eos=Adiabatic(gamma): an isothermal gas has no thermal energy",
    "vw": "list Pressure() or, with a magnetic field, Stress()",
    "Pt": "list Stress(), whose pull it answers",
}


def check(scene: "Scene") -> None:
    """Raises InputError, with the cure, for a scene that cannot be simulated."""
    if scene.positions.ndim != 2 or scene.dim != scene.box.dim:
        raise InputError(
            f"positions of shape {scene.positions.shape} do not fit a {scene.box.dim}-D box: give (N, {scene.box.dim})"
        )
    if len(scene.positions) == 0:
        raise InputError("positions: there are no particles; raise nx")
    if not 0 <= scene.t_end < 1e15:
        raise InputError(f"t_end = {scene.t_end} must be a time of at least 0")
    for term in scene.terms:
        if not isinstance(term, Part):
            raise InputError(f"terms: {term!r} is not a term; give instances, for example Stress()")
    names = [type(term).__name__ for term in scene.terms]
    twice = {name for name in names if names.count(name) > 1}
    if twice:
        raise InputError(f"terms: {', '.join(sorted(twice))} listed twice; each effect once")
    for one, other in combinations(scene.terms, 2):
        shared = [kind for kind in type(one).__mro__ if isinstance(other, kind) and any(map(kind.__dict__.get, RATES))]
        if shared:  # an effect in several forms
            both = f"{type(one).__name__} and {type(other).__name__}"
            raise InputError(f"terms: {both} are both a {shared[0].__name__}; list one of them")
    check_reference(scene)
    check_members(scene)
    check_steps(scene)
    check_weights(scene)


def check_weights(scene: "Scene") -> None:
    """Weights that interpolate between a pair are for Riemann problems, on a cubic in one dimension and without B."""
    slope, names = scene.density.slope, [type(term).__name__ for term in scene.terms]
    if slope not in BETWEEN:
        return
    said = f'Scene: {type(scene.density).__name__}(slope="{slope}")'
    if not {"GodunovHydro", "GodunovMHD"} & set(names):
        raise InputError(f'{said} weighs Riemann problems: list GodunovHydro(), or give slope="variational"')
    if slope == "cubic" and scene.dim > 1:
        raise InputError(f'{said} is for one dimension, particles would clump in {scene.dim}: give slope="linear"')
    if slope == "cubic" and "GodunovMHD" in names:
        raise InputError(f'{said} is for a gas without a field: give slope="own" with GodunovMHD()')
    if "corrected" in {getattr(term, "areas", "") for term in scene.terms}:
        raise InputError(f'{said} weighs pairs as the gradients do not: give slope="mean" with areas="corrected"')


def check_steps(scene: "Scene") -> None:
    """Rates that belong to a step as a whole, and the stepper that takes them so, come together."""
    centred = [type(term).__name__ for term in scene.terms if term.centred]
    if centred and not scene.stepper.centred:
        raise InputError(f"Scene: {centred[0]} centres its rates in the step itself: give stepper=TimeCentred()")
    if scene.stepper.centred and not centred:
        name = type(scene.stepper).__name__
        raise InputError(f"Scene: {name} is for GodunovHydro and GodunovMHD, which centre their rates; leave it out")


def check_reference(scene: "Scene") -> None:
    """A map is there, and of a plane."""
    if scene.reference is None:
        return
    if scene.dim != 2:
        raise InputError(f"Scene: reference given in {scene.dim} dimension(s); maps are of two: leave it out")
    if not scene.reference.is_file():
        raise InputError(
            f"Scene: reference = {scene.reference} is no file; give the path of a .npz map, or leave it out"
        )


SHARED = {"b", "u", "closing"}  # sums that many add to (the rate of B/rho, heat) or ask for (Compression)
RATES = ("pair", "local", "after")  # hooks that make a class an effect


def check_sums(scene: "Scene") -> None:
    """Sums of one name would add up into one number: each must belong to one part."""
    for kind in ("sums", "gathers"):
        owner = {}
        for part in scene.parts:
            for name in set(getattr(part, kind)) - SHARED:
                other = type(owner.setdefault(name, part)).__name__
                if owner[name] is not part:
                    raise InputError(f"terms: {other} and {type(part).__name__} both sum {name}; rename one of the two")


def check_members(scene: "Scene") -> None:
    """Every member a part reads must be given, made or evolved by somebody; every scene needs a signal speed."""
    there = GIVEN | {"held"} | {name for part in scene.parts for name in (*part.makes, *part.evolves, *part.keeps)}
    for part in scene.parts:
        if "b" in part.sums and "B" not in there:
            raise InputError(f"{type(part).__name__} changes B, which nothing in this scene evolves: {CURES['B']}")
        for name in part.reads:
            if name not in there:
                cure = CURES.get(name, "list the term that makes it")
                raise InputError(f"{type(part).__name__} reads {name}, which nothing in this scene provides: {cure}")
    if "vw" not in there or not any("v" in part.evolves for part in scene.parts):
        raise InputError("terms: nothing moves this gas; list Pressure() or, with a magnetic field, Stress()")
    check_sums(scene)
    makers = [name for part in scene.parts for name in part.makes]
    if len(set(makers)) < len(makers):
        clash = sorted({name for name in makers if makers.count(name) > 1})
        raise InputError(f"terms: {', '.join(clash)} made by two terms; list only one of Pressure and Stress")
