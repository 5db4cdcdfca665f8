"""The right-hand side: list, density, close, gather, then ONE fused pair loop that sums all terms.

Hooks run part by part, in the order in which each part's needs are made by others; terms add up at compile time, so a
term that is not listed leaves no instruction.
"""

from .errors import RunError
from .moment import Moment
from .opening import Opening
from .pairs import TINY
from .runtime import ti
from .vector import traced

MOST_BUILDS = 100  # of the list within one evaluation; h may grow by 30 % in each


@ti.func
def add(total: ti.template(), part):
    """total.key += part.key for every key of part that anybody evolves (heat is dropped where no energy is)."""
    for key in ti.static(part.keys):
        if ti.static(key in total.keys):
            total[key] += part[key]


BASE = ("x", "v", "m", "h", "rho", "hinv", "g")  # what a pair's line may use of every particle


def looked_at(parts: tuple, names: tuple) -> tuple:
    """The members the pair loops load: what the parts declare in reads, makes and keeps."""
    wanted = {name for part in parts for name in (*part.reads, *part.makes, *part.keeps)}
    return tuple(name for name in names if name in wanted or name in BASE)


@ti.data_oriented
class RHS:
    """Evaluates the rates of all evolved members and the longest stable time step."""

    def __init__(self, particles, neighbours, pairs, density, choice, kernel, parts, stepper):
        self.p, self.near, self.pairs, self.density = particles, neighbours, pairs, density
        self.choice, self.kernel, self.parts, self.stepper = choice, kernel, parts, stepper
        self.gathers = {k: v for part in parts for k, v in part.gathers.items()}
        self.totals = {**particles.evolved, **{k: v for part in parts for k, v in part.sums.items()}}
        self.lanes, self.looked = pairs.lanes, looked_at(parts, pairs.names)
        self.keys = {hook: self.with_hook(hook) for hook in ("close", "gather", "gathered", "settle")}
        self.open = Opening(particles, parts).open
        self.moment = Moment(particles, parts)
        self.extras = tuple(dict.fromkeys(name for part in parts for name in part.weighs))
        self.pair_terms, self.local_terms = self.with_hook("pair"), self.with_hook("local")
        self.sum_dt_terms = self.with_hook("longest")
        self.after_terms = tuple(sorted(self.with_hook("after"), key=lambda part: part.rank))
        self.speed_terms, self.dt_terms = self.with_hook("speed"), self.with_hook("max_dt")

    def with_hook(self, hook: str) -> tuple:
        return tuple(part for part in self.parts if part.has(hook))

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
        if self.keys["gather"]:
            self.gather(self.near.near, self.near.rows, t, dt, self.moment.most)
        return self.rates(self.near.near, self.near.rows, t, dt, self.moment.most)

    def neighbourhood(self) -> None:
        """A complete list, and density and h that belong to the present positions."""
        if self.near.builds == 0 or not self.near.holds():
            self.near.build()
        self.near.age += 1
        for _ in range(MOST_BUILDS):
            rows = self.near.rows
            unresolved = self.density.solve(self.near.near, rows)
            if unresolved or not self.near.holds():
                self.near.build()
            elif self.near.rows is rows or self.near.rows is self.near.inner:  # else h outgrew what was summed
                return
        raise RunError(
            "density: no smoothing length fits; a particle has lost all its neighbours, or two are on one spot"
        )

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
    def settle(self, t: float, dt: float, most: ti.types.ndarray(ndim=1)):
        for n in range(self.p.n):
            now = self.moment.now(t, dt, most)
            for part in ti.static(self.keys["settle"]):
                self.apply(n, part.settle(self.p.state[n], now))

    @traced
    def weights(self, i, j):
        """The pair's weights, with those some part asked for."""
        w = self.choice.weights(i, j, self.pairs.between(i, j), self.kernel)
        more = {name: getattr(self.choice, name)(i, j, w, self.kernel) for name in self.extras}
        return ti.Struct({**{name: getattr(w, name) for name in w.keys}, **more}) if more else w

    @ti.kernel
    def gather(self, near: ti.types.ndarray(dtype=ti.i32, ndim=2), rows: ti.types.ndarray(dtype=ti.i32, ndim=1),
               t: float, dt: float, most: ti.types.ndarray(ndim=1)):  # fmt: skip
        """Neighbour sums some part asked for, then the members made from them."""
        for n in range(self.p.n):
            i, total = self.pairs.mine(n, self.looked), self.lanes.totals(self.gathers)
            for block in range(rows[n] // self.lanes.width):
                j = self.pairs.theirs(near, n, block, self.looked)
                w = self.weights(i, j)
                for part in ti.static(self.keys["gather"]):
                    total.add(part.gather(i, j, w), part)
            sums, now = self.lanes.summed(total), self.moment.now(t, dt, most)
            for part in ti.static(self.keys["gathered"]):
                self.apply(n, part.gathered(self.p.state[n], sums, now))

    @ti.kernel
    def rates(self, near: ti.types.ndarray(dtype=ti.i32, ndim=2), rows: ti.types.ndarray(dtype=ti.i32, ndim=1),
              t: float, dt: float, most: ti.types.ndarray(ndim=1)) -> ti.f32:  # fmt: skip
        """The fused loop; returns the longest stable step of all particles."""
        longest = ti.cast(1e30, ti.f32)
        for n in range(self.p.n):
            now = self.moment.now(t, dt, most)
            i, sums = self.pairs.mine(n, self.looked), self.lanes.totals(self.totals)
            fastest = self.lanes.slowest()
            for block in range(rows[n] // self.lanes.width):
                j = self.pairs.theirs(near, n, block, self.looked)
                w = self.weights(i, j)
                for term in ti.static(self.pair_terms):
                    sums.add(term.pair(i, j, w, now), term)
                for term in ti.static(self.speed_terms):
                    fastest = self.lanes.larger(fastest, ti.select(w.Gi + w.Gj < 0.0, term.speed(i, j, w, now), 0.0))
            total = self.finish(self.p.state[n], self.lanes.summed(sums), now)
            for key in ti.static(self.p.names):
                self.p.rate.get_member_field(key)[n] = total[key]
            ti.atomic_min(
                longest, ti.cast(self.step_of(self.p.state[n], total, self.lanes.speed(fastest), now), ti.f32)
            )
        return longest

    @ti.func
    def finish(self, i, total, now):
        """What each particle adds to its own rates, once all pairs are summed."""
        for term in ti.static(self.local_terms):
            add(total, term.local(i, now))
        for term in ti.static(self.after_terms):
            add(total, term.after(i, total, now))
        return total

    @ti.func
    def step_of(self, i, total, fastest, now):
        """min of C_cour h / v_sig, C_force sqrt(h / |dv/dt|) and what the terms allow."""
        step = self.stepper.cour * i.h / (ti.max(i.vw, fastest) + TINY)
        step = ti.min(step, self.stepper.force * ti.sqrt(i.h / (total.v.norm() + TINY)))
        for term in ti.static(self.dt_terms):
            step = ti.min(step, term.max_dt(i, now))
        for term in ti.static(self.sum_dt_terms):
            step = ti.min(step, term.longest(i, total, now))
        return step
