"""Smoothing kernels W(r, h) = sigma_d / h^d f(q), q = r/h, in one, two and three dimensions.

All are branch-free (differences clamped at zero), so that loops over neighbours vectorise; f(q) and f'(q) vanish for
q >= support. h = h_fact (m/rho)^(1/d); the default h_fact of each class is the one its neighbour number is known to
work with. Norms re-integrated in the tests. Sources: Monaghan 1992; Wendland 1995; Dehnen & Aly 2012; Price et al.
2018.
"""

from dataclasses import dataclass, replace
from math import pi, sqrt

from .errors import InputError
from .runtime import ti


@ti.func
def above(x):
    """The positive part of x."""
    return ti.max(x, 0.0)


@ti.data_oriented
class Kernel:
    """What all kernels share: norm, derivative with respect to h, neighbour number."""

    support = 2.0  # radius in units of h
    norms = (0.0, 0.0, 0.0)  # sigma_1, sigma_2, sigma_3

    def at(self, dim: int) -> "Kernel":
        """This kernel for a number of dimensions."""
        return replace(self, dim=dim)

    def __post_init__(self):
        if not 0.3 <= self.h_fact <= 10:
            raise InputError(f"{type(self).__name__}: h_fact = {self.h_fact} is out of range; 1.0 to 2.0 is usual")

    @property
    def sigma(self) -> float:
        """The norm sigma_d."""
        return self.norms[self.dim - 1]

    @property
    def neighbours(self) -> float:
        """Expected number of particles inside the support, the particle itself included."""
        radius = self.support * self.h_fact
        return (2 * radius, pi * radius**2, 4 / 3 * pi * radius**3)[self.dim - 1]

    @ti.func
    def dh(self, q):
        """d f(q) + q f'(q): dW/dh = - sigma / h^(d+1) times this."""
        return self.dim * self.f(q) + q * self.df(q)

    @ti.func
    def bend(self, q):
        """q times the derivative of `dh`: how the sum over it changes with h."""
        return q * ((self.dim + 1) * self.df(q) + q * self.ddf(q))


@dataclass(frozen=True)
class CubicSpline(Kernel):
    """M4: f = (2-q)^3/4 - (1-q)^3, each clamped at 0. 18 neighbours in 2-D, 58 in 3-D; cheap, noisy in shear."""

    h_fact: float = 1.2
    dim: int = 0
    norms = (2 / 3, 10 / (7 * pi), 1 / pi)

    @ti.func
    def f(self, q):
        a, b = above(2.0 - q), above(1.0 - q)
        return 0.25 * a * a * a - b * b * b

    @ti.func
    def df(self, q):
        a, b = above(2.0 - q), above(1.0 - q)
        return 3.0 * b * b - 0.75 * a * a

    @ti.func
    def ddf(self, q):
        return 1.5 * above(2.0 - q) - 6.0 * above(1.0 - q)


@dataclass(frozen=True)
class QuinticSpline(Kernel):
    """M6: f = (3-q)^5 - 6 (2-q)^5 + 15 (1-q)^5, each clamped at 0. 28 neighbours in 2-D, 113 in 3-D; for waves."""

    h_fact: float = 1.0
    dim: int = 0
    support = 3.0
    norms = (1 / 120, 7 / (478 * pi), 1 / (120 * pi))

    @ti.func
    def f(self, q):
        a, b, c = above(3.0 - q), above(2.0 - q), above(1.0 - q)
        a2, b2, c2 = a * a, b * b, c * c
        return a2 * a2 * a - 6.0 * b2 * b2 * b + 15.0 * c2 * c2 * c

    @ti.func
    def df(self, q):
        a, b, c = above(3.0 - q), above(2.0 - q), above(1.0 - q)
        a2, b2, c2 = a * a, b * b, c * c
        return -5.0 * a2 * a2 + 30.0 * b2 * b2 - 75.0 * c2 * c2

    @ti.func
    def ddf(self, q):
        a, b, c = above(3.0 - q), above(2.0 - q), above(1.0 - q)
        return 20.0 * a * a * a - 120.0 * b * b * b + 300.0 * c * c * c


@dataclass(frozen=True)
class WendlandC2(Kernel):
    """f = (1-q/2)^4 (1+2q); in 1-D (1-q/2)^3 (1+3q/2). Never pairs."""

    h_fact: float = 1.3
    dim: int = 0
    norms = (5 / 8, 7 / (4 * pi), 21 / (16 * pi))

    @ti.func
    def f(self, q):
        a = above(1.0 - 0.5 * q)
        return a * a * a * (1.0 + 1.5 * q if ti.static(self.dim == 1) else a * (1.0 + 2.0 * q))

    @ti.func
    def df(self, q):
        a = above(1.0 - 0.5 * q)
        return -3.0 * q * a * a if ti.static(self.dim == 1) else -5.0 * q * a * a * a

    @ti.func
    def ddf(self, q):
        a = above(1.0 - 0.5 * q)
        return 3.0 * a * (q - a) if ti.static(self.dim == 1) else a * a * (7.5 * q - 5.0 * a)


