"""Density from its own evolution equation: right only with the factor 1/Omega.

Lecture pp. 6-11. The gas of `blast` moves with its summed density rho; a passenger rho' starts from rho and follows
drho'/dt = sum_j m_j v_ij.grad W, once without and once with the factor 1/Omega. The picture shows rho_error = rho'/rho
- 1. Without Omega rho' is up to 29 % off at the contact (r = 0.2 to 0.3 at t = 0.2) and 15 % in the thin gas inside:
Omega - 1 is a few per cent, and the gas there thins to an eighth. With Omega rho' stays within 2 %; what is left is
the error of the time step and falls with its square. It costs about 20 s on two cores.

    spmhd run density_evolution --set nx=64
"""

from taichi_spmhd import Picture, load_scene
from taichi_spmhd.terms import PassiveDensity


def scenes(nx: int = 128, t_end: float = 0.2):
    """The same blast with either passenger."""
    blast = load_scene("blast", nx=nx, t_end=t_end)["blast"]
    blast = blast.but(picture=Picture("rho_error", limits=(-0.1, 0.1), draw="nearest"))
    return {
        "without Omega": blast.plus(PassiveDensity(Omega=False)),
        "with Omega": blast.plus(PassiveDensity(Omega=True)),
    }
