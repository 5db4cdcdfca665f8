"""What the divergence cleanings share: errors of div B run away as waves of psi and are damped."""

from dataclasses import dataclass, replace

from ..errors import InputError
from ..runtime import ti
from ..types import real, vec3
from .base import Term

SAFE = 0.3  # widths h that a cleaning wave may cross in a step


class Hyperbolic(Term):
    """dB/dt = - grad psi,   dpsi/dt = - c_h^2 div B - psi/tau   (lecture pp. 27-29; Dedner et al. 2002)

    div B then obeys the telegraph equation: it travels at c_h and decays within tau. grad psi is the symmetric operator
    and div B the difference; they are conjugate, so that what the field loses psi has, e_psi = psi^2/(2 rho c_h^2) per
    mass, and only the damping takes it away.
    """

    def among(self, parts: tuple) -> "Hyperbolic":
        """Itself, if it is the only cleaning of the scene."""
        others = [type(part).__name__ for part in parts if isinstance(part, Hyperbolic) and part is not self]
        if others:
            raise InputError(f"terms: {type(self).__name__} and {others[0]} both clean div B; list one of them")
        return self


@dataclass(frozen=True)
class OwnSpeed(Hyperbolic):
    """A cleaning speed per particle, c_h = f_clean vw, damped over 1/tau = sigma c_h/h."""

    sigma: float = 0.0  # 0: by dimension
    f_clean: float = 1.0
    reads = {"B": vec3, "v": vec3, "rho": real, "h": real, "vw": real}
    sums, live = {"b": vec3}, {"sigma": (0.05, 3.0), "f_clean": (0.25, 5.0)}

    def __post_init__(self):
        if not (0 <= self.sigma < 100 and 0 < self.f_clean < 100):
            name, ranges = type(self).__name__, "must lie in 0..100 and f_clean"
            raise InputError(f"{name}: sigma = {self.sigma} {ranges} = {self.f_clean} in (0, 100)")

    def at(self, dim: int) -> "OwnSpeed":
        """With the damping that suits the number of dimensions where none was given."""
        return self if self.sigma else replace(self, sigma=1.0 if dim == 3 else 0.3)

    @ti.func
    def rate(self, i):
        """1/tau"""
        return self.sigma * i.ch / i.h

    @ti.func
    def max_dt(self, i, now):
        return SAFE * i.h / (i.ch + 1e-30)
