"""The fused pair loops: all sums of all terms in ONE loop over pairs, and one before it for what must be known first.

Terms add up at compile time, so a term that is not listed leaves no instruction. The loops run over lanes (lanes.py)
and leave rows of sums; what a particle makes of them comes after them (rhs.py).
"""

from .moment import Moment
from .runtime import ti
from .sums import Sums
from .vector import named, traced
from .wide import wide

BASE = ("x", "v", "m", "h", "rho", "hinv", "g")  # what a pair's line may use of every particle


def declared(part) -> tuple:
    """The members one part says it looks at."""
    return (*part.reads, *part.makes, *part.keeps)


def looked_at(parts: tuple, names: tuple) -> tuple:
    """The members the pair loops load: what the parts declare in reads, makes and keeps."""
    wanted = {name for part in parts for name in declared(part)}
    return tuple(name for name in names if name in wanted or name in BASE)


@ti.data_oriented
class Fused:
    """`gather` and `rates` sum over the neighbours of every particle and leave rows of `sums`.

    gathers, totals: {name: type name} of what each sums; after the totals a row of `rates` holds the signal speed.
    """

    def __init__(self, particles, pairs, choice, kernel, parts):
        self.p, self.pairs, self.lanes = particles, pairs, pairs.lanes
        self.choice, self.kernel, self.parts = choice, kernel, parts
        self.gathers = {k: v for part in parts for k, v in part.gathers.items()}
        self.totals = {**particles.evolved, **{k: v for part in parts for k, v in part.sums.items()}}
        self.sums = Sums(particles, self.gathers, {**self.totals, "fastest": float})
        self.looked = looked_at(parts, pairs.names)
        self.moment = Moment(particles, parts)
        self.extras = tuple(dict.fromkeys(name for part in parts for name in part.weighs))
        self.gather_parts, self.pair_terms = self.with_hook("gather"), self.with_hook("pair")
        self.speed_terms = self.with_hook("speed")

    def with_hook(self, hook: str) -> tuple:
        return tuple(part for part in self.parts if part.has(hook))

    @traced
    def weights(self, i, j, choice=None):
        """The pair's weights, with those some part asked for and this choice of density, if another one, offers."""
        choice = choice or self.choice
        w = choice.weights(i, j, named(self.pairs.between(i, j)), self.kernel)
        extras = [name for name in self.extras if choice.offers(name)]
        more = {name: getattr(choice, name)(i, j, w, self.kernel) for name in extras}
        return ti.Struct({**{name: getattr(w, name) for name in w.keys}, "e": named(w.e), **more})

    @traced
    def ready(self, j, part) -> None:
        """Load here what a part looks at: its own line may be inside an `if`, out of sight of the parts after it."""
        j.need(name for name in declared(part) if name in self.looked)

    @ti.kernel
    @wide
    def gather(self, near: ti.types.ndarray(dtype=ti.i32, ndim=2), rows: ti.types.ndarray(dtype=ti.i32, ndim=1),
               sums: ti.types.ndarray(ndim=2)):  # fmt: skip
        """Neighbour sums some part asked for."""
        for n in range(self.p.n):
            i, total = self.pairs.mine(n, self.looked), self.lanes.totals(self.gathers)
            for block in range(rows[n] // self.lanes.width):
                j = self.pairs.theirs(near, n, block, self.looked)
                w = self.weights(i, j, self.choice.early)
                for part in ti.static(self.gather_parts):
                    self.ready(j, part)
                    total.add(part.gather(i, j, w), part)
            self.sums.keep(sums, n, self.lanes, total)

    @ti.kernel
    @wide
    def rates(self, near: ti.types.ndarray(dtype=ti.i32, ndim=2), rows: ti.types.ndarray(dtype=ti.i32, ndim=1),
              t: float, dt: float, most: ti.types.ndarray(ndim=1), sums: ti.types.ndarray(ndim=2)):  # fmt: skip
        """What all terms sum over pairs, and the largest signal speed of each particle."""
        for n in range(self.p.n):
            now = self.moment.now(t, dt, most)
            i, total = self.pairs.mine(n, self.looked), self.lanes.totals(self.totals)
            fastest = self.lanes.slowest()
            for block in range(rows[n] // self.lanes.width):
                j = self.pairs.theirs(near, n, block, self.looked)
                w = self.weights(i, j)
                for term in ti.static(self.pair_terms):
                    self.ready(j, term)
                    total.add(term.pair(i, j, w, now), term)
                for term in ti.static(self.speed_terms):
                    fastest = self.lanes.larger(fastest, ti.select(w.Gi + w.Gj < 0.0, term.speed(i, j, w, now), 0.0))
            self.sums.keep(sums, n, self.lanes, total, self.lanes.speed(fastest))
