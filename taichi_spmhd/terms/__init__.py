"""The effects a scene can list, one file each."""

from .base import Choice, Part, Term
from .cleaning import Cleaning
from .conductivity import Conductivity
from .divb_source import DivBSource
from .induction import Induction
from .passive_density import PassiveDensity
from .pressure import Pressure
from .repulsion import Repulsion
from .resistivity import Resistivity
from .stress import Stress
from .stress_shift import StressShift
from .switch import CullenDehnen
from .viscosity import Viscosity
from .xi_rules import LogLinearXi, MinimalXi, PhantomXi, XiRule, xi_of

__all__ = [
    "Choice",
    "Cleaning",
    "Conductivity",
    "CullenDehnen",
    "DivBSource",
    "Induction",
    "LogLinearXi",
    "MinimalXi",
    "Part",
    "PassiveDensity",
    "PhantomXi",
    "Pressure",
    "Repulsion",
    "Resistivity",
    "Stress",
    "StressShift",
    "Term",
    "Viscosity",
    "XiRule",
    "xi_of",
]
