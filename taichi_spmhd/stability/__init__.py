"""The battery: hard cases, made harder until a scheme fails, and how far each is from trouble."""

from .case import Case, Limits, Problem
from .cases import CASES
from .presets import PRESETS

__all__ = ["CASES", "PRESETS", "Case", "Limits", "Problem"]
