"""The effects a scene can list, one file each."""

from .base import Choice, Part, Term
from .cleaning import Cleaning
from .conductivity import Conductivity
from .constant_cleaning import ConstantCleaning
from .divb_source import DivBSource
from .induction import Induction
from .pressure import Pressure
from .resistivity import Resistivity
from .stress import Stress
from .switch import CullenDehnen
from .tricco_price import TriccoPrice2012
from .viscosity import Viscosity

__all__ = [
    "Choice",
    "Cleaning",
    "Conductivity",
    "ConstantCleaning",
    "CullenDehnen",
    "DivBSource",
    "Induction",
    "Part",
    "Pressure",
    "Resistivity",
    "Stress",
    "Term",
    "TriccoPrice2012",
    "Viscosity",
]
