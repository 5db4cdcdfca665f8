"""The thin shell against its own differential equation, a table made elsewhere, and the mass it must hold."""

import numpy as np
import pytest

from taichi_spmhd import InputError
from taichi_spmhd.exact import shell_profile, thin_shell

T = np.linspace(0.05, 0.5, 10)


def test_the_shell_moves_as_an_integration_in_time_says():
    # X(t) and dX/dt of the same problem, integrated in time from an assumed start 0.9 sqrt(P_h/rho_c): four digits, of
    # which the start spoils the last. The function integrates dX/dt(X) from the limit at s = 0 instead
    place, speed, *_ = thin_shell(T[1::2])
    assert place == pytest.approx([0.2928, 0.3759, 0.4526, 0.5246, 0.5929], abs=2e-4)
    assert speed == pytest.approx([0.871, 0.795, 0.741, 0.700, 0.667], abs=6e-4)


def test_the_momentum_of_the_swept_mass_changes_by_the_pressures():
    hot, cold, X0, dt = (0.05, 4.0), (2.0, 0.2), 0.3, 1e-4

    def momentum(t):
        shell = thin_shell(t, hot, cold, X0)
        return cold[0] * (shell.X - X0) * shell.v

    rate = (momentum(T + dt) - momentum(T - dt)) / (2 * dt)  # central: its error is dt^2 times a third derivative
    assert rate == pytest.approx(thin_shell(T, hot, cold, X0).P - cold[0] * cold[1] ** 2, rel=1e-6)
    speed = (thin_shell(T + dt, hot, cold, X0).X - thin_shell(T - dt, hot, cold, X0).X) / (2 * dt)
    assert speed == pytest.approx(thin_shell(T, hot, cold, X0).v, rel=1e-6)


def test_the_shell_starts_at_the_speed_that_balances_the_pressures():
    shell = thin_shell(np.array([0.0, 1e-9]))
    assert shell.v == pytest.approx(np.sqrt(1 - 0.01), rel=1e-7)
    assert shell.P_shock == pytest.approx(1.0, rel=1e-7) and shell.X[0] == 0.2


def test_the_profile_holds_the_mass_of_hot_and_swept_gas_and_joins_the_pressures():
    t, edge = 0.3, np.linspace(0, 1.2, 1_200_001)
    x = 0.5 * (edge[1:] + edge[:-1])
    found, shell = shell_profile(x, t), thin_shell(t)
    dense = found["rho"] > 2
    assert found["rho"][x < shell.X].mean() * shell.X == pytest.approx(0.01 * 0.2, rel=1e-6)
    # the shell is a hundred times thinner than what it swept: a cell of the sum is 1e-4 of it
    assert found["rho"][dense].sum() * 1e-6 == pytest.approx(shell.X - 0.2, rel=1e-3)
    assert found["P"][dense][[0, -1]] == pytest.approx([shell.P, shell.P_shock], rel=1e-3)
    assert (found["v"][dense] == shell.v).all() and (found["v"][x > 0.6] == 0).all()
    assert shell_profile(np.zeros((3, 2)), t)["v"].shape == (3, 3)
    start = shell_profile(x, 0.0)
    assert start["P"] == pytest.approx(np.where(x < 0.2, 1.0, 0.01), rel=1e-12)


@pytest.mark.parametrize(
    ("call", "cure"),
    [
        (lambda: thin_shell(0.1, hot=(0.01, 1.0)), "higher pressure"),
        (lambda: thin_shell(0.1, X0=0.0), "must be positive"),
        (lambda: thin_shell(-0.1), "starts at t = 0"),
    ],
)
def test_a_shell_that_cannot_be_is_refused(call, cure):
    with pytest.raises(InputError, match=cure):
        call()
