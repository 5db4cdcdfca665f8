"""The effects a scene can list, one file each."""

from .base import Choice, Part, Term
from .cleaning import Cleaning
from .conductivity import Conductivity
from .divb_source import DivBSource
from .induction import Induction
from .passive_density import PassiveDensity
from .pressure import Pressure
from .resistivity import Resistivity
from .stress import Stress
from .switch import CullenDehnen
from .viscosity import Viscosity

__all__ = [
    "Choice",
    "Cleaning",
    "Conductivity",
    "CullenDehnen",
    "DivBSource",
    "Induction",
    "Part",
    "PassiveDensity",
    "Pressure",
    "Resistivity",
    "Stress",
    "Term",
    "Viscosity",
]
