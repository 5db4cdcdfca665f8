"""MHD rotor: a dense disc spins in a field that brakes it with torsional Alfven waves.

Balsara & Spicer 1999; the first rotor problem of Toth 2000. rho = 10 and v = 20 r inside r = 0.1, light gas at rest
outside, B along x, P = 1. The wound-up field squeezes the disc into an oblong and carries its spin away: at t = 0.15
the middle, thinned to rho = 1, turns as a solid body still, but ten times slower. Next to it B^2/2 rises to 2.8 (beta
0.2): P must stay positive. Cleaning halves h |div B| / |B| and smooths the strongest field. Equal masses, so the disc
is resolved three times better than the gas around it. scheme=godunov keeps the disc's rim sharper: at nx = 40 the
largest rho is 10.2 (standard: 8.0). It costs about 100 s on two cores.

    spmhd run rotor --set nx=64
    spmhd run rotor --set nx=64 scheme=godunov
"""

import numpy as np

from taichi_spmhd import STIRRED, Adiabatic, Box, Picture, QuinticSpline, Scene, Scheme, hexagonal, in_scheme
from taichi_spmhd.lattice import even, staggered
from taichi_spmhd.terms import Cleaning, Conductivity, CullenDehnen, DivBSource, Induction, Resistivity, Stress

BOX = ((-0.5, 0.5), (-0.5, 0.5))
EDGE, OUTSIDE = 0.1, 0.115  # of the disc, and of the taper around it
RHO_DISC, V_EDGE, B0, P, GAMMA = 10.0, 2.0, 5 / np.sqrt(4 * np.pi), 1.0, 1.4


def taper(r):
    """1 in the disc, 0 in the gas around it, linear between; r has shape (N,)."""
    return np.clip((OUTSIDE - r) / (OUTSIDE - EDGE), 0.0, 1.0)


def start(x):
    """v = 20 (-y, x) in the disc, 2 taper (-y, x)/r around it; x has shape (N, 2)."""
    r = np.hypot(x[:, 0], x[:, 1])
    turn = V_EDGE * taper(r) / np.maximum(r, EDGE)
    v = np.stack([-turn * x[:, 1], turn * x[:, 0], np.zeros_like(r)], axis=1)
    return {"rho": 1 + (RHO_DISC - 1) * taper(r), "P": P, "v": v, "B": [B0, 0.0, 0.0]}


def positions(nx: int) -> tuple[np.ndarray, float]:
    """Equal masses (and which) as rho asks: a fine lattice in the disc, rings in the taper, a coarse lattice outside.

    Symmetric under half a turn, as the flow is. Each part holds its mass to one pair of particles.
    """
    coarse = outwards(hexagonal(BOX, nx))
    mass = 1.0 / len(coarse)
    rows = len(coarse) // nx
    half = even(EDGE * max(nx, rows) * np.sqrt(RHO_DISC)) + 4  # so that the fine lattice covers the disc
    size = half / np.sqrt(RHO_DISC) / np.array([nx, rows])
    fine = outwards(staggered(Box(tuple(-size), tuple(size)), 2 * half, 2 * half))
    inside, within = (even(density * np.pi * r**2 / mass) for density, r in ((RHO_DISC, EDGE), (1.0, OUTSIDE)))
    return np.concatenate([fine[:inside], *rings(mass), coarse[within:]]), mass


def outwards(x) -> np.ndarray:
    """The same points from the centre outwards, x and -x side by side."""
    angle = np.arctan2(x[:, 1], x[:, 0]) % np.pi
    return x[np.lexsort([angle.round(9), np.hypot(x[:, 0], x[:, 1]).round(9)])]


def rings(mass: float) -> list[np.ndarray]:
    """Rings of evenly spaced particles in the taper, as far apart as the particles in them."""
    r = np.linspace(EDGE, OUTSIDE, 1001)
    rho = 1 + (RHO_DISC - 1) * taper(r)
    layers, inside = (np.concatenate([[0], np.cumsum(f[1:] + f[:-1])]) for f in (np.sqrt(rho / mass), rho * r))
    count = max(1, round(layers[-1] * (r[1] - r[0]) / 2))
    edges = np.interp(np.linspace(0, layers[-1], count + 1), layers, r)
    holds = np.pi * (r[1] - r[0]) / mass * np.diff(np.interp(edges, r, inside))
    middles = 0.5 * (edges[1:] + edges[:-1])
    return [ring(radius, even(n), k) for k, (radius, n) in enumerate(zip(middles, holds, strict=True))]


def ring(radius: float, n: int, k: int) -> np.ndarray:
    """n (even) particles on a circle, turned by golden angles from ring to ring so that none line up."""
    angle = 2 * np.pi * np.arange(n) / n + 2.4 * k
    return radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def scenes(nx: int = 100, t_end: float = 0.15, scheme: Scheme = "standard"):
    """Without and with hyperbolic divergence cleaning. nx: particles along x of the gas outside."""
    x, mass = positions(nx)
    bare = Scene(
        box=BOX,
        positions=x,
        start=lambda x: {**start(x), "mass": mass},
        eos=Adiabatic(GAMMA),
        kernel=QuinticSpline(),
        terms=(Stress(), Induction(), DivBSource(xi=0.5), CullenDehnen(), Conductivity(), Resistivity()),
        t_end=t_end,
        picture=Picture("B", limits=(0.0, 2.4), draw="sph"),
    )
    variants = {"without cleaning": bare, "with cleaning": bare.plus(Cleaning())}
    return in_scheme(variants, scheme, **STIRRED)
