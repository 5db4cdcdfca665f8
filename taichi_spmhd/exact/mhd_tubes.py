"""The constant states of MHD shock tubes: what lies between the waves, where somebody has solved the tube exactly.

States are (rho, P, v_x, v_y, v_z, B_y, B_z) from left to right in units with mu0 = 1 (a literature value X/sqrt(4 pi)
is used as that number); B_x and gamma are uniform. gamma = 1 is an isothermal gas, P = c^2 rho. All tubes start with
a step at x = 0.
"""

from math import pi, sqrt
from typing import NamedTuple

S = sqrt(4 * pi)  # the literature's Gaussian unit of B


class Tube(NamedTuple):
    """A tube: gamma, B_x, the time at which it is looked at, its states and the waves between them.

    waves: one word for each pair of neighbouring states, empty where only the two outer states are known. "<" or ">"
    says which way a wave runs through the gas, then "shock", "alfven" (rotation), "fast" or "slow" (rarefactions);
    "contact" moves with it.
    """

    gamma: float
    B_x: float
    t: float
    states: tuple[tuple[float, ...], ...]
    waves: tuple[str, ...] = ()


# rj: Ryu & Jones 1995, ApJ 442, 228, with their number and letter
TUBES = {
    # Dai & Woodward 1994, the lecture's colliding flow. Inner states: exact solver MHDRiemannSolver (AstroKriel)
    "rj1a": Tube(
        5 / 3,
        5 / S,
        0.08,
        (
            (1.0, 20.0, 10.0, 0.0, 0.0, 5 / S, 0.0),
            (2.6797463, 150.98023067, 0.72112876, 0.23137985, 0.0, 3.83879219, 0.0),
            (2.67132411, 150.19019874, 0.72376235, 0.35683532, 0.0, 4.03789537, 0.0),
            (3.85079588, 150.19019874, 0.72376235, 0.35683532, 0.0, 4.03789537, 0.0),
            (3.74812374, 143.56639493, 0.70504897, -0.3880284, 0.0, 5.42713089, 0.0),
            (1.0, 1.0, -10.0, 0.0, 0.0, 5 / S, 0.0),
        ),
        ("<shock", "<slow", "contact", ">shock", ">shock"),
    ),
    "rj1b": Tube(5 / 3, 3 / S, 0.03, ((1.0, 1.0, 0, 0, 0, 5 / S, 0), (0.1, 10.0, 0, 0, 0, 2 / S, 0))),
    # all seven waves; the same solver
    "rj2a": Tube(
        5 / 3,
        2 / S,
        0.2,
        (
            (1.08, 0.95, 1.2, 0.01, 0.5, 3.6 / S, 2 / S),
            (1.490337, 1.65576976, 0.60587833, 0.11235074, 0.55686152, 1.43831584, 0.79906435),
            (1.490337, 1.65576976, 0.60587833, 0.22156708, 0.30124975, 1.57164644, 0.48701513),
            (1.6342995, 1.93167156, 0.57538332, 0.04760061, 0.24734175, 1.41255894, 0.43771777),
            (1.47345316, 1.93167156, 0.57538332, 0.04760061, 0.24734175, 1.41255894, 0.43771777),
            (1.30895071, 1.58436605, 0.53432016, -0.18410687, 0.17554122, 1.61028072, 0.49898696),
            (1.30895071, 1.58436605, 0.53432016, -0.09457165, -0.04728582, 1.50784402, 0.75392201),
            (1.0, 1.0, 0.0, 0.0, 0.0, 4 / S, 2 / S),
        ),
        ("<shock", "<alfven", "<shock", "contact", ">shock", ">alfven", ">shock"),
    ),
    "rj2b": Tube(5 / 3, 3 / S, 0.035, ((1.0, 1.0, 0, 0, 0, 6 / S, 0), (0.1, 10.0, 0, 2.0, 1.0, 1 / S, 0))),
    "rj3a": Tube(5 / 3, 0.0, 0.01, ((0.1, 0.4, 50.0, 0, 0, -1 / S, -2 / S), (0.1, 0.2, 0, 0, 0, 1 / S, 2 / S))),
    # two fast rarefactions, B_y/rho uniform: the fan's own integral up to v_x = 0. Ryu & Jones: .49653, .31134
    "rj3b": Tube(
        5 / 3,
        0.0,
        0.1,
        (
            (1.0, 1.0, -1.0, 0.0, 0.0, 1.0, 0.0),
            (0.49633369, 0.3111403, 0.0, 0.0, 0.0, 0.49633369, 0.0),
            (1.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0),
        ),
        ("<fast", ">fast"),
    ),
    # ends with a switch-on shock. Values tabulated in Splash, sharpened until every jump condition holds to round-off;
    # that table's densities .59550 and .23370 contradict its own velocities and are .59955 and .22337
    "rj4a": Tube(
        5 / 3,
        1.0,
        0.15,
        (
            (1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0),
            (0.59954591, 0.42628895, 0.81237325, -0.59961309, 0.0, 0.28431095, 0.0),
            (0.55151499, 0.37090459, 0.89415968, -0.54470126, 0.0, 0.31528383, 0.0),
            (0.41272332, 0.37090459, 0.89415968, -0.54470126, 0.0, 0.31528383, 0.0),
            (0.22336863, 0.12402463, 0.24722486, -0.91163546, 0.0, 0.43085615, 0.0),
            (0.2, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0),
        ),
        ("<fast", "<slow", "contact", ">shock", ">shock"),
    ),
    "rj4b": Tube(5 / 3, 1.3, 0.15, ((0.4, 0.52467, -0.66991, 0.98263, 0, 0.0025293, 0), (1.0, 1.0, 0, 0, 0, 1.0, 0))),
    "rj4c": Tube(5 / 3, 0.75, 0.15, ((0.65, 0.5, 0.667, -0.257, 0, 0.55, 0), (1.0, 0.75, 0.4, -0.94, 0, 0, 0))),
    "rj4d": Tube(5 / 3, 0.7, 0.16, ((1.0, 1.0, 0, 0, 0, 0, 0), (0.3, 0.2, 0, 0, 1.0, 1.0, 0))),
    # Dai & Woodward 1994: two shocks of Mach number 25; four digits as tabulated in Splash
    "mach25": Tube(
        5 / 3,
        4 / S,
        0.03,
        (
            (1.0, 1.0, 36.87, -0.1546, -0.03864, 4 / S, 1 / S),
            (3.982, 1806.0, 0.0, -0.07727, -0.01932, 15.95 / S, 3.988 / S),
            (1.0, 1.0, -36.87, 0.0, 0.0, 4 / S, 1 / S),
        ),
        ("<shock", ">shock"),
    ),
    # Balsara 1998: the outer states of 2a in isothermal gas, c = 1
    "isothermal": Tube(
        1.0, 2 / S, 0.2, ((1.08, 1.08, 1.2, 0.01, 0.5, 3.6 / S, 2 / S), (1.0, 1.0, 0, 0, 0, 4 / S, 2 / S))
    ),
}
