"""Smoothed particle magnetohydrodynamics to learn from: scenes, terms that add, choices that replace.

import taichi_spmhd as spmhd
spmhd.init(arch="cpu", precision="f64", threads=2)
scene = spmhd.load_scene("alfven_tensile", nx=32)["xi = 1/2"]
sim = spmhd.Simulation(scene); sim.run(until=0.5); sim["B"]
"""

from importlib.metadata import PackageNotFoundError, version

from .errors import InputError, RunError

try:
    from . import exact, terms
    from .boundary import Boundary, Frozen, Open, Periodic, Reflecting
    from .box import Box
    from .density import SumMass, SumVolume
    from .energy import Dual, Thermal, Total
    from .eos import Adiabatic, Isothermal, LocallyIsothermal
    from .glass import glass
    from .guard import Guard
    from .kernels import CubicSpline, Gaussian, QuinticSpline, WendlandC2, WendlandC4, WendlandC6
    from .lattice import close_packed, cubic, hexagonal, jitter, line, spacing, square
    from .library import load_scene
    from .picture import Picture
    from .profiles import displaced, step_lattice
    from .render import snapshot as picture
    from .runtime import init
    from .scene import Scene
    from .schemes import STIRRED, Scheme, in_scheme, with_scheme
    from .simulation import Simulation
    from .stepper import SSPRK3, Heun, LeapfrogKDK, TimeCentred
    from .study import Anchor, Study
    from .terms import Choice, Part, Term
except InputError as error:  # Taichi cannot be imported: said, in one line, by whatever needs it
    _missing = str(error)

    def __getattr__(name: str):
        if name in __all__:
            raise InputError(_missing)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


try:
    __version__ = version("taichi-spmhd")
except PackageNotFoundError:  # run from a checkout that is not installed
    __version__ = "0+unknown"

__all__ = [
    "SSPRK3",
    "STIRRED",
    "Adiabatic",
    "Anchor",
    "Boundary",
    "Box",
    "Choice",
    "CubicSpline",
    "Dual",
    "Frozen",
    "Gaussian",
    "Guard",
    "Heun",
    "InputError",
    "Isothermal",
    "LeapfrogKDK",
    "LocallyIsothermal",
    "Open",
    "Part",
    "Periodic",
    "Picture",
    "QuinticSpline",
    "Reflecting",
    "RunError",
    "Scene",
    "Scheme",
    "Simulation",
    "Study",
    "SumMass",
    "SumVolume",
    "Term",
    "Thermal",
    "TimeCentred",
    "Total",
    "WendlandC2",
    "WendlandC4",
    "WendlandC6",
    "close_packed",
    "cubic",
    "displaced",
    "exact",
    "glass",
    "hexagonal",
    "in_scheme",
    "init",
    "jitter",
    "line",
    "load_scene",
    "picture",
    "spacing",
    "square",
    "step_lattice",
    "terms",
    "with_scheme",
]
