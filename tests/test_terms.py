"""Every term against the lecture's sums, written a second time in numpy over all pairs; f64, relative 1e-12."""

import numpy as np
import pytest

from taichi_spmhd.terms import (
    Cleaning,
    Conductivity,
    CullenDehnen,
    DivBSource,
    Induction,
    PassiveDensity,
    Pressure,
    Resistivity,
    Stress,
    Viscosity,
)

# Sums over some 20 neighbours in another order differ by 1e-15 of the largest pair; pairs cancel to a few per cent,
# and h is solved to 1e-13.
EQUAL = 1e-12


def cubic(q):
    """f and f' of the cubic spline in its textbook form (physics.md section 1), with its norm in 2-D."""
    f = np.where(q < 1, 1 - 1.5 * q**2 + 0.75 * q**3, np.where(q < 2, 0.25 * (2 - q) ** 3, 0))
    df = np.where(q < 1, -3 * q + 2.25 * q**2, np.where(q < 2, -0.75 * (2 - q) ** 2, 0))
    return 10 / (7 * np.pi) * f, 10 / (7 * np.pi) * df


def dot(a, b):
    return (a * b).sum(axis=-1)


class Reference:
    """Density and rates by summing over all pairs of a 2-D periodic set; arrays [i, j] are pairs."""

    def __init__(self, columns, box, h_fact=1.2):
        self.c, self.h_fact = columns, h_fact
        apart = columns["x"][:, None] - columns["x"][None]
        apart -= np.array(box) * np.round(apart / np.array(box))
        self.r = np.linalg.norm(apart, axis=-1)
        self.e = np.pad(apart, ((0, 0), (0, 0), (0, 1))) / (self.r + np.eye(len(self.r)))[..., None]
        self.m = columns["m"]
        self.solve(columns["h"])
        self.weigh()

    def solve(self, h):
        """h, rho and Omega: Newton's method from a start nearby."""
        for _ in range(8):
            f, df = cubic(self.r / h[:, None])
            self.rho = (self.m * f).sum(1) / h**2
            slope = -(self.m * (2 * f + self.r / h[:, None] * df)).sum(1) / h**3
            wanted = self.m * (self.h_fact / h) ** 2
            self.h, h = h, h - (self.rho - wanted) / (slope + 2 * wanted / h)
        self.Omega = 1 + self.h / (2 * self.rho) * slope

    def weigh(self):
        """Gi = m_j W'(r, h_i)/(Omega_i rho_i^2), and Gj likewise."""
        own = 1 / (self.Omega * self.rho**2 * self.h**3)
        self.Gi = self.m * own[:, None] * cubic(self.r / self.h[:, None])[1]
        self.Gj = self.m * own[None] * cubic(self.r / self.h[None])[1]
        self.Di, self.Dj = self.Gi, self.Gj
        self.vij = self.c["v"][:, None] - self.c["v"][None]
        self.mu = dot(self.vij, self.e)
        self.drho = self.rho**2 * (self.Gi * self.mu).sum(1)

    def sum(self, weight):
        """sum_j weight_ij e_ij"""
        return (weight[..., None] * self.e).sum(1)

    def along(self, B):
        """B_i.e and B_j.e"""
        return dot(B[:, None], self.e), dot(B[None], self.e)

    def pressure(self, P):
        return {"v": -self.sum(P[:, None] * self.Gi + P * self.Gj), "u": self.c["P"] / self.rho**2 * self.drho}

    def stress(self):
        B = self.c["B"]
        Bi, Bj = self.along(B)
        pull = (Bi * self.Gi)[..., None] * B[:, None] + (Bj * self.Gj)[..., None] * B
        rates = self.pressure(self.c["P"] + 0.5 * dot(B, B))
        return {**rates, "v": rates["v"] + pull.sum(1)}

    def induction(self):
        return {"b": -((self.along(self.c["B"])[0] * self.Gi)[..., None] * self.vij).sum(1)}

    def S(self):
        Bi, Bj = self.along(self.c["B"])
        return (Bi * self.Gi + Bj * self.Gj).sum(1)

    def source(self, xi):
        force = -xi * self.S()[:, None] * self.c["B"]
        return {"v": force, "leak_v": force, "leak_E": dot(force, self.c["v"])}

    def viscosity(self, alpha, beta):
        mu, vw, rho = np.minimum(self.mu, 0), self.c["vw"], self.rho
        qi = -0.5 * rho[:, None] * ((alpha * vw)[:, None] - beta * mu) * mu
        qj = -0.5 * rho * (alpha * vw - beta * mu) * mu
        return {"v": -self.sum(qi * self.Di + qj * self.Dj), "u": (qi * self.Di * mu).sum(1)}

    def conductivity(self, alpha):
        P, u, rho = self.c["P"], self.c["u"], self.rho
        v_u = np.sqrt(2 * abs(P[:, None] - P) / (rho[:, None] + rho))
        return {"u": 0.5 * alpha * (v_u * (u[:, None] - u) * (rho[:, None] * self.Di + rho * self.Dj)).sum(1)}

    def resistivity(self, alpha):
        v_B = np.linalg.norm(self.vij - self.mu[..., None] * self.e, axis=-1)  # the transverse velocity
        dB, weight = self.c["B"][:, None] - self.c["B"], alpha * v_B * (self.Gi + self.Gj)
        return {"b": 0.5 * (weight[..., None] * dB).sum(1), "u": -0.25 * (weight * dot(dB, dB)).sum(1)}

    def cleaning(self, sigma, f_clean):
        y, ch = self.c["y"], f_clean * self.c["vw"]
        Bi, Bj = self.along(self.c["B"])
        div_B, div_v = -self.rho * ((Bi - Bj) * self.Gi).sum(1), -self.drho / self.rho
        b = -self.sum((ch * y)[:, None] * self.Gi + ch * y * self.Gj)
        damping = sigma * ch / self.h * y
        return {"b": b, "y": -ch * div_B - damping - 0.5 * y * div_v, "leak_E": -damping * y / self.rho}


