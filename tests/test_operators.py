"""Each operator against analytic fields, on particles that are no lattice: errors stated, and how they fall.

Two sets. `bent`: a lattice moved by a smooth map, rows bent and stretched by 20 %, no symmetry left: the summation's
errors are those of smooth gas and must fall with h^2. `jittered`: 0.1 spacings of noise: the error of a sum over noisy
places does not fall with h (a gradient is exact only to the noise), it falls with the number of neighbours. The
established codes test themselves this way (Price et al. 2018, PASA 35, e031, section 5.1).
"""

import numpy as np
import pytest

from taichi_spmhd import Scene, SumMass, WendlandC4
from taichi_spmhd.diagnostics.field import differences
from taichi_spmhd.lattice import cubic, jitter, square
from taichi_spmhd.terms import Cleaning, DivBSource, Induction, Stress

K = 2 * np.pi
EPSILON = np.array([[np.cross(a, b) for b in np.eye(3)] for a in np.eye(3)])  # curl_c = EPSILON_abc d_a B_b
XI, SIGMA = 0.5, 0.3
TERMS = (Stress(), Induction(), DivBSource(xi=XI), Cleaning(sigma=SIGMA))


class Waves:
    """A vector field of a wave a component, A_c = mean + swing sin(2 pi n.x + phase), and its exact gradient."""

    def __init__(self, means, swings, waves, phases):
        self.means, self.swings, self.n, self.phases = map(np.array, (means, swings, waves, phases))

    def angle(self, x):
        return K * x @ self.n[:, : x.shape[1]].T + self.phases

    def __call__(self, x):
        return self.means + self.swings * np.sin(self.angle(x))

    def gradient(self, x):
        """[i, a, c] = d A_c / d x_a, shape (N, 3, C)."""
        slope = K * self.swings * np.cos(self.angle(x))
        n = self.n.copy()
        n[:, x.shape[1] :] = 0  # nothing varies along a dimension that is not there
        return slope[:, None, :] * n.T[None]


B = Waves([0.8, -0.5, 0.3], [0.5, 0.4, 0.6], [[1, 1, 0], [1, 0, 1], [1, 1, 1]], [0.3, 1.1, 2.0])
V = Waves([0.1, 0.2, -0.3], [0.7, 0.5, 0.4], [[1, 0, 1], [1, 1, 0], [0, 1, 1]], [0.5, 0.1, 1.7])
P = Waves([2.0], [0.5], [[1, 1, 1]], [0.9])
PSI = Waves([0.2], [0.6], [[1, -1, 1]], [0.4])


def bent(nx, dim):
    """A lattice under a smooth periodic map."""
    box = (1.0,) * dim
    x = (square if dim == 2 else cubic)(box, nx)
    turned = np.roll(x, 1, axis=1)
    return np.mod(x + 0.03 * np.sin(K * turned) + 0.02 * np.sin(K * (x + turned) + 1.0), 1.0)


def scene(x, kernel):
    dim = x.shape[1]
    return Scene(
        box=(1.0,) * dim,
        positions=x,
        start=lambda x: {"rho": 1.0, "P": P(x)[:, 0], "v": V(x), "B": B(x), "psi": PSI(x)[:, 0]},
        kernel=kernel,
        density=SumMass(tolerance=1e-10),
        terms=TERMS,
    )


def exact(x, c):
    """What the rates stand for: force, (B.grad) v, div B, and those of cleaning; rho and c_h as the particles say."""
    field, gradB, div = B(x), B.gradient(x), np.trace(B.gradient(x), axis1=1, axis2=2)
    tension = np.einsum("ia,iac->ic", field, gradB) + (1 - XI) * field * div[:, None]
    force = tension - np.einsum("iac,ic->ia", gradB, field) - P.gradient(x)[..., 0]
    div_v = np.trace(V.gradient(x), axis1=1, axis2=2)
    psi, ch, h = PSI(x)[:, 0], c["ch"], c["h"]
    return {
        "force": force,
        "dB/dt and grad psi": np.einsum("ia,iac->ic", field, V.gradient(x)) - PSI.gradient(x)[..., 0],
        "dy/dt": -ch * div - SIGMA * psi / h - 0.5 * psi / ch * div_v,
        "div B": div,
        "curl B": np.einsum("abc,iab->ic", EPSILON, gradB),
    }


def found(sim):
    """The same of the simulation."""
    rates, c = sim.rates(), sim.columns()
    field = differences(sim)
    rho = c["rho"][:, None]
    return {
        "force": rho * rates["v"],
        "dB/dt and grad psi": rho * rates["b"],
        "dy/dt": rates["y"],
        "div B": field["div_B"],
        "curl B": field["curl_B"],
    }


def rms(values):
    return float(np.sqrt((values**2).mean()))


def errors(sim):
    """r.m.s. error over r.m.s. value, by operator."""
    c, ours = sim.columns(), found(sim)
    theirs = exact(c["x"], c)
    return {name: rms(ours[name] - values) / rms(values) for name, values in theirs.items()}


# r.m.s. errors measured on the bent set at the finer of the two sizes, Wendland C4; the gates leave a tenth
BENT = {
    2: ((32, 64), {"force": 0.0385, "dB/dt and grad psi": 0.0096, "dy/dt": 0.0041, "div B": 0.0064, "curl B": 0.0056}),
    3: ((16, 32), {"force": 0.0755, "dB/dt and grad psi": 0.0322, "dy/dt": 0.0249, "div B": 0.0266, "curl B": 0.0262}),
}
ORDER = 1.65  # measured 1.81 to 2.35 in 2-D, 1.70 to 2.02 in 3-D: the coarse set of 16 across has a share of h^4


@pytest.mark.parametrize("dim", [2, 3])
def test_every_operator_converges_with_the_square_of_h_on_a_bent_lattice(simulate, dim):
    sizes, gates = BENT[dim]
    coarse, fine = (errors(simulate(scene(bent(nx, dim), WendlandC4()))) for nx in sizes)
    assert set(fine) == set(gates)
    for name, gate in gates.items():
        assert fine[name] < gate, name
        assert np.log2(coarse[name] / fine[name]) > ORDER, name


def test_more_neighbours_lower_every_error_on_jittered_particles(simulate):
    """Doubling h: differences (div B) err by 11 % and 3 %, symmetric sums (the conservative force) by 13 and 1.5.

    That the conservative force is wrong on noise is the price of its conservation: it is what drives particles back to
    order, and why a test of accuracy starts from a lattice. The gates leave a third.
    """
    x = jitter(square((1.0, 1.0), 64), (1.0, 1.0), 0.1, seed=4)
    few, many = (errors(simulate(scene(x, WendlandC4(h_fact=h)))) for h in (1.2, 2.4))
    assert many["div B"] < 0.045 and many["dy/dt"] < 0.035
    assert few["div B"] > 2.5 * many["div B"] and few["dy/dt"] > 1.8 * many["dy/dt"]
    assert many["force"] < 2.0 and many["dB/dt and grad psi"] < 0.45
    assert few["force"] > 6 * many["force"] and few["dB/dt and grad psi"] > 6 * many["dB/dt and grad psi"]
