"""Smoothing kernels W(r, h) = sigma_d / h^d f(q), q = r/h, in one, two and three dimensions.

All are branch-free (differences clamped at zero), so that loops over neighbours vectorise; f(q) and f'(q) vanish for
q >= support. h = h_fact (m/rho)^(1/d); the default h_fact of each class is the one its neighbour number is known to
work with. Norms re-integrated in the tests. Sources: Monaghan 1992; Wendland 1995; Dehnen & Aly 2012; Price et al.
2018.
"""

from .base import Kernel, above
from .gaussian import Gaussian
from .splines import CubicSpline, QuinticSpline
from .wendland import WendlandC2, WendlandC4, WendlandC6

KERNELS = (CubicSpline, QuinticSpline, WendlandC2, WendlandC4, WendlandC6, Gaussian)

__all__ = ["KERNELS", "Kernel", "above", *(kind.__name__ for kind in KERNELS)]
