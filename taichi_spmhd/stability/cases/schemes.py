"""Every stepper, energy, density, induction and cleaning there is, on one flow with shocks and strong fields."""

from ...density import SumVolume
from ...energy import Total
from ...stepper import SSPRK3, Heun
from ...terms import ConstantCleaning, Induction, TriccoPrice2012
from ..case import SHOCKED, Case, Problem
from .flows import orszag_tang

SCHEMES = {
    "Heun": {"changes": {"stepper": Heun()}},
    "SSPRK3": {"changes": {"stepper": SSPRK3()}},
    "Total": {"changes": {"energy": Total()}},
    "SumVolume": {"density": SumVolume()},
    "Induction of B": {"extra": (Induction(form="B"),)},
    "ConstantCleaning": {"extra": (ConstantCleaning(),), "without": ("Cleaning",)},
    "TriccoPrice2012": {"extra": (TriccoPrice2012(),), "without": ("Cleaning",)},
}


def flow(scheme: str, nx: int) -> Problem:
    """The Orszag-Tang vortex to t = 1."""
    whole = orszag_tang(1.0, nx)
    given = {name: getattr(whole, name) for name in ("box", "positions", "start", "eos", "boundary")}
    return Problem(**given, t_end=1.0, **SCHEMES[scheme])


CASES = (
    Case("schemes", "the Orszag-Tang vortex to t = 1 with every other scheme", "scheme", flow, tuple(SCHEMES),
         (), (48, 24), SHOCKED, quick=("SSPRK3", "Total")),
)  # fmt: skip