MHD = (Stress(), Induction())
CASES = {
    "pressure": ((Pressure(),), lambda s: s.pressure(s.c["P"])),
    "stress": (MHD, lambda s: {}),
    "source": ((*MHD, DivBSource(xi=0.5)), lambda s: s.source(0.5)),
    "viscosity": ((*MHD, Viscosity(0.7, 1.5)), lambda s: s.viscosity(0.7, 1.5)),
    "conductivity": ((*MHD, Conductivity(0.6)), lambda s: s.conductivity(0.6)),
    "resistivity": ((*MHD, Resistivity(0.8)), lambda s: s.resistivity(0.8)),
    "passenger": ((Pressure(), PassiveDensity()), lambda s: {**s.pressure(s.c["P"]), "rho_evolved": s.drho}),
    "passenger without Omega": (
        (Pressure(), PassiveDensity(Omega=False)),
        lambda s: {**s.pressure(s.c["P"]), "rho_evolved": s.Omega * s.drho},
    ),
    "cleaning": ((*MHD, Cleaning(0.4, 1.1)), lambda s: s.cleaning(0.4, 1.1)),
}


@pytest.mark.parametrize("terms, formula", CASES.values(), ids=CASES)
def test_rates_equal_the_sums_over_all_pairs(disordered, terms, formula):
    sim = disordered(*terms)
    reference = Reference(sim.columns(), sim.scene.box.size)
    expected = formula(reference)
    if terms[0] == Stress():
        for part in (reference.stress(), reference.induction()):
            expected = {**expected, **{k: v + expected.get(k, 0) for k, v in part.items()}}
    rates = sim.rates()
    assert set(rates) == set(expected), "rates of members nobody listed, or none of a listed one"
    for name, values in expected.items():
        assert abs(rates[name] - values).max() <= EQUAL * abs(values).max(), name


def test_density_smoothing_length_and_omega_equal_the_summation(disordered):
    c = disordered(*MHD).columns()
    s = Reference(c, (1.0, 1.25))
    for name, values in (("h", s.h), ("rho", s.rho), ("Omega", s.Omega)):
        assert abs(c[name] / values - 1).max() <= EQUAL, name


def test_the_viscosity_switch_sums_div_v_and_curl_v_and_uses_its_own_alpha(simulate):
    from conftest import disordered_scene

    sim = simulate(disordered_scene(*MHD, CullenDehnen(alpha=0.9)))
    sim.begin()
    table, ids = sim.particles.table()
    column = sim.particles.first["alpha"]
    table[:, column] = np.random.default_rng(2).uniform(0, 0.9, len(table))
    sim.particles.admit(table, ids)
    c = sim.columns()
    s = Reference(c, sim.scene.box.size)
    assert abs(c["div_v"] + s.drho / s.rho).max() <= EQUAL * abs(c["div_v"]).max()
    rates, visc, base = sim.rates(), s.viscosity(c["alpha"], 2.0), s.stress()
    for name in ("v", "u"):
        assert abs(rates[name] - base[name] - visc[name]).max() <= EQUAL * abs(visc[name]).max()
