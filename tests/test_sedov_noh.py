"""Round shocks: Sedov's explosion and Noh's implosion, the exact solutions and runs against them."""

import numpy as np
import pytest

from taichi_spmhd import InputError, Simulation, exact, load_scene
from taichi_spmhd.exact.sedov import sedov_xi0

# closed form of Kamm (2000), evaluated for the physics sheet, H4
XI0 = {(5 / 3, 1): 1.18370, (5 / 3, 2): 1.15379, (5 / 3, 3): 1.15167}
XI0 |= {(1.4, 1): 0.97543, (1.4, 2): 1.00402, (1.4, 3): 1.03278}


@pytest.mark.parametrize(("gamma", "dim"), XI0)
def test_the_constant_of_sedov_is_that_of_the_closed_form(gamma, dim):
    assert sedov_xi0(gamma, dim) == pytest.approx(XI0[gamma, dim], abs=6e-6)  # the table has five decimals


@pytest.mark.parametrize("dim", [1, 2, 3])
def test_sedovs_profile_holds_the_mass_it_swept_up_and_the_energy_it_was_given(dim):
    t = exact.sedov_time(0.4, dim=dim, energy=2.0)
    edges = np.linspace(0, 0.4, 4001)
    r = 0.5 * (edges[1:] + edges[:-1])
    now = exact.sedov(np.pad(r[:, None], ((0, 0), (0, dim - 1))), t, energy=2.0)
    shell = (2, 2 * np.pi, 4 * np.pi)[dim - 1] * r ** (dim - 1) * np.diff(edges)
    density = 0.5 * now["rho"] * now["v"][:, 0] ** 2 + now["P"] / (5 / 3 - 1)
    # midpoints on 4000 cells; rho rises by 4 in the last few per cent of the radius
    assert shell @ now["rho"] == pytest.approx((2, np.pi, 4 / 3 * np.pi)[dim - 1] * 0.4**dim, rel=1e-4)
    assert shell @ density == pytest.approx(2.0, rel=1e-4)


def test_sedov_at_time_zero_is_gas_at_rest():
    start = exact.sedov(np.array([[0.0, 0.0], [0.1, 0.2]]), 0.0)
    assert start["rho"].tolist() == [1.0, 1.0]
    assert not start["v"].any() and not start["P"].any()


@pytest.mark.parametrize("dim", [1, 2, 3])
def test_noh_keeps_mass_momentum_and_energy_across_its_shock(dim):
    # just inside and outside of R = t/3, which moves at S = 1/3: S [U] = [F], exactly
    inside, outside = (exact.noh(np.array([[r] + [0.0] * (dim - 1)]), 0.6) for r in (0.2 - 1e-13, 0.2 + 1e-13))

    def conserved(f):
        rho, v, P = f["rho"][0], f["v"][0, 0], f["P"][0]
        E = 1.5 * P + 0.5 * rho * v * v
        return np.array([rho, rho * v, E]), np.array([rho * v, rho * v * v + P, (E + P) * v])

    (U0, F0), (U1, F1) = conserved(inside), conserved(outside)
    assert np.abs((U1 - U0) / 3 - (F1 - F0)).max() < 1e-9
    assert inside["rho"][0] == pytest.approx(4.0**dim)


def test_explosions_without_an_answer_are_refused():
    with pytest.raises(InputError, match="gamma"):
        exact.sedov_radius(1.0, gamma=1.0)
    with pytest.raises(InputError, match="energy"):
        exact.sedov(np.zeros((1, 2)), 0.1, energy=0.0)
    with pytest.raises(InputError, match="gamma"):
        exact.noh(np.zeros((1, 2)), 0.1, gamma=0.9)


def ended(name: str, **numbers):
    """Radius, density and radial velocity of the particles at the end, errors, time."""
    (scene,) = load_scene(name, **numbers).values()
    with Simulation(scene) as sim:
        c = sim.run().columns()
        summary, t = sim.summary(), sim.time
    r = np.linalg.norm(c["x"], axis=1)
    assert summary["floors"] == 0
    return r, c["rho"], (c["v"][:, : c["x"].shape[1]] * c["x"]).sum(axis=1) / r, summary["errors"], t


def front(r, f, width: float) -> float:
    """Outermost radius at which the mean of f in rings falls through half of its largest value."""
    rings = np.arange(0, r.max(), width)
    number = np.digitize(r, rings)
    mean = np.array([f[number == n].mean() for n in range(1, len(rings)) if (number == n).any()])
    at = np.array([r[number == n].mean() for n in range(1, len(rings)) if (number == n).any()])
    k = np.flatnonzero(mean > 0.5 * mean.max())[-1]
    return float(np.interp(0.5 * mean.max(), mean[k : k + 2][::-1], at[k : k + 2][::-1]))


def sedov_radius(nx: int, **numbers) -> float:
    """Where the run's shock stands at the end, exactly 0.4: v falls to half of its peak."""
    r, _, v, _, _ = ended("sedov", nx=nx, **numbers)
    return front(r, v, 0.64 / nx)


def test_sedovs_shock_stands_one_kernel_outside_of_its_place():
    # measured 0.413 where a spacing is 0.0146: the kernel carries the shock ahead, by less when refined (see below)
    assert 0.4 < sedov_radius(64) < 0.4 + 1.5 * 0.0146


@pytest.mark.slow
def test_sedovs_shock_comes_nearer_to_its_place_when_refined():
    # measured 0.4132 and 0.4081, order 0.7; without noise 0.4181 and 0.4086, first order, but bulged along the rows
    coarse, fine = (sedov_radius(nx) - 0.4 for nx in (64, 128))
    assert 0 < fine < 0.7 * coarse


@pytest.mark.slow
def test_sedovs_shock_stands_within_one_and_a_half_spacings_in_3_d():
    # measured 0.423
    assert 0.4 < sedov_radius(32, dim=3) < 0.4 + 1.5 / 32


def noh_plateau(nx: int):
    """Median density between wall heating and shock, exactly 16; the normalised L1 error of rho."""
    r, rho, _, errors, t = ended("noh", nx=nx)
    behind = (r > t / 6) & (r < 0.9 * t / 3)
    return float(np.median(rho[behind])), errors["rho"]


def test_noh_piles_up_nearly_sixteenfold():
    # measured 14.4: gas falling together smoothly is already heated by the viscosity, less when refined
    rho, _ = noh_plateau(64)
    assert 14 < rho < 16


@pytest.mark.slow
def test_noh_converges_to_first_order():
    # measured 14.4 and 15.2 (deficits 1.6 and 0.8), L1 .208 and .103
    (rho_64, error_64), (rho_128, error_128) = noh_plateau(64), noh_plateau(128)
    assert 16 - rho_128 < 0.6 * (16 - rho_64)
    assert error_128 < 0.6 * error_64
