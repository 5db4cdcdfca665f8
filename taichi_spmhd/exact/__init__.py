"""Exact solutions to measure runs against: pure numpy, no Taichi."""

from .riemann import Star, sod, star_state
from .waves import alfven_wave, direction, frame, sound_wave

__all__ = ["Star", "alfven_wave", "direction", "frame", "sod", "sound_wave", "star_state"]
