"""Cures of the tensile instability side by side: what each leaves and what each breaks.

The Alfven wave of alfven_tensile, its lattice disordered by some hundredths of a spacing.

    spmhd run tensile_cures
"""

from dataclasses import replace
from typing import Literal

from taichi_spmhd import hexagonal, jitter, load_scene
from taichi_spmhd.terms import DivBSource, LogLinearXi, MinimalXi, PhantomXi, Repulsion, StressShift

RULES = {"minimal": MinimalXi(), "log-linear": LogLinearXi(), "phantom": PhantomXi()}
WIDTH = 1800  # pixels: room for six panels in a row


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
