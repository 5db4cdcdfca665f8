"""Exact solutions: star states of known tubes, the reference profile of Sod, and waves that solve their equations."""

from math import asin, radians, sqrt
from pathlib import Path

import numpy as np
import pytest

from taichi_spmhd.errors import InputError
from taichi_spmhd.exact import alfven_wave, direction, frame, sod, sound_wave, star_state

REFERENCE = Path(__file__).parent / "reference" / "exact_sod_512.npz"

THINNED = 1 - 0.4 / sqrt(0.56)  # c*/c behind a rarefaction that takes gas (1, -2, 0.4) to rest: 1 + (gamma-1) v / (2 c)

# physics sheet 6.1, six digits: P*, v*, rho* left and right, speed of the right shock
TUBES = {
    "Sod, gamma 1.4": ((1, 0, 1), (0.125, 0, 0.1), 1.4, (0.303130, 0.927453, 0.426319, 0.265574, 1.752156)),
    "Sod, gamma 5/3": ((1, 0, 1), (0.125, 0, 0.1), 5 / 3, (0.293945, 0.841195, 0.479689, 0.229806, 1.844473)),
    "Inutsuka's weak tube": ((1, 0, 1), (0.5, 0, 0.2), 1.4, (0.509864, 0.542771, 0.618072, 0.953054, 1.141785)),
    "Inutsuka's strong tube": ((1, 0, 3000), (1, 0, 1e-7), 5 / 3, (1336.857, 31.66454, None, 4.0, 42.21938)),
    # Toro's tests 2 to 5 (his table 4.3), so that two rarefactions and two shocks are seen too; of test 2 the formula
    "two rarefactions": ((1, -2, 0.4), (1, 2, 0.4), 1.4, (0.4 * THINNED**7, 0.0, THINNED**5, THINNED**5, None)),
    "strong right shock": ((1, 0, 1000), (1, 0, 0.01), 1.4, (460.894, 19.5975, 0.57506, 5.99924, None)),
    "strong left shock": ((1, 0, 0.01), (1, 0, 100), 1.4, (46.0950, -6.19633, 5.99242, 0.57511, None)),
    "two shocks": (
        (5.99924, 19.5975, 460.894),
        (5.99242, -6.19633, 46.0950),
        1.4,
        (1691.64, 8.68975, 14.2823, 31.0426, None),
    ),
}


@pytest.mark.parametrize("left, right, gamma, known", TUBES.values(), ids=TUBES)
def test_star_state_of_known_tubes(left, right, gamma, known):
    star = star_state(left, right, gamma)
    found = (star.P, star.v, star.rho_left, star.rho_right, star.shocks[1])
    for value, wanted in zip(found, known, strict=True):
        if wanted is not None:
            assert value == pytest.approx(wanted, rel=1e-5, abs=1e-9)  # the numbers are printed with six digits


def test_the_mirrored_tube_has_the_mirrored_answer():
    star, turned = star_state((1, 0.3, 1), (0.5, 0.1, 0.2)), star_state((0.5, -0.1, 0.2), (1, -0.3, 1))
    assert (turned.P, turned.v) == pytest.approx((star.P, -star.v), rel=1e-13)
    assert turned.shocks[0] == pytest.approx(-star.shocks[1], rel=1e-13)
    x = np.linspace(-1, 1, 41)
    there, back = sod(x, 0.3, (1, 0.3, 1), (0.5, 0.1, 0.2)), sod(-x, 0.3, (0.5, -0.1, 0.2), (1, -0.3, 1))
    assert there["rho"] == pytest.approx(back["rho"], rel=1e-12)
    assert there["v"] == pytest.approx(-back["v"], rel=1e-12)


def test_sod_profile_equals_the_reference_of_another_code():
    with np.load(REFERENCE) as known:
        found = sod(known["x"], float(known["t"]), gamma=float(known["gamma"]))
        for ours, theirs in (("rho", "rho"), ("v", "vx"), ("P", "p")):
            assert np.max(np.abs(found[ours] - known[theirs])) < 1e-11  # that solver stops its iteration near 5e-13


def test_sod_conserves_mass_momentum_and_energy():
    edges = np.linspace(-0.5, 0.5, 200_001)
    x, t = 0.5 * (edges[1:] + edges[:-1]), 0.2
    now = sod(x, t)
    mean = {k: np.mean(f) for k, f in (("m", now["rho"]), ("p", now["rho"] * now["v"]))}
    energy = np.mean(now["rho"] * (0.5 * now["v"] ** 2 + now["u"]))
    # nothing has reached the ends: momentum grows by the pressure difference, the rest stays; 1e-5: one cell a jump
    assert mean["m"] == pytest.approx(0.5625, abs=1e-5)
    assert mean["p"] == pytest.approx(0.9 * t, abs=1e-5)
    assert energy == pytest.approx(0.5 * (1.0 + 0.1) / 0.4, abs=1e-5)


