"""Flux freezing: which form of induction keeps which field exactly.

Lecture pp. 5, 12. A standing wave of velocity 0.1 c_s squeezes gas with a weak field (1-D, 200 steps at nx = 100). With
B along v nothing may happen to B: the form that evolves B keeps it to round-off, the one that evolves B/rho errs by the
time step, since rho is summed and B/rho integrated. With B across v, |B| must follow rho: now B/rho is kept to the bit
and B errs by the time step. What is drawn is that relative error. It costs about 2 s on two cores.

    spmhd run frozen_field
"""

from dataclasses import dataclass

import numpy as np

from taichi_spmhd import Adiabatic, Picture, QuinticSpline, Scene, SumMass, Term, line
from taichi_spmhd.runtime import ti
from taichi_spmhd.terms import Induction, Stress
from taichi_spmhd.types import real, vec3

BOX = (1.0,)
RHO, P, GAMMA = 1.0, 0.6, 5 / 3  # c_s = 1


@dataclass(frozen=True)
class Thaw(Term):
    """thaw = B_x/B_x(0) - 1 along v,   (B_y/rho)/(B_y/rho)(0) - 1 across: 0 where the field is frozen in"""

    across: bool = False
    reads, makes, keeps = {"B": vec3, "rho": real}, {"thaw": real}, {"frozen_at": real}

    @ti.func
    def measured(self, i):
        found = i.B.x
        if ti.static(self.across):
            found = i.B.y / i.rho
        return found

    @ti.func
    def open(self, i, now):
        return ti.Struct(frozen_at=self.measured(i))

    @ti.func
    def close(self, i, now):
        return ti.Struct(thaw=self.measured(i) / i.frozen_at - 1.0)


def scenes(nx: int = 100, beta: float = 100.0, amplitude: float = 0.1, t_end: float = 0.6):
    """amplitude: of v, in c_s; beta = 2P/B^2."""
    B0 = np.sqrt(2 * P / beta)

    def variant(across: bool, form: str) -> Scene:
        def start(x):
            v = np.zeros((len(x), 3))
            v[:, 0] = amplitude * np.sin(2 * np.pi * x[:, 0])
            return {"rho": RHO, "P": P, "v": v, "B": [0.0, B0, 0.0] if across else [B0, 0.0, 0.0]}

        return Scene(
            box=BOX,
            positions=line(BOX, nx),
            start=start,
            eos=Adiabatic(GAMMA),
            kernel=QuinticSpline(),
            density=SumMass(tolerance=1e-12),
            terms=(Stress(), Induction(form=form), Thaw(across=across)),
            t_end=t_end,
            picture=Picture("thaw", limits=(-2e-5, 2e-5)),
        )

    return {
        f"{way}, {form} evolved": variant(way == "B across v", form)
        for way in ("B along v", "B across v")
        for form in ("B", "B/rho")
    }
