"""What is measured of a simulation: arrangement, div B, conservation against prediction, errors, samples, summary."""

from .anisotropy import anisotropy
from .clumping import clumping, nearest_gaps
from .correlation import first_peak, pair_correlation
from .errors import errors
from .field import div_B, div_B_figures
from .force import div_B_force
from .history import COLUMNS, history_row
from .instability import instability
from .ledger import Ledger, drifts, energies, momentum, predicted
from .negative_pairs import negative_pairs
from .sample import interpolate
from .summary import summary

__all__ = [
    "COLUMNS",
    "Ledger",
    "anisotropy",
    "clumping",
    "div_B",
    "div_B_figures",
    "div_B_force",
    "drifts",
    "energies",
    "errors",
    "first_peak",
    "history_row",
    "instability",
    "interpolate",
    "momentum",
    "nearest_gaps",
    "negative_pairs",
    "pair_correlation",
    "predicted",
    "summary",
]
