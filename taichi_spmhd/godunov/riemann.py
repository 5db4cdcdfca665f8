"""The Riemann problem between two particles: the pressure and the velocity of the contact between its two waves.

Newton's method on   v_R - v_L + phi_L(P*) + phi_R(P*) = 0,   phi_k = (P* - P_k)/M_k,   the velocity jump across wave k
(van Leer 1979 in Lagrangian form). phi is concave, so from above the first step falls below the root and from below all
steps rise to it. The first step takes no more than nine tenths of the pressure away, so P* stays positive. A fixed
number of steps keeps the pair loop free of branches.
"""

from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti

STEPS = 4  # from max(acoustic guess, mean): round-off for weak waves, 5e-8 for the strongest tube (rj1a)
KEPT = 0.1  # of P, by every step: where the sides part fast the first would end near zero, and the next only triple P


@dataclass(frozen=True)
class Riemann:
    """law: the waves (hugoniot.py; rarefaction.py); steps of Newton's method."""

    law: object
    steps: int = STEPS

    def __post_init__(self):
        if not 1 <= self.steps <= 20:
            raise InputError(f"Riemann: steps = {self.steps} must lie in 1..20; {STEPS} is enough")

    @ti.func
    def start(self, L, R):
        """The larger of the acoustic pressure and the mean."""
        M_L, M_R = ti.sqrt(self.law.acoustic(L)), ti.sqrt(self.law.acoustic(R))
        sound = (L.P * M_R + R.P * M_L - M_L * M_R * (R.v - L.v)) / (M_L + M_R)
        return ti.max(sound, 0.5 * (L.P + R.P))

    @ti.func
    def wave(self, s, P):
        """phi and its derivative with respect to P, with a shock on this side."""
        M2, slope = self.law.flux(s, P)
        inverse = 1.0 / ti.sqrt(M2)
        phi = (P - s.P) * inverse
        return phi, inverse * (1.0 - 0.5 * (P - s.P) * slope * inverse * inverse)

    @ti.func
    def star(self, L, R):
        """P* and v* between the waves."""
        P, v = self.start(L, R), 0.5 * (L.v + R.v)
        for _ in ti.static(range(self.steps)):
            P, v = self.newton(L, R, P)
        return P, v

    @ti.func
    def newton(self, L, R, P):
        """A step of Newton's method with a shock on either side."""
        return self.moved(L, R, P, self.wave(L, P), self.wave(R, P))

    @ti.func
    def moved(self, L, R, P, left, right):
        """The new pressure, and the velocity that belongs to it on the tangents of both waves (phi, its derivative)."""
        new = ti.max(P - (left[0] + right[0] + R.v - L.v) / (left[1] + right[1]), KEPT * P)
        move = new - P
        return new, 0.5 * (L.v + R.v + right[0] + right[1] * move - left[0] - left[1] * move)
