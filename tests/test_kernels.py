"""Kernels: norm, slope, change with h, support and width, in one, two and three dimensions."""

from functools import lru_cache
from math import pi

import numpy as np
import pytest

from taichi_spmhd import runtime
from taichi_spmhd.errors import InputError
from taichi_spmhd.kernels import (
    KERNELS,
    CubicSpline,
    Gaussian,
    QuinticSpline,
    WendlandC2,
    WendlandC4,
    WendlandC6,
)
from taichi_spmhd.runtime import ti

DIMENSIONS = (1, 2, 3)
STEP = 1e-5  # of the finite differences, in q
NODES, WEIGHTS = np.polynomial.legendre.leggauss(24)
# every spline is one polynomial between two whole numbers, so three panels integrate it to round-off
Q = np.concatenate([panel + 0.5 * (NODES + 1) for panel in range(3)])
dQ = np.tile(0.5 * WEIGHTS, 3)

# standard deviation / h in 1, 2, 3 dimensions: the table of the physics sheet, section 1 (1-D Wendland: its own family)
WIDTHS = {
    CubicSpline: (0.5774, 0.5624, 0.5477),
    QuinticSpline: (0.7071, 0.6951, 0.6831),
    WendlandC2: (0.6172, 0.5271, 0.5164),
    WendlandC4: (0.5164, 0.4606, 0.4529),
    WendlandC6: ((8 / 39) ** 0.5, 0.4140, 0.4083),  # the table leaves 1-D open: the exact second moment is 8/39
    Gaussian: (0.7071, 0.7071, 0.7071),
}
every_kernel = pytest.mark.parametrize("kind", KERNELS, ids=lambda kind: kind.__name__)
every_dimension = pytest.mark.parametrize("dim", DIMENSIONS)


@pytest.fixture(scope="module", autouse=True)
def taichi_runs():
    """A no-op where the session has started Taichi already with these values."""
    runtime.init(arch="cpu", precision="f64", threads=2)


def evaluate(kernel, q):
    """f, f' and dh at q, each of the shape of q."""

    @ti.kernel
    def fill(q: ti.types.ndarray(), f: ti.types.ndarray(), df: ti.types.ndarray(), dh: ti.types.ndarray()):
        for n in range(q.shape[0]):
            f[n], df[n], dh[n] = kernel.f(q[n]), kernel.df(q[n]), kernel.dh(q[n])

    q = np.ascontiguousarray(q, dtype=float)
    values = [np.empty_like(q) for _ in range(3)]
    fill(q, *values)
    return values


@lru_cache
def on_grid(kind, dim):
    """f, f', dh at Q and f at Q + STEP and Q - STEP, evaluated once for all tests."""
    f, df, dh = evaluate(kind().at(dim), np.concatenate([Q, Q + STEP, Q - STEP]))
    above, below = f[len(Q) :].reshape(2, -1)
    return f[: len(Q)], df[: len(Q)], dh[: len(Q)], above, below


def moment(kind, dim, power):
    """Integral of W r^power over space, for h = 1."""
    shell = (2.0, 2 * pi, 4 * pi)[dim - 1] * Q ** (dim - 1)
    return kind().at(dim).sigma * np.sum(on_grid(kind, dim)[0] * shell * Q**power * dQ)


@every_kernel
@every_dimension
def test_integrates_to_one(kind, dim):
    missing = (2.3e-5, 1.3e-4, 4.5e-4)[dim - 1]  # what the Gaussian loses by its cut at 3 h: erfc(3), exp(-9), ...
    low = 1 - missing if kind is Gaussian else 1 - 1e-12
    assert low <= moment(kind, dim, 0) <= 1 + 1e-12  # compact ones: 24-point quadrature is exact, only round-off


def test_the_cut_leaves_out_of_the_gaussian_what_the_physics_sheet_says():
    missing = [1 - moment(Gaussian, dim, 0) for dim in DIMENSIONS]
    assert missing == pytest.approx([2.209e-5, 1.234e-4, 4.398e-4], rel=1e-3)  # four digits of the analytic tails


@every_kernel
@every_dimension
def test_slope_is_the_derivative(kind, dim):
    f, df, _, above, below = on_grid(kind, dim)
    # second-order difference: third derivative STEP^2 / 6 and round-off 1e-16 / STEP are both below 1e-8 of f
    assert np.max(np.abs((above - below) / (2 * STEP) - df)) < 1e-7 * np.max(np.abs(f))


