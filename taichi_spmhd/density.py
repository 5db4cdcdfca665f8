"""Density by summation, by mass or by volume, and what pairs are weighed with.  (a choice)

    rho_i = sum_j m_j W(r_ij, h_i),   h_i = h_fact (m_i/rho_i)^(1/d),   Omega_i = 1 + h_i/(d rho_i) sum_j m_j dW/dh

(lecture pp. 4, 10-11, 38-39; Springel & Hernquist 2002, Price 2012). Terms see the choice only through w.Gi and w.Gj.
"""

from dataclasses import dataclass

from .errors import InputError
from .godunov.between import BETWEEN
from .godunov.weighing import Between
from .runtime import ti
from .terms.base import Choice

SLOPES = ("variational", "own", "mean", *BETWEEN)


@dataclass(frozen=True)
class Summation(Between, Choice):
    """What both estimates share: a particle's share in the sum, the density that follows, and the pair's weights.

    tolerance: relative accuracy of h (measured: 1e-5 at the default 1e-4); 1e-10 where identities are tested in f64.
    rho is that of the relation between h and rho, which the sum equals to the same accuracy.

    slope: which slope of the kernel weighs a pair. "variational" (the default): Gi at h_i, Gj at h_j, each with its
    Omega. "own": the same without Omega; "mean": both at the mean of 1/h, without Omega, one kernel a pair instead of
    two. Godunov's scheme needs no variation and is more accurate without Omega (Iwasaki & Inutsuka 2011): with "mean"
    in turbulence, with "own" where strong shocks squeeze the gas along one line (docs/physics.md).

    "linear", "cubic": Inutsuka's (2002) own weights, V_ij^2(h) W'(r, sqrt(2) h) at h_i and at h_j, V = 1/rho between
    the pair on a line, or on a cubic (in 1-D only: elsewhere it lets particles clump), and Riemann states that meet at
    s* (godunov/between.py). Derived for the Gaussian kernel; other kernels take its formulas by their h. V_ij = V where
    rho is constant. Pairs reach sqrt(2) supports. For GodunovHydro; "linear" for GodunovMHD, too.
    """

    tolerance: float = 1e-4
    slope: str = "variational"

    def __post_init__(self):
        name = type(self).__name__
        if not 1e-14 <= self.tolerance <= 0.01:
            raise InputError(f"{name}: tolerance = {self.tolerance} must lie in 1e-14..1e-2; 1e-4 is usual")
        if self.slope not in SLOPES:
            raise InputError(f"{name}: slope = {self.slope!r}; give one of {', '.join(SLOPES)}")

    @ti.func
    def g(self, slope, Omega, rho):
        """The member g, what a particle has to the slopes of its pairs; slope = sigma/h^(d+1)."""
        if ti.static(self.slope == "mean"):
            return 1.0 / (rho * rho)
        elif ti.static(self.slope != "variational"):
            return slope / (rho * rho)
        else:
            return slope / (Omega * rho * rho)

    @ti.func
    def weights(self, i, j, d, kernel: ti.template()):
        """e = (x_i - x_j)/r and Gi, Gj; zero for i = j and outside the support."""
        r2 = d.dot(d)
        rinv = 1.0 / ti.sqrt(r2 + 1e-30)
        r = r2 * rinv
        if ti.static(self.slope in BETWEEN):
            at_i, at_j = self.between(i, j, d * rinv, r, kernel)
            return ti.Struct(e=d * rinv, r=r, Gi=at_i, Gj=at_j)
        else:
            own, other = self.masses(i, j)
            at_i, at_j = self.slopes(i, j, r, kernel)
            return ti.Struct(e=d * rinv, r=r, Gi=own * at_i, Gj=other * at_j)

    @ti.func
    def slopes(self, i, j, r, kernel: ti.template()):
        """What the masses are multiplied with: W' over (Omega) rho^2 of i and of j."""
        if ti.static(self.slope == "mean"):
            slope = self.at(r, 0.5 * (i.hinv + j.hinv), kernel)
            return i.g * slope, j.g * slope
        else:
            return i.g * kernel.df(r * i.hinv), j.g * kernel.df(r * j.hinv)

    @ti.func
    def at(self, r, hinv, kernel: ti.template()):
        """W'(r, h)"""
        return ti.static(kernel.sigma) * hinv ** ti.static(kernel.dim + 1) * kernel.df(r * hinv)

    @ti.func
    def F(self, i, j, w, kernel: ti.template()):
        """m_j ( W'(r, h_i) + W'(r, h_j) )/2, without Omega: for pairs that are weighed by a mean density."""
        return 0.5 * j.m * (self.at(w.r, i.hinv, kernel) + self.at(w.r, j.hinv, kernel))

    @ti.func
    def Di(self, i, j, w, kernel: ti.template()):
        """Gi for what two exchange, motion or heat."""
        return w.Gi

    @ti.func
    def Dj(self, i, j, w, kernel: ti.template()):
        """Gj for what two exchange."""
        return w.Gj

    @ti.func
    def near(self, i, j, w, kernel: ti.template()):
        """W(r, h)/W(dx, h) at the mean h, dx = h/h_fact the mean spacing: above 1 for pairs closer than that."""
        return kernel.f(2.0 * w.r / (i.h + j.h)) / kernel.f(ti.cast(1.0 / kernel.h_fact, float))


