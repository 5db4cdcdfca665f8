"""The right-hand side: list, density, close, gather, then ONE fused pair loop that sums all terms.

Hooks run part by part, in the order in which each part's needs are made by others; terms add up at compile time, so a
term that is not listed leaves no instruction.
"""

from .cures import LOST, MET
from .errors import RunError
from .fused import Fused
from .opening import Opening
from .pairs import TINY
from .runtime import ti
from .sums import width

MOST_BUILDS = 100  # of the list within one evaluation; h may grow by 30 % in each


@ti.func
def add(total: ti.template(), part):
    """total.key += part.key for every key of part that anybody evolves (heat is dropped where no energy is)."""
    for key in ti.static(part.keys):
        if ti.static(key in total.keys):
            total[key] += part[key]


@ti.data_oriented
class RHS(Fused):
    """Evaluates the rates of all evolved members and the longest stable time step."""

    def __init__(self, particles, neighbours, pairs, density, choice, kernel, parts, stepper):
        super().__init__(particles, pairs, choice, kernel, parts)
        self.near, self.density, self.stepper = neighbours, density, stepper
        self.keys = {hook: self.with_hook(hook) for hook in ("close", "gathered", "settle")}
        self.open = Opening(particles, parts).open
        self.local_terms, self.dt_terms = self.with_hook("local"), self.with_hook("max_dt")
        self.after_terms = tuple(sorted(self.with_hook("after"), key=lambda part: part.rank))
        self.sum_dt_terms = self.with_hook("longest")

    def evaluate(self, t: float, dt: float) -> float:
        """Rates of the present state; t and dt (the step being taken, 0 for none) are what terms see as `now`.

        Returns the longest stable step. Raises RunError where h cannot be found (a particle without neighbours).
        """
        self.neighbourhood()
        return self.from_density(t, dt)

    def from_density(self, t: float, dt: float) -> float:
        """The rest of an evaluation, where density and h belong to the positions already."""
        self.close(t, dt)
        self.moment.find()
        near, rows, most, sums = self.near.near, self.near.rows, self.moment.most, self.sums.rows
        if self.gather_parts:
            self.gather(near, rows, sums)
            self.gathered(t, dt, most, sums)
        self.rates(near, rows, t, dt, most, sums)
        return self.finish(t, dt, most, sums)

    def renew(self, t: float) -> float:
        """Density and all members of the present state, no rates; returns the longest step it allows by itself."""
        self.neighbourhood()
        self.close(t, 0.0)
        return self.alone(t, self.moment.most)

    def neighbourhood(self) -> None:
        """A complete list, and density and h that belong to the present positions."""
        if self.near.builds == 0 or not self.near.holds():
            self.near.build()
        for _ in range(MOST_BUILDS):
            rows = self.near.rows
            unresolved = self.density.solve(self.near.near, rows)
            if unresolved or not self.near.holds():
                self.near.build()
            elif self.near.rows is rows or self.near.rows is self.near.inner:  # else h outgrew what was summed
                self.near.age += 1
                return
        why, cause = ("two are on one spot", MET) if unresolved else ("a particle has lost all its neighbours", LOST)
        raise RunError(f"density: no smoothing length fits, {why}", cause)

    @ti.func
    def apply(self, n, part: ti.template()):
        """Write the members a hook returned."""
        for key in ti.static(part.keys):
            self.p.state.get_member_field(key)[n] = part[key]

    @ti.kernel
    def close(self, t: float, dt: float):
        for n in range(self.p.n):
            for part in ti.static(self.keys["close"]):
                now = ti.Struct(t=t, dt=dt)
                self.apply(n, part.close(self.p.state[n], now))
        # nobody, who fills the rows, is particle 0 without mass: no term finds a member it cannot use
        for _ in range(1):
            self.p.state[self.p.n] = self.p.state[0]
            self.p.state[self.p.n].m = 0.0

    @ti.kernel
    def gathered(self, t: float, dt: float, most: ti.types.ndarray(ndim=1), sums: ti.types.ndarray(ndim=2)):
        """Members made from neighbour sums."""
        for n in range(self.p.n):
            now = self.moment.now(t, dt, most)
            found = self.sums.found(sums, n, self.gathers)
            for part in ti.static(self.keys["gathered"]):
                self.apply(n, part.gathered(self.p.state[n], found, now))

    @ti.kernel
    def settle(self, t: float, dt: float, most: ti.types.ndarray(ndim=1)):
        for n in range(self.p.n):
            now = self.moment.now(t, dt, most)
            for part in ti.static(self.keys["settle"]):
                self.apply(n, part.settle(self.p.state[n], now))

    @ti.kernel
    def finish(self, t: float, dt: float, most: ti.types.ndarray(ndim=1), sums: ti.types.ndarray(ndim=2)) -> ti.f32:
        """Rates from the sums over pairs; returns the longest stable step of all particles."""
        longest = ti.cast(1e30, ti.f32)
        for n in range(self.p.n):
            i, now = self.p.state[n], self.moment.now(t, dt, most)
            total = self.complete(i, self.sums.found(sums, n, self.totals), now)
            for key in ti.static(self.p.names):
                self.p.rate.get_member_field(key)[n] = total[key]
            fastest = self.sums.entry(sums, n, ti.static(width(self.totals, self.p.dim)))
            ti.atomic_min(longest, ti.cast(self.step_of(i, total, fastest, now), ti.f32))
        return longest

    @ti.kernel
    def alone(self, t: float, most: ti.types.ndarray(ndim=1)) -> ti.f32:
        """The longest stable step as far as it is known without rates: of the signals and of each part's max_dt."""
        longest = ti.cast(1e30, ti.f32)
        for n in range(self.p.n):
            i, now = self.p.state[n], self.moment.now(t, 0.0, most)
            ti.atomic_min(longest, ti.cast(self.own_step(i, i.vw, now), ti.f32))
        return longest

    @ti.func
    def complete(self, i, total, now):
        """What each particle adds to its own rates, once all pairs are summed."""
        for term in ti.static(self.local_terms):
            add(total, term.local(i, now))
        for term in ti.static(self.after_terms):
            add(total, term.after(i, total, now))
        return total

    @ti.func
    def signal_step(self, i, fastest):
        return self.stepper.cour * i.h / (ti.max(i.vw, fastest) + TINY)

    @ti.func
    def own_step(self, i, fastest, now):
        """What needs no rates: C_cour h / v_sig and what the terms' max_dt allow."""
        step = self.signal_step(i, fastest)
        for term in ti.static(self.dt_terms):
            step = ti.min(step, term.max_dt(i, now))
        return step

    @ti.func
    def force_step(self, i, total):
        return self.stepper.force * ti.sqrt(i.h / (total.v.norm() + TINY))

    @ti.func
    def heat_step(self, i, total):
        if ti.static("u_own" in self.totals):  # what squeezes the gas; that which remains of E may be noise
            return self.stepper.cool * i.u / (ti.max(-total.u_own, 0.0) + TINY)
        elif ti.static("u" in self.totals and "u" in self.p.members):
            return self.stepper.cool * i.u / (ti.max(-total.u, 0.0) + TINY)
        else:
            return ti.cast(1e30, float)

    @ti.func
    def step_of(self, i, total, fastest, now):
        """min of C_cour h / v_sig, C_force sqrt(h / |dv/dt|), C_cool u / (-du/dt) and what the terms allow."""
        step = ti.min(self.own_step(i, fastest, now), self.force_step(i, total), self.heat_step(i, total))
        for term in ti.static(self.sum_dt_terms):
            step = ti.min(step, term.longest(i, total, now))
        return step
