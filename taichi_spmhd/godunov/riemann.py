"""The Riemann problem between two particles: the pressure and the velocity of the contact between its two waves.

    v_R - v_L + phi_L(P*) + phi_R(P*) = 0,   phi_k = (P* - P_k)/M_k:   the velocity jump across wave k

(van Leer 1979 in Lagrangian form), by Householder's method: like Newton's, with three derivatives, which are cheap once
the roots of M are taken. It starts where M^2, linear in P* as it is without a field, would end, with one M for both
waves. One step is then as close as six of Newton's from the acoustic pressure: 1e-7 in all published tubes, 4e-9 in
rj1a, the strongest. A fixed number of steps keeps the pair loop free of branches.
"""

from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti

STEPS = 1
KEPT = 0.05  # of P by a step at least: from far above it would lead below zero
SMALL = 1e-12


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
        """P where (P - Q) / sqrt( k + b (P - Q) ) = y:   Q, Q + y: the acoustic pressure without, with the velocities

        M^2 = A + B (P - mean) on either side; b is B/A of both, k = 1 + b (Q - mean).
        """
        mean, B_L, B_R = 0.5 * (L.P + R.P), self.law.stiffness(L), self.law.stiffness(R)
        A_L = ti.max(self.law.acoustic(L) + B_L * (mean - L.P), SMALL * B_L * mean)
        A_R = ti.max(self.law.acoustic(R) + B_R * (mean - R.P), SMALL * B_R * mean)
        M_L, M_R = ti.sqrt(A_L), ti.sqrt(A_R)
        share = 1.0 / ((M_L + M_R) * A_L * A_R)
        Q = (L.P * M_R + R.P * M_L) * (A_L * A_R * share)
        y = (L.v - R.v) * (M_L * M_R * A_L * A_R * share)
        b = (B_L * M_R * A_R + B_R * M_L * A_L) * share
        k = ti.max(1.0 + b * (Q - mean), 0.1)
        return ti.max(Q + 0.5 * (b * y * y + y * ti.sqrt(b * b * y * y + 4.0 * k)), KEPT * mean)

    @ti.func
    def shock(self, s, P, M, slope):
        """phi and its first three derivatives with respect to P, of a shock; slope = dM^2/dP, 1/M given as M."""
        phi, k = (P - s.P) * M, (P - s.P) * slope * M * M
        first, second = M * (1.0 - 0.5 * k), -slope * M * M * M * (1.0 - 0.75 * k)
        return phi, first, second, 0.75 * slope * slope * M * M * M * M * M * (3.0 - 2.5 * k)

    @ti.func
    def waves(self, L, R, P):
        """The four of either side, with two divisions for both."""
        M2_L, top_L, bottom_L = self.law.flux(L, P)
        M2_R, top_R, bottom_R = self.law.flux(R, P)
        M_L, M_R = ti.sqrt(M2_L), ti.sqrt(M2_R)
        share, below = 1.0 / (M_L * M_R), 1.0 / (bottom_L * bottom_R)
        left = self.shock(L, P, share * M_R, top_L * bottom_R * below)
        return left, self.shock(R, P, share * M_L, top_R * bottom_L * below)

    @ti.func
    def star(self, L, R):
        """P* and v* between the waves."""
        P, v = self.start(L, R), 0.5 * (L.v + R.v)
        for _ in ti.static(range(self.steps)):
            P, v = self.better(L, R, P)
        return P, v

    @ti.func
    def better(self, L, R, P):
        """A step: the new pressure, and the velocity that the expansions of both waves give there."""
        left, right = self.waves(L, R, P)
        f, f1 = left[0] + right[0] + R.v - L.v, left[1] + right[1]
        f2, f3 = left[2] + right[2], left[3] + right[3]
        move = -3.0 * f * (2.0 * f1 * f1 - f * f2) / (6.0 * f1 * (f1 * f1 - f * f2) + f * f * f3)
        new = ti.max(P + move, KEPT * P)
        return new, 0.5 * (L.v + R.v + self.expanded(right, new - P) - self.expanded(left, new - P))

    @ti.func
    def expanded(self, wave, move):
        """phi a little further."""
        return wave[0] + move * (wave[1] + move * (0.5 * wave[2] + move * wave[3] / 6.0))
