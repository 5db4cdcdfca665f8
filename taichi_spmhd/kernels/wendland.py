"""Wendland kernels: they never pair, at any number of neighbours."""

from dataclasses import dataclass
from math import pi

from ..runtime import ti
from .base import Kernel, above


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
