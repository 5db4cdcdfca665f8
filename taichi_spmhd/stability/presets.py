"""Presets: sets of terms, kernel and stepper that a scene may start from; the battery tells what each stands.

textbook   the conservative equations as they stand, xi = 0, cubic spline: what the cures are needed for
usual      quintic spline, xi = 1/2, viscosity by Cullen & Dehnen, cleaning: sharp, the scenes' own
robust     Wendland C4, xi = 1/2, viscosity everywhere, cleaning: for what nobody has tried before
godunov    Riemann problems and characteristics in place of all viscosity, corrected areas, Wendland C4, xi = 3/4

xi = 1/2 in the middle two: it makes the stress along B that of the gas alone, down to the lowest beta tried. xi = 1 has
a margin for noise, but at a free surface its force takes the field that ends there for a source and blows particles
off. In Godunov's scheme waves along B grow at .006 v_A/dx with 1/2, and current sheets clump; 3/4 stands both.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

from ..kernels import CubicSpline, Kernel, QuinticSpline, WendlandC4
from ..scene import Scene
from ..schemes import with_scheme
from ..stepper import LeapfrogKDK
from ..terms import (
    Cleaning,
    Conductivity,
    ConstantCleaning,
    CullenDehnen,
    DivBSource,
    Induction,
    Pressure,
    Resistivity,
    Stress,
    Term,
    Viscosity,
)
from .case import Problem


@dataclass(frozen=True)
class Preset:
    """friction: what every gas has; cures: what a field needs beside Stress and Induction; choices: of the scheme."""

    about: str
    kernel: Kernel
    friction: Callable[[], tuple[Term, ...]]
    cures: Callable[[], tuple[Term, ...]]
    scheme: str = "standard"
    choices: dict = field(default_factory=dict)

    def scene(self, problem: Problem) -> Scene:
        """The scene of a problem."""
        own = (Stress(), Induction(), *self.cures()) if problem.magnetised else (Pressure(),)
        terms = (*own, *self.friction(), *problem.extra)
        replaced = {type(term).__name__ for term in problem.extra}
        kept = [t for t in terms if t in problem.extra or type(t).__name__ not in (*problem.without, *replaced)]
        given = {"kernel": self.kernel, "stepper": LeapfrogKDK(), "density": problem.density}
        scene = Scene(
            box=problem.box,
            positions=problem.positions,
            start=problem.start,
            terms=tuple(kept),
            eos=problem.eos,
            boundary=problem.boundary,
            t_end=problem.t_end,
            **{**given, **problem.changes},
        )
        return with_scheme(scene, self.scheme, **self.choices)


PRESETS = {
    "textbook": Preset(
        "cubic spline, xi = 0, Viscosity, Conductivity, Resistivity",
        CubicSpline(),
        lambda: (Viscosity(), Conductivity()),
        lambda: (Resistivity(),),
    ),
    "usual": Preset(
        "quintic spline, xi = 1/2, CullenDehnen, Conductivity, Resistivity, Cleaning",
        QuinticSpline(),
        lambda: (CullenDehnen(), Conductivity()),
        lambda: (DivBSource(xi=0.5), Resistivity(), Cleaning()),
    ),
    "robust": Preset(
        "Wendland C4, xi = 1/2, Viscosity, Conductivity, Resistivity, Cleaning",
        WendlandC4(),
        lambda: (Viscosity(), Conductivity()),
        lambda: (DivBSource(xi=0.5), Resistivity(), Cleaning()),
    ),
    "godunov": Preset(
        "Wendland C4 (h_fact 1.3), xi = 3/4, Riemann problems through corrected areas, C_shock = 1, ConstantCleaning",
        WendlandC4(h_fact=1.3),
        tuple,
        lambda: (DivBSource(xi=0.75), ConstantCleaning()),
        "godunov",
        {"areas": "corrected", "C_shock": 1.0, "cour": 0.5},
    ),
}
