"""Members when terms come and go on the way: what a departing one evolved is emptied, an arriving one opens its own.

The ledger's members (leak_v, leak_E) go on: what terms did to momentum and energy is not undone by switching them off.
"""

from .opening import Opening


def exchange(sim, before: tuple) -> None:
    """Empty the members of parts that left, open those of parts that came."""
    names = {type(part).__name__ for part in before}
    arriving = tuple(part for part in sim.parts if type(part).__name__ not in names)
    have = {name for part in sim.parts for name in part.members()}
    own = {name for part in before for name in (*part.evolves, *part.keeps, *part.makes)}
    empty(sim, {name for name in own - have if not name.startswith("leak")})
    if arriving:
        empty(sim, {name for part in arriving for name in own_only(part, sim.parts)})
        Opening(sim.particles, arriving).open()


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
