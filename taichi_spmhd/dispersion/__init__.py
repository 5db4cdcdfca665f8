"""Linear stability of the discrete equations: what becomes of small plane waves, worked out with the code itself."""

from .analysis import Dispersion, analyse

__all__ = ["Dispersion", "analyse"]
