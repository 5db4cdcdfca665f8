"""The same scene in another scheme: standard SPH with artificial dissipation, or Godunov's with Riemann problems."""

from dataclasses import replace
from typing import TYPE_CHECKING, Literal

from . import terms as known
from .energy import Dual, Thermal
from .eos import Radiating
from .errors import InputError
from .kernels import CubicSpline
from .stepper import TimeCentred

if TYPE_CHECKING:
    from .kernels import Kernel
    from .scene import Scene

Scheme = Literal["standard", "godunov"]
NUMBERS = {"order", "limiter", "C_shock", "areas"}
STIRRED = {"kernel": CubicSpline(h_fact=1.1), "areas": "corrected", "C_shock": 1.0, "cour": 0.5}
DISSIPATION = ("Viscosity", "LectureViscosity", "Conductivity", "Resistivity", "TriccoPrice2013")


def in_scheme(variants: dict, scheme: Scheme, **choices) -> dict:
    """Every variant of a scene in this scheme, with the choices of with_scheme.

    Godunov's knows one way of cleaning: variants that become the same scene are listed once, by the last of their
    names.
    """
    if scheme == "standard":
        return variants
    made = {label: with_scheme(scene, scheme, **choices) for label, scene in variants.items()}
    last = {(scene.start, scene.terms, scene.density): label for label, scene in made.items()}
    return {label: made[label] for label in last.values()}


def with_scheme(
    scene: "Scene",
    scheme: Scheme,
    slope: str = "mean",
    kernel: "Kernel | None" = None,
    cour: float = TimeCentred.cour,
    **numbers,
) -> "Scene":
    """The scene as it is ("standard"), or its gas by Riemann problems ("godunov").

    Godunov's takes the place of Pressure or Stress and of all artificial dissipation, steps once a step (TimeCentred),
    cleans with one c_h for all, and with a field evolves both energies (Dual). slope: of the pairs (SumMass); kernel:
    that of the scene where none is given; cour: the Courant number; numbers: of GodunovHydro or GodunovMHD, for example
    areas="corrected". **STIRRED are the choices for gas that shocks stir in 2-D and 3-D (docs/godunov.md). Raises
    InputError for a scheme that does not exist.
    """
    if scheme not in ("standard", "godunov"):
        raise InputError(f'scheme = {scheme!r}; give "standard" or "godunov"')
    if scheme == "standard":
        return scene
    unknown = set(numbers) - NUMBERS
    if unknown:
        raise InputError(f"with_scheme: {', '.join(sorted(unknown))} unknown; there are {', '.join(sorted(NUMBERS))}")
    terms = [translated(term, numbers) for term in scene.terms if not is_a(term, *DISSIPATION)]
    terms = tuple({type(term).__name__: term for term in terms}.values())  # two cleanings become one
    field = any(is_a(term, "Stress") for term in scene.terms) and not isinstance(scene.eos, Radiating)
    return scene.but(
        terms=terms,
        density=replace(scene.density, slope=slope),
        kernel=kernel or scene.kernel,
        stepper=TimeCentred(cour=cour),
        energy=Dual() if field else Thermal(),
    )


def is_a(term, *names: str) -> bool:
    """Whether a term is of one of these classes, by name: a term that nobody lists is not looked up."""
    return any(kind.__name__ in names for kind in type(term).__mro__)


def translated(term, numbers: dict):
    """What takes the place of a term of the standard scheme."""
    if is_a(term, "Pressure"):
        return known.GodunovHydro(**numbers)
    if is_a(term, "Stress"):
        return known.GodunovMHD(**numbers)
    if is_a(term, "Induction"):
        return known.Induction()
    if is_a(term, "Hyperbolic") and not is_a(term, "ConstantCleaning"):
        return known.ConstantCleaning(f_clean=max(1.0, term.f_clean))
    return term