@every_kernel
@every_dimension
def test_change_with_h_is_the_derivative_with_respect_to_h(kind, dim):
    f, _, dh, _, _ = on_grid(kind, dim)
    h = np.array([1 - STEP, 1 + STEP])
    low, high = (evaluate(kind().at(dim), Q / width)[0] / width**dim for width in h)
    assert np.max(np.abs((high - low) / (2 * STEP) + dh)) < 1e-7 * np.max(np.abs(f))  # as for the slope


@every_kernel
@every_dimension
def test_vanishes_at_the_support_and_beyond(kind, dim):
    support = kind.support
    f, df, dh = evaluate(kind().at(dim), [support, np.nextafter(support, 9), support + 0.5, 10.0, 1e6])
    assert not f.any()
    assert not df.any()
    assert not dh.any()


@every_kernel
@every_dimension
def test_falls_monotonically_inside_the_support(kind, dim):
    f, df, _, _, _ = on_grid(kind, dim)
    inside = kind.support > Q
    assert np.all(f[inside] > 0)
    assert np.all(df[inside] < 0)


@every_kernel
@every_dimension
def test_has_the_width_of_the_table(kind, dim):
    width = WIDTHS[kind][dim - 1]
    loss = 1.1e-3 if kind is Gaussian else 0  # the cut takes away up to 0.15 % of the 3-D width
    assert np.sqrt(moment(kind, dim, 2) / dim) == pytest.approx(width, abs=6e-5 + loss)  # the table has 4 digits


@every_dimension
def test_gaussian_series_is_the_exponential(dim):
    q = np.linspace(0, np.nextafter(3, 0), 3001)
    f, df, _ = evaluate(Gaussian().at(dim), q)
    exact = np.exp(-q * q)
    # nine terms leave 1e-15, six squarings multiply the round-off by 64: below 1e-12 of the value, not only absolute
    assert np.max(np.abs(f / exact - 1)) < 1e-12
    assert np.max(np.abs(df + 2 * q * exact)) < 1e-12


def test_expected_neighbours_are_those_of_the_physics_sheet():
    expected = {  # section 1, the particle itself included
        CubicSpline: (4.8, 18.1, 57.9),
        QuinticSpline: (6, 28.3, 113),
        WendlandC2: (5.2, 21.2, 73.6),
        WendlandC4: (6, 28.3, 113),
        WendlandC6: (6.4, 32.2, 137),
    }
    for kind, counts in expected.items():
        assert [kind().at(dim).neighbours for dim in DIMENSIONS] == pytest.approx(counts, rel=5e-3)  # 3 digits given


def test_keeps_its_h_fact_when_the_dimension_is_set():
    kernel = QuinticSpline(h_fact=1.1).at(2)
    assert (kernel.h_fact, kernel.dim, type(kernel)) == (1.1, 2, QuinticSpline)


@pytest.mark.parametrize("h_fact", [0.0, -1.0, 11.0, float("nan")])
def test_refuses_an_h_fact_without_sense_and_says_what_is_usual(h_fact):
    with pytest.raises(InputError, match=r"1\.0 to 2\.0 is usual"):
        CubicSpline(h_fact=h_fact)


@every_kernel
@every_dimension
def test_bend_is_q_times_the_derivative_of_dh(kind, dim):
    # what the density solver carries its sums to the next h with: a wrong second derivative would show as a wrong Omega
    kernel, step = kind().at(dim), 1e-5
    q = np.linspace(0.01, 0.97 * kernel.support, 400)
    q = q[
        np.abs(q[:, None] - np.array([1.0, 2.0])).min(axis=1) > 2 * step
    ]  # the third derivative of splines jumps there

    @ti.kernel
    def fill(q: ti.types.ndarray(), bend: ti.types.ndarray()):
        for n in range(q.shape[0]):
            bend[n] = kernel.bend(q[n])

    bend = np.empty_like(q)
    fill(q, bend)
    (_, _, high), (_, _, low) = evaluate(kernel, q + step), evaluate(kernel, q - step)
    wrong = np.abs(q * (high - low) / (2 * step) - bend)
    assert (
        wrong.max() < 1e-7 * np.abs(bend).max()
    )  # a central difference is off by step^2 = 1e-10 of the fourth derivative
