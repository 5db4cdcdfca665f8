"""Cures of the tensile instability side by side: what each leaves and what each breaks.

The Alfven wave of alfven_tensile (lecture pp. 17-20, physics 4.2), its lattice disordered by a twentieth of a spacing:
a perfect one hides most of the price (noise=0). What to see:

 * none: particles draw together along B, the wave is lost.
 * shift (Phillips & Monaghan 1985): one constant T0 leaves no stress negative. Momentum stays exact, but disordered
   particles are pushed about by T0: twice the error of xi = 1/2, and a hole opens where the lattice gives way. lift=1.2
   leaves a margin; lift=10 is what this gas feels if ten times the stress stands elsewhere: no hole, wrong velocities.
 * repulsion (Monaghan 2000): only delays. By the end it has clumped as without. On a lattice in order (noise=1e-7)
   eps=1 delays beyond t = 0.5, and eps=5 more than doubles the energy.
 * xi = 1/2 and xi = 1 (Borve et al. 2001): order is kept. Momentum drifts by 1e-4, as the ledger predicts; xi = 1
   breaks momentum and energy three times as much as xi = 1/2.
 * xi(beta): the least that is stable here, (1 - beta)/2 + 0.05, breaks energy least and keeps less order.

What the ledger does not explain is the time step's, most where particles clumped (70 times less in steps three times
shorter). It costs about 40 s on two cores.

    spmhd run tensile_cures
"""

from dataclasses import replace
from typing import Literal

from taichi_spmhd import hexagonal, jitter, load_scene
from taichi_spmhd.terms import DivBSource, LogLinearXi, MinimalXi, PhantomXi, Repulsion, StressShift

RULES = {"minimal": MinimalXi(), "log-linear": LogLinearXi(), "phantom": PhantomXi()}
WIDTH = 2040  # pixels: room for six panels in a row


def scenes(
    nx: int = 32,
    beta: float = 0.2,
    amplitude: float = 0.1,
    noise: float = 0.05,
    eps: float = 0.2,
    lift: float = 1.0,
    rule: Literal["minimal", "log-linear", "phantom"] = "minimal",
    t_end: float = 1.0,
):
    """noise: of the positions, in spacings; eps: of the repulsion; lift: of the shift; rule: of xi(beta)."""
    wave = load_scene("alfven_tensile", nx=nx, beta=beta, amplitude=amplitude, t_end=t_end)["xi = 0"]
    bare = wave.but(
        positions=jitter(hexagonal(wave.box, nx), wave.box, noise, seed=0), picture=replace(wave.picture, width=WIDTH)
    )
    return {
        "none": bare,
        "shift": bare.plus(StressShift(lift=lift)),
        "repulsion": bare.plus(Repulsion(eps=eps)),
        "xi = 1/2": bare.plus(DivBSource(xi=0.5)),
        "xi = 1": bare.plus(DivBSource(xi=1.0)),
        "xi(beta)": bare.plus(DivBSource(xi=RULES[rule])),
    }
