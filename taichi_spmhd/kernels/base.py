"""What all kernels share: norm, derivative with respect to h, neighbour number."""

from dataclasses import replace
from math import pi

from ..errors import InputError
from ..runtime import ti


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