def test_sod_at_time_zero_is_the_two_states():
    start = sod(np.array([-0.1, 0.0, 0.1]) + 0.4, 0.0, x0=0.4)
    assert start["rho"].tolist() == [1.0, 0.125, 0.125]
    assert start["v"].tolist() == [0.0, 0.0, 0.0]


def test_sod_at_positions_of_particles_gives_velocity_vectors():
    x = np.column_stack([np.linspace(-0.4, 0.4, 9), np.zeros(9)])
    found = sod(x, 0.2)
    assert found["v"].shape == (9, 3)
    assert np.array_equal(found["v"][:, 0], sod(x[:, 0], 0.2)["v"])
    assert not found["v"][:, 1:].any()


def slope(f, at, step=1e-3):
    """Fourth-order central difference; for waves of length 1 its error is (2 pi)^5 step^4 / 30 = 3e-10."""
    return (8 * (f(at + step) - f(at - step)) - (f(at + 2 * step) - f(at - 2 * step))) / (12 * step)


def gradient(f, x):
    """d f / d x_a, shape (d, ...)."""
    return np.array([slope(lambda s, axis=axis: f(x + s * axis), 0.0) for axis in np.eye(x.shape[1])])


G_AND_S = direction(asin(2 / sqrt(5)), asin(2 / 3))  # physics sheet M4
WAVES = {
    "Toth's wave at 30 degrees": (2, {}),
    "along x in one dimension": (1, {"k_hat": (1.0,)}),
    "Gardiner and Stone in 3-D": (3, {"k_hat": G_AND_S}),
    "standing": (2, {"v_parallel": 1.0}),
    "large, dense, low beta, against k": (
        3,
        {"k_hat": (0, 0, 1), "amplitude": 2.0, "rho": 2.5, "B_parallel": -0.7, "v_parallel": 0.3, "pressure": 1e-3},
    ),
}
every_wave = pytest.mark.parametrize("dim, how", WAVES.values(), ids=WAVES)


@every_wave
def test_alfven_wave_of_any_amplitude_solves_ideal_mhd(dim, how):
    x, t = np.random.default_rng(0).random((20, dim)), 0.37
    now = alfven_wave(x, t, **how)
    v, B, rho = now["v"], now["B"], now["rho"][:, None]
    grad_v = gradient(lambda y: alfven_wave(y, t, **how)["v"], x)
    grad_B = gradient(lambda y: alfven_wave(y, t, **how)["B"], x)
    push = np.zeros_like(v)  # grad(P + B^2/2)
    push[:, :dim] = (gradient(lambda y: alfven_wave(y, t, **how)["P"], x) + np.einsum("nb,anb->an", B, grad_B)).T

    def along(a, grad):
        """(a.grad) f"""
        return np.einsum("na,anb->nb", a[:, :dim], grad)

    force = (along(B, grad_B) - push) / rho - along(v, grad_v)
    induction = along(B, grad_v) - along(v, grad_B)
    error = 1e-7  # differences: 3e-10 times a wave speed and an amplitude of up to 2, and round-off 1e-13
    assert np.max(np.abs(slope(lambda s: alfven_wave(x, s, **how)["v"], t) - force)) < error
    assert np.max(np.abs(slope(lambda s: alfven_wave(x, s, **how)["B"], t) - induction)) < error
    assert np.max(np.abs(np.einsum("ana->n", grad_v[..., :dim]))) < error
    assert np.max(np.abs(np.einsum("ana->n", grad_B[..., :dim]))) < error


@pytest.mark.parametrize(
    "k_hat, box",
    [(direction(radians(30)), (2 / sqrt(3), 2.0)), (G_AND_S, (3.0, 1.5, 1.5))],
    ids=["2-D", "3-D"],
)
def test_alfven_wave_fits_the_periodic_box_of_the_physics_sheet(k_hat, box):
    x = np.random.default_rng(1).random((10, len(box)))
    here = alfven_wave(x, 0.0, k_hat)
    for length, axis in zip(box, np.eye(len(box)), strict=True):
        there = alfven_wave(x + length * axis, 0.0, k_hat)
        assert np.max(np.abs(there["B"] - here["B"])) < 1e-14  # round-off


