"""Linear theory of a smooth shear layer with a field along it: small waves exp(i k x) on rho(y), U(y), P, B_x = B.

    (d/dt + i k U) rho = - rho0' vy - rho0 div v             div v = i k vx + dvy/dy
    (d/dt + i k U) vx  = - U' vy - i k P / rho0
    (d/dt + i k U) vy  = ( - dP/dy + i k B by - B dbx/dy ) / rho0
    (d/dt + i k U) P   = - gamma P0 div v
    (d/dt + i k U) bx  = U' by - B dvy/dy
    (d/dt + i k U) by  = i k B vy

Ideal MHD by hand, Fourier-spectral in y (periodic, length 1), Runge-Kutta in time: nothing of the package is used.
"""

import numpy as np


def derivative(n: int) -> np.ndarray:
    """The matrix (n, n) of d/dy by Fourier series on n points of a period 1."""
    k = 2j * np.pi * np.fft.fftfreq(n, 1 / n)
    k[n // 2] = 0
    return np.fft.ifft(k[:, None] * np.fft.fft(np.eye(n), axis=0), axis=0).real


def operator(rho, U, P: float, gamma: float, B: float, k: float) -> np.ndarray:
    """A in dq/dt = A q, q = (rho, vx, vy, P, bx, by) on the points of rho and U, (n,)."""
    n = len(rho)
    D, one, no = derivative(n), np.eye(n), np.zeros((n, n))
    carried, light = -1j * k * np.diag(U), np.diag(1 / rho)
    squeeze = [-1j * k * one, -D]  # - div v from vx and vy
    rows = [
        [carried, *(np.diag(rho) @ part for part in squeeze), no, no, no],
        [no, carried, -np.diag(D @ U), -1j * k * light, no, no],
        [no, no, carried, -light @ D, -B * light @ D, 1j * k * B * light],
        [no, *(gamma * P * part for part in squeeze), carried, no, no],
        [no, no, -B * D, no, carried, np.diag(D @ U)],
        [no, no, 1j * k * B * one, no, no, carried],
    ]
    rows[0][2] = rows[0][2] - np.diag(D @ rho)
    return np.block(rows)


def mode_of_vy(rho, U, P: float, gamma: float, B: float, k: float, times, weight) -> np.ndarray:
    """|weighted mean of vy| at these times, for vy = sin(k x) everywhere at t = 0; weight (n,)."""
    n, A, dt = len(rho), operator(rho, U, P, gamma, B, k), 0.004  # stable: c_s times the largest wave number is 410
    q, at, out = np.zeros(6 * n, complex), 0.0, []
    q[2 * n : 3 * n] = 1
    for until in times:
        steps = round((until - at) / dt)
        for _ in range(steps):  # classical Runge-Kutta: the Taylor series of exp(A dt) to fourth order
            term = q
            for order in (1, 2, 3, 4):
                term = dt / order * (A @ term)
                q = q + term
        at = until
        out.append(abs((weight * q[2 * n : 3 * n]).sum()) / weight.sum())
    return np.array(out)
