"""Members when terms come and go on the way: what a departing one evolved is emptied, an arriving one opens its own.

The ledger's members (leak_v, leak_E) go on: what terms did to momentum and energy is not undone by switching them off.
"""

from .runtime import ti


def exchange(sim, before: tuple) -> None:
    """Empty the members of parts that left, open those of parts that came."""
    names = {type(part).__name__ for part in before}
    arriving = tuple(part for part in sim.parts if type(part).__name__ not in names)
    have = {name for part in sim.parts for name in part.members()}
    own = {name for part in before for name in (*part.evolves, *part.keeps, *part.makes)}
    empty(sim, {name for name in own - have if not name.startswith("leak")})
    if arriving:
        empty(sim, {name for part in arriving for name in own_only(part, sim.parts)})
        Arrival(sim.particles, arriving).open()


def own_only(part, parts: tuple) -> set:
    """What this part evolves or keeps and no other does; the ledger's members go on."""
    others = {name for other in parts if other is not part for name in other.members()}
    return {name for name in (*part.evolves, *part.keeps) if name not in others and not name.startswith("leak")}


def empty(sim, names: set) -> None:
    """Zero in these members of all particles."""
    if names:
        table, ids = sim.particles.table()
        for name, width, first in sim.particles.layout:
            if name in names:
                table[:, first : first + width] = 0.0
        sim.particles.admit(table, ids)


@ti.data_oriented
class Arrival:
    """Opens the members of parts that join a run on its way."""

    def __init__(self, particles, parts: tuple):
        self.p, self.parts = particles, tuple(part for part in parts if part.has("open") or part.has("close"))

    @ti.func
    def apply(self, n, part: ti.template()):
        for key in ti.static(part.keys):
            self.p.state.get_member_field(key)[n] = part[key]

    @ti.kernel
    def open(self):
        for n in range(self.p.n):
            for part in ti.static(self.parts):
                now = ti.Struct(t=0.0, dt=0.0)
                if ti.static(part.has("open")):
                    self.apply(n, part.open(self.p.state[n], now))
                if ti.static(part.has("close")):
                    self.apply(n, part.close(self.p.state[n], now))