@dataclass(frozen=True)
class SumMass(Summation):
    """rho_i = sum_j m_j W(r_ij, h_i): equal masses carry the density by their spacing

    Gi = m_j W'(r, h_i) / (Omega_i rho_i^2),   Gj = m_j W'(r, h_j) / (Omega_j rho_j^2)
    """

    @ti.func
    def share(self, s):
        """What particle s counts in the sum."""
        return s.m

    @ti.func
    def rho(self, i, total):
        """The density of i, from the sum."""
        return total

    @ti.func
    def masses(self, i, j):
        """The masses that weigh the slopes at h_i and at h_j."""
        return j.m, j.m

    @ti.func
    def room(self, s):
        """The volume that is interpolated between a pair."""
        return 1.0 / s.rho

    @ti.func
    def even(self, i, j):
        """What weighs the square of the volume between a pair, at h_i and at h_j."""
        return j.m


@dataclass(frozen=True)
class SumVolume(Summation):
    """rho_i = m_i n_i,   n_i = sum_j W(r_ij, h_i) = 1/V_i: unequal masses carry the density, space is shared out

    For a density that jumps because the mass does, at a contact (lecture pp. 38-39; Hu & Adams 2006; Tartakovsky &
    Meakin 2005): no particle feels its neighbours' masses, so rho has no blip and no gap opens. Give masses in
    proportion to rho and one spacing everywhere.

    Gi = V_i^2 W'(r, h_i) / (Omega_i m_i),   Gj = V_j^2 W'(r, h_j) / (Omega_j m_i),   Omega of n instead of rho
    """

    @ti.func
    def share(self, s):
        """1; 0 for nobody, who fills the rows and has no mass."""
        return ti.select(s.m > 0.0, 1.0, 0.0)

    @ti.func
    def rho(self, i, total):
        return i.m * total

    @ti.func
    def masses(self, i, j):
        return i.m * self.share(j), j.m * (j.m / i.m)

    @ti.func
    def room(self, s):
        return s.m / s.rho

    @ti.func
    def even(self, i, j):
        return self.share(j) / i.m

    @ti.func
    def Di(self, i, j, w, kernel: ti.template()):
        """2 m_j/(m_i + m_j) Gi:   with Dj the harmonic mean of both sides (Cleary & Monaghan 1999)

        The sum of Gi and Gj would let a heavy neighbour brake, or cool, a light particle m_j/m_i times too fast.
        """
        return 2.0 * j.m / (i.m + j.m) * w.Gi

    @ti.func
    def Dj(self, i, j, w, kernel: ti.template()):
        """2 m_i/(m_i + m_j) Gj"""
        return 2.0 * i.m / (i.m + j.m) * w.Gj
