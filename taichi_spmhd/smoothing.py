"""Solves rho and h together: Newton iteration from the last h, bisection where it fails.

sum_j s_j W(r_ij, h_i) = s_i (h_fact/h_i)^d,   s = m by mass, 1 by volume (density.py)
"""

from .runtime import ti
from .types import real
from .wide import wide

NEWTON, BISECTION = 12, 60  # iterations at the most
SUMS = {"sum": real, "slope": real, "bend": real}
GROWTH, LEAST = 1.3, 0.05  # of h within one solve: beyond them the list is built anew first


@ti.data_oriented
class Density:
    """Solves for h, rho and Omega of all particles; members hinv = 1/h and g = sigma/(h^(d+1) Omega rho^2) follow."""

    def __init__(self, particles, pairs, kernel, choice):
        self.p, self.pairs, self.kernel, self.dim = particles, pairs, kernel, particles.dim
        self.choice = choice
        self.tolerance = max(choice.tolerance, 4e-6 if particles.word().itemsize == 4 else 0.0)  # f32 reaches no more

    @ti.func
    def sums(self, i, h, rows, n, near: ti.template()):
        """sum_j f(q), sum_j D(q) with D = d f + q f', and sum_j q D'(q), q = r/h: by mass or number, without norms."""
        total, hinv = self.pairs.lanes.totals(SUMS), 1.0 / h
        for block in range(rows // self.pairs.lanes.width):
            j = self.pairs.theirs(near, n, block, ("x", "m"))
            q = self.pairs.between(i, j).norm() * hinv
            f, dh, bend = self.kernel.f(q), self.kernel.dh(q), self.kernel.bend(q)
            share = self.choice.share(j)
            total.add(ti.Struct(sum=share * f, slope=share * dh, bend=share * bend), self.choice)
        return self.pairs.lanes.summed(total)

    @ti.func
    def wanted(self, i):
        """What the sum of f must equal where h = h_fact (m/rho)^(1/d)."""
        return self.choice.share(i) * ti.static(self.kernel.h_fact**self.dim / self.kernel.sigma)

    @ti.func
    def bisect(self, i, low, high, rows, n, near: ti.template()):
        """The root of sum_j f(r/h) = wanted between two smoothing lengths: the sum grows with h."""
        for _ in range(BISECTION):
            middle = 0.5 * (low + high)
            if self.sums(i, middle, rows, n, near).sum < self.wanted(i):
                low = middle
            else:
                high = middle
            if high - low < self.tolerance * high:
                break
        return 0.5 * (low + high)

    @ti.func
    def iterate(self, i, rows, n, near: ti.template()):
        """h by Newton's method on F = sum f - wanted: dF/dh = - (slope - d sum)/h; steps limited to 20 %.

        A step s leaves a relative error of about s^2: the last one is taken without summing again, with the sums
        carried to the new h, sum = wanted and slope - s bend. In a run one pass over the neighbours is then enough.
        """
        h, goal, most = i.h, self.wanted(i), GROWTH * i.h0
        slope, done = ti.cast(0.0, float), 0
        for _ in range(NEWTON):
            sums = self.sums(i, h, rows, n, near)
            step = (goal - sums.sum) / ti.max(self.dim * sums.sum - sums.slope, 0.05 * goal)
            if step * step < 0.1 * self.tolerance and h * (1.0 + step) < most:
                h, done, slope = h * (1.0 + step), 1, sums.slope - step * sums.bend
                break
            h *= ti.min(ti.max(1.0 + step, 0.8), 1.2)
            if h >= most:
                break
        return h, done, slope

    @ti.func
    def write(self, n, i, h, total, slope):
        """h and what follows from it and its sums."""
        hinv = 1.0 / h
        norm = ti.static(self.kernel.sigma) * hinv**self.dim
        rho = self.choice.rho(i, norm * total)
        Omega = 1.0 - slope / (self.dim * total)
        self.p.state[n].h, self.p.state[n].hinv = h, hinv
        self.p.state[n].rho, self.p.state[n].Omega = rho, Omega
        self.p.state[n].g = self.choice.g(norm * hinv, Omega, rho)

    @ti.func
    def shrunk(self, i, h):
        """1 for an h smaller than a solve may go."""
        return ti.cast(h < 1.01 * LEAST * i.h0, ti.i32)

    @ti.kernel
    @wide
    def newton(
        self, near: ti.types.ndarray(dtype=ti.i32, ndim=2), rows: ti.types.ndarray(dtype=ti.i32, ndim=1)
    ) -> ti.i32:
        """h, rho, Omega of all; bit 0: some h is too small, bit 1: some h is not found, its particle has Omega = 0."""
        said = 0
        for n in range(self.p.n):
            i = self.pairs.mine(n, ("x", "m", "h", "h0"))
            h, done, slope = self.iterate(i, rows[n], n, near)
            if done == 1:
                self.write(n, i, h, self.wanted(i), slope)
            else:
                self.p.state[n].h = ti.min(h, GROWTH * i.h0)
                self.p.state[n].Omega = 0.0
            ti.atomic_or(said, ti.select(done == 1, self.shrunk(i, h), 2))
        return said

    @ti.kernel
    @wide
    def rescue(
        self, near: ti.types.ndarray(dtype=ti.i32, ndim=2), rows: ti.types.ndarray(dtype=ti.i32, ndim=1)
    ) -> ti.i32:
        """h by bisection, or the most it may grow, where Newton's method left Omega = 0; 1 if some h is too small.

        A kernel of its own: it is hardly ever needed, and two more sums make `newton` three times as long to compile.
        """
        said = 0
        for n in range(self.p.n):
            if self.p.state[n].Omega == 0.0:
                i = self.pairs.mine(n, ("x", "m", "h", "h0"))
                h, most = i.h, GROWTH * i.h0
                if h < most:
                    h = self.bisect(i, LEAST * i.h0, most, rows[n], n, near)
                sums = self.sums(i, h, rows[n], n, near)
                self.write(n, i, h, sums.sum, sums.slope)
                ti.atomic_or(said, self.shrunk(i, h))
        return said

    def solve(self, near, rows) -> int:
        """h, rho, Omega of all; returns 1 if some h is smaller than a solve may go: then build and solve again."""
        said = self.newton(near, rows)
        if said & 2:
            said |= self.rescue(near, rows)
        return said & 1