@dataclass(frozen=True)
class WendlandC4(Kernel):
    """f = (1-q/2)^6 (1+3q+35q^2/12); in 1-D (1-q/2)^5 (1+5q/2+2q^2). Never pairs; for long MHD runs."""

    h_fact: float = 1.5
    dim: int = 0
    norms = (3 / 4, 9 / (4 * pi), 495 / (256 * pi))

    @ti.func
    def f(self, q):
        a = above(1.0 - 0.5 * q)
        a4 = a * a * a * a
        return (
            a4 * a * (1.0 + q * (2.5 + 2.0 * q))
            if ti.static(self.dim == 1)
            else a4 * a * a * (1.0 + q * (3.0 + 35.0 / 12.0 * q))
        )

    @ti.func
    def df(self, q):
        a = above(1.0 - 0.5 * q)
        a4 = a * a * a * a
        return (
            -3.5 * q * (1.0 + 2.0 * q) * a4 if ti.static(self.dim == 1) else -14.0 / 3.0 * q * (1.0 + 2.5 * q) * a4 * a
        )

    @ti.func
    def ddf(self, q):
        a = above(1.0 - 0.5 * q)
        a3 = a * a * a
        return (
            -3.5 * a3 * ((1.0 + 4.0 * q) * a - 2.0 * q * (1.0 + 2.0 * q))
            if ti.static(self.dim == 1)
            else -14.0 / 3.0 * a3 * a * ((1.0 + 5.0 * q) * a - 2.5 * q * (1.0 + 2.5 * q))
        )


@dataclass(frozen=True)
class WendlandC6(Kernel):
    """f = (1-q/2)^8 (1+4q+25q^2/4+4q^3); in 1-D (1-q/2)^7 (1+7q/2+19q^2/4+21q^3/8). Never pairs; smoothest."""

    h_fact: float = 1.6
    dim: int = 0
    norms = (55 / 64, 78 / (28 * pi), 1365 / (512 * pi))

    @ti.func
    def f(self, q):
        a = above(1.0 - 0.5 * q)
        a2 = a * a
        a6 = a2 * a2 * a2
        return (
            a6 * a * (1.0 + q * (3.5 + q * (4.75 + 2.625 * q)))
            if ti.static(self.dim == 1)
            else a6 * a2 * (1.0 + q * (4.0 + q * (6.25 + 4.0 * q)))
        )

    @ti.func
    def df(self, q):
        a = above(1.0 - 0.5 * q)
        a2 = a * a
        a6 = a2 * a2 * a2
        return (
            -0.375 * q * a6 * (12.0 + q * (36.0 + q * 35.0))
            if ti.static(self.dim == 1)
            else -q * a6 * a * (5.5 + q * (19.25 + 22.0 * q))
        )

    @ti.func
    def ddf(self, q):
        a = above(1.0 - 0.5 * q)
        a5 = a * a * a * a * a
        return (
            -0.375 * a5 * (a * (12.0 + q * (72.0 + 105.0 * q)) - 3.0 * q * (12.0 + q * (36.0 + q * 35.0)))
            if ti.static(self.dim == 1)
            else -a5 * a * (a * (5.5 + q * (38.5 + 66.0 * q)) - 3.5 * q * (5.5 + q * (19.25 + 22.0 * q)))
        )


@dataclass(frozen=True)
class Gaussian(Kernel):
    """f = exp(-q^2), cut at q = 3 as in Inutsuka 2002 (the cut leaves out 1e-4 of the mass in 2-D).

    The exponential is a Taylor series of exp(-q^2/64) raised to the 64th power: exact to 1e-14 and, unlike a call of
    exp, vectorised.
    """

    h_fact: float = 1.2
    dim: int = 0
    support = 3.0
    norms = (1 / sqrt(pi), 1 / pi, pi**-1.5)

    @ti.func
    def f(self, q):
        z = ti.min(q * q, 9.0) * (-1.0 / 64.0)
        e = 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0 * (1.0 + z / 5.0 * (1.0 + z / 6.0 * (
            1.0 + z / 7.0 * (1.0 + z / 8.0 * (1.0 + z / 9.0))))))))  # fmt: skip
        for _ in ti.static(range(6)):
            e = e * e
        return ti.select(q < 3.0, e, 0.0)

    @ti.func
    def df(self, q):
        return -2.0 * q * self.f(q)

    @ti.func
    def ddf(self, q):
        return (4.0 * q * q - 2.0) * self.f(q)


KERNELS = (CubicSpline, QuinticSpline, WendlandC2, WendlandC4, WendlandC6, Gaussian)
