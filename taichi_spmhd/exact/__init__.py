"""Exact solutions to measure runs against: pure numpy, no Taichi."""

from .mhd_riemann import mhd_tube, plateaus
from .mhd_tubes import TUBES, Tube
from .noh import noh
from .riemann import Star, sod, star_state
from .sedov import sedov, sedov_radius, sedov_time
from .thin_shell import Shell, shell_profile, thin_shell
from .waves import alfven_wave, direction, frame, sound_pulse, sound_wave

__all__ = [
    "TUBES",
    "Shell",
    "Star",
    "Tube",
    "alfven_wave",
    "direction",
    "frame",
    "mhd_tube",
    "noh",
    "plateaus",
    "sedov",
    "sedov_radius",
    "sedov_time",
    "shell_profile",
    "sod",
    "sound_pulse",
    "sound_wave",
    "star_state",
    "thin_shell",
]
