"""What is measured of a simulation: clumping, div B, conservation against prediction, errors, samples, the summary."""

from .clumping import clumping, nearest_gaps
from .errors import errors
from .field import div_B, div_B_figures
from .history import COLUMNS, history_row
from .ledger import Ledger, drifts, energies, momentum, predicted
from .sample import interpolate
from .summary import summary

__all__ = [
    "COLUMNS",
    "Ledger",
    "clumping",
    "div_B",
    "div_B_figures",
    "drifts",
    "energies",
    "errors",
    "history_row",
    "interpolate",
    "momentum",
    "nearest_gaps",
    "predicted",
    "summary",
]
