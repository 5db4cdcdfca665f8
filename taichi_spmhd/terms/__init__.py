"""The effects a scene can list, one file each."""

from .balsara import Balsara
from .base import Choice, Part, Term
from .cleaning import Cleaning
from .conductivity import Conductivity
from .divb_source import DivBSource
from .induction import Induction
from .lecture_viscosity import LectureViscosity
from .morris_monaghan import MorrisMonaghan
from .pressure import Pressure
from .resistivity import Resistivity
from .stress import Stress
from .switch import CullenDehnen
from .tricco_price import TriccoPrice2013
from .viscosity import Viscosity

__all__ = [
    "Balsara",
    "Choice",
    "Cleaning",
    "Conductivity",
    "CullenDehnen",
    "DivBSource",
    "Induction",
    "LectureViscosity",
    "MorrisMonaghan",
    "Part",
    "Pressure",
    "Resistivity",
    "Stress",
    "Term",
    "TriccoPrice2013",
    "Viscosity",
]
