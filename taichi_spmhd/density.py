"""Density by summation, with the smoothing length that belongs to it, and what pairs are weighed with.  (a choice)

    rho_i = sum_j m_j W(r_ij, h_i),   h_i = h_fact (m_i/rho_i)^(1/d),   Omega_i = 1 + h_i/(d rho_i) sum_j m_j dW/dh

(lecture pp. 4, 10-11; Springel & Hernquist 2002, Price 2012). Newton iteration from the last h; bisection where it
fails.
"""

from dataclasses import dataclass

from .errors import InputError
from .runtime import ti
from .terms.base import Choice
from .types import real

NEWTON, BISECTION = 12, 60  # iterations at the most
SUMS = {"mass": real, "slope": real, "bend": real}
GROWTH, LEAST = 1.3, 0.05  # of h within one solve: beyond them the list is built anew first


@dataclass(frozen=True)
class SumMass(Choice):
    """rho_i = sum_j m_j W(r_ij, h_i): equal masses carry the density by their spacing

    tolerance: relative accuracy of h (measured: 1e-5 at the default 1e-4); 1e-10 where identities are tested in f64.
    rho is that of the relation between h and rho, which the sum equals to the same accuracy.
    """

    tolerance: float = 1e-4

    def __post_init__(self):
        if not 1e-14 <= self.tolerance <= 0.01:
            raise InputError(f"SumMass: tolerance = {self.tolerance} must lie in 1e-14..1e-2; 1e-4 is usual")

    @ti.func
    def weights(self, i, j, d, kernel: ti.template()):
        """e = (x_i - x_j)/r and Gi = m_j dW(r, h_i)/dr / (Omega_i rho_i^2); zero for i = j and outside the support."""
        r2 = d.dot(d)
        rinv = 1.0 / ti.sqrt(r2 + 1e-30)
        r = r2 * rinv
        return ti.Struct(e=d * rinv, r=r, Gi=j.m * i.g * kernel.df(r * i.hinv), Gj=j.m * j.g * kernel.df(r * j.hinv))


@ti.data_oriented
class Density:
    """Solves for h, rho and Omega of all particles; members hinv = 1/h and g = sigma/(h^(d+1) Omega rho^2) follow."""

    def __init__(self, particles, pairs, kernel, choice):
        self.p, self.pairs, self.kernel, self.dim = particles, pairs, kernel, particles.dim
        self.choice = choice
        self.tolerance = max(choice.tolerance, 4e-6 if particles.word().itemsize == 4 else 0.0)  # f32 reaches no more

    @ti.func
    def sums(self, i, h, rows, n, near: ti.template()):
        """sum_j m_j f(q), sum_j m_j D(q) with D = d f + q f', and sum_j m_j q D'(q), q = r/h, without norms."""
        total, hinv = self.pairs.lanes.totals(SUMS), 1.0 / h
        for block in range(rows // self.pairs.lanes.width):
            j = self.pairs.theirs(near, n, block, ("x", "m"))
            q = self.pairs.between(i, j).norm() * hinv
            f, dh, bend = self.kernel.f(q), self.kernel.dh(q), self.kernel.bend(q)
            total.add(ti.Struct(mass=j.m * f, slope=j.m * dh, bend=j.m * bend), self.choice)
        return self.pairs.lanes.summed(total)

    @ti.func
    def wanted(self, i):
        """rho h^d / sigma of the relation h = h_fact (m/rho)^(1/d): what the sum of m f must equal."""
        return i.m * ti.static(self.kernel.h_fact**self.dim / self.kernel.sigma)

    @ti.func
    def bisect(self, i, low, high, rows, n, near: ti.template()):
        """The root of sum_j m_j f(r/h) = wanted between two smoothing lengths: the sum grows with h."""
        for _ in range(BISECTION):
            middle = 0.5 * (low + high)
            if self.sums(i, middle, rows, n, near).mass < self.wanted(i):
                low = middle
            else:
                high = middle
            if high - low < self.tolerance * high:
                break
        return 0.5 * (low + high)

    @ti.func
    def iterate(self, i, rows, n, near: ti.template()):
        """h by Newton's method on F = sum m f - wanted: dF/dh = - (slope - d mass)/h; steps limited to 20 %.

        A step s leaves a relative error of about s^2: the last one is taken without summing again, with the sums
        carried to the new h, mass = wanted and slope - s bend. In a run one pass over the neighbours is then enough.
        """
        h, goal, most = i.h, self.wanted(i), GROWTH * i.h0
        mass, slope, step, done = ti.cast(0.0, float), ti.cast(0.0, float), ti.cast(0.0, float), 0
        for _ in range(NEWTON):
            sums = self.sums(i, h, rows, n, near)
            step = (goal - sums.mass) / ti.max(self.dim * sums.mass - sums.slope, 0.05 * goal)
            if step * step < 0.1 * self.tolerance and h * (1.0 + step) < most:
                h, done, mass, slope = h * (1.0 + step), 1, goal, sums.slope - step * sums.bend
                break
            h *= ti.min(ti.max(1.0 + step, 0.8), 1.2)
            if h >= most:
                h, done = most, 1
                break
        if done == 0:
            h = self.bisect(i, LEAST * i.h0, most, rows, n, near)
        return h, done, mass, slope

    @ti.kernel
    def solve(
        self, near: ti.types.ndarray(dtype=ti.i32, ndim=2), rows: ti.types.ndarray(dtype=ti.i32, ndim=1)
    ) -> ti.i32:
        """h, rho, Omega of all; returns 1 if some h is smaller than a solve may go: then build and solve again."""
        unresolved = 0
        for n in range(self.p.n):
            i = self.pairs.mine(n, ("x", "m", "h", "h0"))
            h, done, mass, slope = self.iterate(i, rows[n], n, near)
            if done == 0 or h >= GROWTH * i.h0:
                sums = self.sums(i, h, rows[n], n, near)
                mass, slope = sums.mass, sums.slope
            ti.atomic_or(unresolved, ti.cast(h < 1.01 * LEAST * i.h0, ti.i32))
            hinv = 1.0 / h
            norm = ti.static(self.kernel.sigma) * hinv**self.dim
            rho = norm * mass
            Omega = 1.0 - slope / (self.dim * mass)
            self.p.state[n].h, self.p.state[n].hinv = h, hinv
            self.p.state[n].rho, self.p.state[n].Omega = rho, Omega
            self.p.state[n].g = norm * hinv / (Omega * rho * rho)
        return unresolved
