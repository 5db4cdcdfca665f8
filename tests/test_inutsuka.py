"""Inutsuka's own weights of pairs: integrals they stand for, conservation, Sod, a contact at rest, what is refused."""

import numpy as np
import pytest
from test_godunov_conservation import ROUND_OFF, scene, wandered
from test_godunov_parts import applied
from test_godunov_tubes import sod

from taichi_spmhd import Adiabatic, Gaussian, InputError, Simulation, TimeCentred
from taichi_spmhd.density import SumMass, SumVolume
from taichi_spmhd.godunov.between import BETWEEN
from taichi_spmhd.lattice import jitter, line
from taichi_spmhd.runtime import ti
from taichi_spmhd.scene import Scene
from taichi_spmhd.terms import GodunovHydro, GodunovMHD, Induction, Pressure, Viscosity



def pairs(n=200, seed=4):
    """Random m, rho, h, dV of i and of j, and the distance r: jumps of up to five, slopes of both signs."""
    random = np.random.default_rng(seed)
    return {
        **{f"{name}_{k}": random.uniform(0.4, 2.0, n) for name in ("m", "rho", "h") for k in "ij"},
        **{f"dV_{k}": random.normal(size=n) for k in "ij"},
        "r": random.uniform(0.3, 2.5, n),
    }


def weighed(density, given) -> np.ndarray:
    """Gi, Gj and the shift of each pair."""
    kernel = Gaussian().at(1)

    @ti.func
    def side(m, rho, h, dV):
        return ti.Struct(m=m, rho=rho, h=h, hinv=1 / h, dV=ti.Vector([dV]), g=density.g(kernel.sigma / h**2, 1.0, rho))

    @ti.func
    def row(q):
        i, j = side(q[0], q[2], q[4], q[6]), side(q[1], q[3], q[5], q[7])
        w = density.weights(i, j, ti.Vector([q[8]]), kernel)
        return ti.Vector([w.Gi, w.Gj, density.shift(i, j, w, kernel)])

    return applied(row, 3, *given.values())


def curve(slope, ends, q) -> np.ndarray:
    """The polynomial of V(s) through both, highest power first: V (and V') at +-r/2 solved for, (pairs, 4)."""
    V_i, V_j, half = ends["i"], ends["j"], 0.5 * q["r"]
    line = np.column_stack([0 * half, 0 * half, (V_i - V_j) / q["r"], 0.5 * (V_i + V_j)])
    if slope == "linear":
        return line
    s, one, none = np.array([half, -half]), np.ones_like(half), np.zeros_like(half)
    rows = [np.column_stack([x**3, x**2, x, one]) for x in s] + [np.column_stack([3 * x**2, 2 * x, one, none]) for x in s]
    cubic = np.linalg.solve(np.stack(rows, 1), np.column_stack([V_i, V_j, q["dV_i"], q["dV_j"]])[..., None])[..., 0]
    return np.where((q["dV_i"] * q["dV_j"] < 0)[:, None], line, cubic)


def integrals(slope, ends, q, h) -> tuple[np.ndarray, np.ndarray]:
    """< V^2 > and < s V^2 > along the axis, weighed with the product of both Gaussians of width h, by quadrature."""
    z, share = np.polynomial.legendre.leggauss(200)
    s = 6 * h[:, None] * z
    V = sum(c[:, None] * s ** (3 - k) for k, c in enumerate(curve(slope, ends, q).T))
    both = [np.exp(-((s - side * q["r"][:, None] / 2) ** 2) / h[:, None] ** 2) for side in (1, -1)]
    weight = share * both[0] * both[1]
    total = weight.sum(1)
    return (weight * V**2).sum(1) / total, (weight * s * V**2).sum(1) / total


MADE = {SumMass: lambda q: q["m_j"], SumVolume: lambda q: 1 / q["m_i"]}  # what multiplies V_ij^2 W'


@pytest.mark.parametrize("density", MADE)
@pytest.mark.parametrize("slope", BETWEEN)
def test_weights_and_shift_are_integrals_over_the_product_of_both_kernels(slope, density):
    q = pairs()
    V = {k: (q[f"m_{k}"] if density is SumVolume else 1) / q[f"rho_{k}"] for k in "ij"}
    square_i, square_j = (integrals(slope, V, q, q[h])[0] for h in ("h_i", "h_j"))
    h = 0.5 * (q["h_i"] + q["h_j"])
    square, moment = integrals(slope, V, q, h)
    Gi, Gj, shift = weighed(density(slope=slope), q).T
    for G, square_k, h_k in ((Gi, square_i, q["h_i"]), (Gj, square_j, q["h_j"])):
        wide = np.sqrt(2) * h_k
        dW = -2 * q["r"] / wide**3 / np.sqrt(np.pi) * np.exp(-((q["r"] / wide) ** 2))
        inside = q["r"] < 3 * wide
        assert G[inside] == pytest.approx((MADE[density](q) * square_k * dW)[inside], rel=1e-10)  # measured 1e-14
        assert (G[~inside] == 0).all() and 0.02 < (~inside).mean() < 0.5
    s = 2 * moment / square / q["r"]
    assert shift == pytest.approx(np.clip(s, -1, 1), abs=1e-10)  # measured 1e-14
    assert 0.05 < (abs(s) > 1).mean() < 0.6
