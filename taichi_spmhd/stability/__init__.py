"""The battery: hard cases at growing hardness, which presets stand them, and how far each is from trouble."""

from .case import Case, Limits, Problem
from .cases import CASES
from .presets import PRESETS

__all__ = ["CASES", "PRESETS", "Case", "Limits", "Problem"]
