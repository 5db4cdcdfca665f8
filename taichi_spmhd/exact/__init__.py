"""Exact solutions to measure runs against: pure numpy, no Taichi."""

from .riemann import Star, sod, star_state
from .thin_shell import Shell, shell_profile, thin_shell
from .waves import alfven_wave, direction, frame, sound_wave

__all__ = [
    "Shell",
    "Star",
    "alfven_wave",
    "direction",
    "frame",
    "shell_profile",
    "sod",
    "sound_wave",
    "star_state",
    "thin_shell",
]
