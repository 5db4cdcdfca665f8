"""A peak of div B: it stays for ever, unless cleaning lets it run away as waves that fade.

Lecture pp. 27-30; Dedner et al. 2002, Tricco & Price 2012. B_x has a bump of radius r0 in a gas whose pressure the
field hardly disturbs: what is seen is the cleaning. Half of the bump's energy belongs to a gradient: that much must
go, and no more. Drawn is h |div B| / |B|. case:

    static, advected   at rest, or moving at (1, 1)
    jump               at rest; the step is ten times shorter for t in .05 .. .06. When it grows again, psi that was not
                       scaled with c_h makes energy out of nothing, a hundred times that of psi
    localised          a bump of a quarter of the width: two particles
    density            2:1 in density at x = -0.5 and through the middle of the bump, at x = 0.5; the same pressure
    free               a disc that expands into vacuum (until t = 0.2): operators that are not conjugate fail here

It costs about 15 s on two cores.

    spmhd run divergence_peak --set case=jump
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from taichi_spmhd import Adiabatic, Boundary, InputError, Picture, QuinticSpline, Scene, Term, displaced, square
from taichi_spmhd.boundary import everywhere
from taichi_spmhd.runtime import ti
from taichi_spmhd.terms import Cleaning, ConstantCleaning, Induction, Stress, TriccoPrice2012, Viscosity

BOX = ((-1.0, 1.0), (-1.0, 1.0))
P, B0, R0 = 6.0, 1 / np.sqrt(4 * np.pi), 1 / np.sqrt(8)  # R0: radius of the bump
DISC = 0.8  # radius of the disc with a free surface


@dataclass(frozen=True)
class Hesitation(Term):
    """dt <= 0.03 h/vw while start < t < end: a tenth of Courant's step"""

    start: float = 0.05
    end: float = 0.06

    @ti.func
    def max_dt(self, i, now):
        inside = (now.t > self.start) & (now.t < self.end)
        return ti.select(inside, 0.03 * i.h / i.vw, 1e30)


def bump(x, r0: float, middle: float):
    """B_x = B0 (q^8 - 2 q^4 + 1), q = r/r0 < 1, beside a uniform B_z; x has shape (N, 2)."""
    q = np.minimum(np.hypot(x[:, 0] - middle, x[:, 1]) / r0, 1.0)
    return B0 * np.stack([q**8 - 2 * q**4 + 1, 0 * q, 0 * q + 1], axis=1)


def dense(x):
    """2 between x = -0.5 and 0.5, 1 outside."""
    return np.where(np.abs(x) < 0.5, 2.0, 1.0)


def scenes(
    nx: int = 50,
    case: Literal["advected", "static", "jump", "localised", "density", "free"] = "advected",
    frame: Literal["flow", "eulerian"] = "flow",
    t_end: float | None = None,
):
    """Without cleaning, and with each. frame: in which the constant c_h carries psi."""
    if nx < 10:
        raise InputError(f"nx = {nx}: the bump is a third of the box wide; give at least 10, 50 is usual")
    x, jumps = square(BOX, nx), case == "density"
    if jumps:
        x = displaced(x, BOX, dense)
    mass = (6.0 if jumps else 4.0) / len(x)
    if case == "free":
        x = x[np.hypot(*x.T) < DISC]

    def start(x):
        B = bump(x, R0 / 4 if case == "localised" else R0, 0.5 if jumps else 0.0)
        v = np.array([1.0, 1.0, 0.0]) if case == "advected" else np.zeros(3)
        return {"rho": dense(x[:, 0]) if jumps else 1.0, "mass": mass, "P": P, "v": v, "B": B}

    bare = Scene(
        box=BOX,
        positions=x,
        start=start,
        eos=Adiabatic(5 / 3),
        kernel=QuinticSpline(),
        boundary=Boundary() if case == "free" else everywhere(),
        terms=(Stress(), Induction(), Viscosity(), *((Hesitation(),) if case == "jump" else ())),
        t_end=t_end if t_end is not None else 0.2 if case == "free" else 0.6,
        picture=Picture("div_B", limits=(1e-4, 1.0), log=True),
    )
    return {
        "without cleaning": bare,
        "constant c_h, undamped": bare.plus(ConstantCleaning(alpha=0.0, frame=frame)),
        "constant c_h, unscaled": bare.plus(ConstantCleaning(scaled=False, frame=frame)),
        "constant c_h": bare.plus(ConstantCleaning(frame=frame)),
        "Tricco & Price 2012": bare.plus(TriccoPrice2012()),
        "per-particle c_h": bare.plus(Cleaning()),
    }
