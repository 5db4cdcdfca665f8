"""Watch: looks whether a run is still on its way, at numbers that are there anyway and, now and then, at the energy.

Every step, without a launch: the largest smoothing length and the shortest row, which a list build leaves behind, and
the longest stable step. Every LOOK steps: the energy against the ledger, in one kernel that sums blocks of particles,
each in a fixed order and in double precision. It decides whether to stop and nothing else, so no bit depends on it.
"""

import numpy as np

from .cures import DRIFT, GROWN, LOST
from .eos import Radiating
from .failure import collapsed, explained
from .runtime import ti

LOOK = 20  # steps: two launches (close and tally) are then about 0.2 % of them
BLOCK = 256  # particles summed by one thread one after the other


@ti.data_oriented
class Watch:
    """Belongs to one Simulation. before: the longest stable step at the last look, 0 if there was none."""

    def __init__(self, particles):
        self.p, self.before, self.mean = particles, 0.0, 0.0
        double = ti.lang.misc.is_extension_supported(ti.lang.impl.current_cfg().arch, ti.extension.data64)
        self.real, word = (ti.f64, np.float64) if double else (ti.f32, np.float32)
        self.sums = np.zeros(((particles.n + BLOCK - 1) // BLOCK, 2), word)

    def look(self, sim) -> None:
        """At the end of a step. Raises RunError."""
        guard, grown = sim.scene.guard, sim.neighbours.cells.widest / sim.ledger.widest
        if grown > guard.growth:
            raise explained(sim, f"the largest smoothing length is {grown:.3g} times that of the start", GROWN)
        if sim.neighbours.fewest <= min(sim.dim + 1, len(sim) - 1):
            others = sim.neighbours.fewest - 1
            raise explained(sim, f"a particle has lost its neighbours ({others} left in {sim.dim}-D)", LOST)
        if sim.longest * guard.fall < self.before:
            what = f"the time step fell from {self.before:.3g} to {sim.longest:.3g} in a few steps"
            raise collapsed(sim, what, sim.time + sim.dt)
        due = (sim.steps + 1) % LOOK == 0
        if due:
            self.before = sim.longest
        if due or not sim.warm:  # a first time that is not due compiles, with all the rest
            self.weigh(sim, guard.tolerance(sim.scene.listed), due)

    def weigh(self, sim, tolerance: float, due: bool = True) -> None:
        """Energy against the ledger. Raises RunError where that is due."""
        if tolerance == np.inf:
            return
        stored, size = self.energies(sim)
        off = abs(stored - sim.ledger.E0)
        if due and (not np.isfinite(size) or off > tolerance * size):
            what = f"the energy is {off / size:.2g} of all energy off the ledger (Guard drift = {tolerance:g})"
            raise explained(sim, what, DRIFT)

    def energies(self, sim) -> tuple[float, float]:
        """Energy less what terms are known to have given, and the sum of absolute energies, of the present state."""
        radiating = isinstance(sim.scene.eos, Radiating)
        if radiating and not self.mean:
            self.mean = float(sim.particles.read()["m"].astype(float).sum()) / sim.scene.box.volume
        sim.rhs.close(sim.time + sim.dt, 0.0)
        self.tally(radiating, self.mean, self.sums)
        stored, size = self.sums.sum(axis=0, dtype=float)
        return float(stored), float(size)

    @ti.kernel
    def tally(self, radiating: ti.template(), mean: float, sums: ti.types.ndarray(ndim=2)):
        """Sums of blocks of particles, each by one thread in the order of memory."""
        for b in range(sums.shape[0]):
            stored, size = ti.cast(0.0, self.real), ti.cast(0.0, self.real)
            for n in range(b * BLOCK, ti.min((b + 1) * BLOCK, self.p.n)):
                m, motion, heat = self.exact(self.p.state[n].m), self.motion(n), self.heat(n, radiating, mean)
                stored += m * (motion + heat - self.leak(n))
                size += m * (motion + ti.abs(heat))
            sums[b, 0], sums[b, 1] = stored, size

    @ti.func
    def exact(self, x):
        return ti.cast(x, self.real)

    @ti.func
    def motion(self, n):
        """Energy of motion, field and cleaning per mass."""
        out, rho = self.exact(0.0), self.exact(self.p.state[n].rho)
        for c in ti.static(range(3)):
            out += 0.5 * self.exact(self.p.state[n].v[c]) ** 2
            if ti.static("B" in self.p.members):
                out += 0.5 * self.exact(self.p.state[n].B[c]) ** 2 / rho
        if ti.static("y" in self.p.members):
            out += 0.5 * self.exact(self.p.state[n].y) ** 2 / rho
        return out

    @ti.func
    def heat(self, n, radiating: ti.template(), mean):
        """u, or the free energy of a gas without it (diagnostics/ledger.py)."""
        out = self.exact(0.0)
        if ti.static(radiating):
            c, rho = self.exact(self.p.state[n].cs), self.exact(self.p.state[n].rho)
            out = c * c * (1.0 + ti.log(rho / self.exact(mean)))
        else:
            out = self.exact(self.p.state[n].u)
        return out

    @ti.func
    def leak(self, n):
        """What terms are known to have given."""
        out = self.exact(0.0)
        if ti.static("leak_E" in self.p.members):
            out = self.exact(self.p.state[n].leak_E)
        return out