def test_alfven_wave_starts_as_toth_wrote_it():
    a, x = radians(30), np.array([[0.3, 0.2], [1.0, 1.7]])
    X = x @ [np.cos(a), np.sin(a)]
    across, up = 0.1 * np.sin(2 * np.pi * X), 0.1 * np.cos(2 * np.pi * X)
    start = alfven_wave(x, 0.0)
    v = np.column_stack([-across * np.sin(a), across * np.cos(a), up])
    assert start["v"] == pytest.approx(v, abs=1e-15)
    assert start["B"] - v == pytest.approx(np.tile([np.cos(a), np.sin(a), 0], (2, 1)), abs=1e-15)
    assert (start["P"].tolist(), start["rho"].tolist()) == ([0.1, 0.1], [1, 1])


def test_alfven_wave_moves_against_k_and_returns_after_one_period():
    k, x = direction(radians(30)), np.random.default_rng(2).random((5, 2))
    moved = alfven_wave(x - 0.25 * k[:2], 0.25)["B"]
    assert moved == pytest.approx(alfven_wave(x, 0.0)["B"], abs=1e-14)
    assert alfven_wave(x, 1.0)["B"] == pytest.approx(alfven_wave(x, 0.0)["B"], abs=1e-14)


@pytest.mark.parametrize("k_hat", [(1.0,), (0.0, -2.0), (0, 0, 1), (1, 2, 3)])
def test_frame_is_right_handed_and_orthonormal(k_hat):
    axes = frame(k_hat)
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-15)
    assert np.linalg.det(axes) == pytest.approx(1.0, abs=1e-14)


@pytest.mark.parametrize("amplitude", [1e-3, 1e-4])
def test_sound_wave_solves_the_gas_equations_to_second_order_in_its_amplitude(amplitude):
    x, t, gamma, P0, rho0 = np.linspace(0, 1, 17), 0.37, 1.4, 0.9, 1.3

    def wave(x, t):
        return sound_wave(x, t, amplitude, rho0, P0, gamma, v=0.4)

    now = wave(x, t)
    d_t = {name: slope(lambda s: wave(x, s)[name], t) for name in now}
    d_x = {name: slope(lambda s: wave(x + s, t)[name], 0.0) for name in now}
    second_order = 40 * amplitude**2  # products of two amplitudes times 2 pi and (1 + gamma) or so
    continuity = d_t["rho"] + now["v"] * d_x["rho"] + now["rho"] * d_x["v"]
    momentum = d_t["v"] + now["v"] * d_x["v"] + d_x["P"] / now["rho"]
    energy = d_t["P"] + now["v"] * d_x["P"] + gamma * now["P"] * d_x["v"]
    for rest in (continuity, momentum, energy):
        assert np.max(np.abs(rest)) < second_order
    assert np.max(np.abs(d_x["v"])) > 5 * amplitude  # the wave itself is first order: 2 pi c A


def test_sound_wave_of_the_physics_sheet_moves_right_with_period_one():
    x = np.linspace(0, 1, 11)
    start = sound_wave(x, 0.0)
    assert start["rho"] == pytest.approx(1 + 1e-4 * np.sin(2 * np.pi * x), abs=1e-15)
    assert start["v"] == pytest.approx(1e-4 * np.sin(2 * np.pi * x), abs=1e-15)
    assert sound_wave(x + 0.3, 0.3)["v"] == pytest.approx(start["v"], abs=1e-15)
    assert sound_wave(np.column_stack([x, x]), 0.0)["v"].shape == (11, 3)


WRONG = {
    "vacuum": (lambda: star_state((1, -20, 1), (1, 20, 1)), "vacuum"),
    "no pressure": (lambda: star_state((1, 0, 0), (1, 0, 1)), "positive rho and P"),
    "isothermal": (lambda: sod(np.zeros(1), 0.1, gamma=1.0), "above 1"),
    "before the start": (lambda: sod(np.zeros(1), -0.1), "opens at t = 0"),
    "no direction": (lambda: alfven_wave(np.zeros((1, 2)), 0.0, (0.0, 0.0)), "not zero"),
    "no density": (lambda: alfven_wave(np.zeros((1, 2)), 0.0, rho=0.0), "must be positive"),
    "four dimensions": (lambda: alfven_wave(np.zeros((1, 4)), 0.0), "d = 1, 2 or 3"),
    "cold gas": (lambda: sound_wave(np.zeros(1), 0.0, pressure=0.0), "must be positive"),
}


@pytest.mark.parametrize("call, cure", WRONG.values(), ids=WRONG)
def test_wrong_input_is_refused_in_one_line_with_the_cure(call, cure):
    with pytest.raises(InputError, match=cure) as caught:
        call()
    assert "\n" not in str(caught.value)
