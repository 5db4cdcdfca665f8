"""The effects a scene can list, one file each."""

from .balsara import Balsara
from .base import Choice, Part, Term
from .cleaning import Cleaning
from .conductivity import Conductivity
from .constant_cleaning import ConstantCleaning
from .divb_source import DivBSource
from .godunov_hydro import GodunovHydro
from .godunov_mhd import GodunovMHD
from .induction import Induction
from .lecture_viscosity import LectureViscosity
from .morris_monaghan import MorrisMonaghan
from .passive_density import PassiveDensity
from .pressure import Pressure
from .repulsion import Repulsion
from .resistivity import Resistivity
from .stress import Stress
from .stress_shift import StressShift
from .switch import CullenDehnen
from .tricco_price_2012 import TriccoPrice2012
from .tricco_price_2013 import TriccoPrice2013
from .viscosity import Viscosity
from .xi_rules import LogLinearXi, MinimalXi, PhantomXi, XiRule, xi_of

__all__ = [
    "Balsara",
    "Choice",
    "Cleaning",
    "Conductivity",
    "ConstantCleaning",
    "CullenDehnen",
    "DivBSource",
    "GodunovHydro",
    "GodunovMHD",
    "Induction",
    "LectureViscosity",
    "LogLinearXi",
    "MinimalXi",
    "MorrisMonaghan",
    "Part",
    "PassiveDensity",
    "PhantomXi",
    "Pressure",
    "Repulsion",
    "Resistivity",
    "Stress",
    "StressShift",
    "Term",
    "TriccoPrice2012",
    "TriccoPrice2013",
    "Viscosity",
    "XiRule",
    "xi_of",
]
