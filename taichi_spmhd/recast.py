"""Changing a live run on its way: sliding a number, switching terms, starting over. The state is kept.

    slide(sim, "DivBSource", "xi", 0.3)      acts at the next step, nothing is compiled
    recast(sim, scene.without(Viscosity))    the rates are compiled anew, the first time these terms act together
    restart(sim)                             the same terms from the scene's start

All of it wants a Simulation(scene, spare=...).
"""

from dataclasses import replace

import numpy as np

from . import state
from .errors import InputError
from .exchange import exchange
from .scene import Scene
from .sliding import numbers


def slide(sim, part: str, name: str, value: float) -> None:
    """A new value of a part's number. Raises InputError, and changes nothing, where the part refuses it."""
    scene = with_number(sim.scene, part, name, value)
    sim.sliding.put(part, name, value)
    sim.scene = scene
    again(sim)


def with_number(scene: Scene, part: str, name: str, value: float) -> Scene:
    """The scene with another number in one of its terms, or in its stepper."""
    if type(scene.stepper).__name__ == part:
        return scene.but(stepper=replace(scene.stepper, **{name: value}))
    if all(type(term).__name__ != part for term in scene.terms):
        raise InputError(f"{part} is not among the terms of this scene; switch it on first")
    return scene.tuned(part, **{name: value})


def again(sim) -> None:
    """Rates, and the longest step, that belong to the state as it is now."""
    if sim.begun:
        sim.longest = sim.rhs.evaluate(sim.time, 0.0)


def fits(sim, scene: Scene) -> bool:
    """Whether these particles have all that the scene's terms need."""
    p, there = sim.particles, set(sim.particles.members)
    parts = tuple(part.at(sim.dim) for part in scene.parts)
    return all(
        there >= set(part.members()) and set(p.names) >= set(part.evolves) and sim.sliding.knows(part) for part in parts
    )


def kinds(sim, scene: Scene) -> tuple:
    """What the compiled rates of a scene depend on: classes, and whatever in them does not slide."""
    parts = tuple(part.at(sim.dim) for part in scene.parts)
    fixed = [{k: v for k, v in vars(part).items() if k not in numbers(part)} for part in parts]
    return tuple((type(part), repr(rest)) for part, rest in zip(parts, fixed, strict=True))


def recast(sim, scene: Scene) -> None:
    """Other terms from now on, on the same particles (fits must be true); compiled rates are kept for the next time.

    What only a departing term evolved is put to zero, what an arriving one evolves is opened from the present state.
    The ledger goes on: what energy and momentum this took or gave is neither drift nor prediction.
    """
    made = sim.__dict__.setdefault("compiled", {kinds(sim, sim.scene): sim.rhs})
    if kinds(sim, scene) not in made:
        made[kinds(sim, scene)] = sim.right_hand_side(scene)
    before, books = sim.rhs.parts, Books.of(sim)
    for part in (*(part.at(sim.dim) for part in scene.parts), scene.stepper):
        sim.sliding.take(part)
    sim.wire(made[kinds(sim, scene)])
    sim.scene = scene
    if sim.begun:
        exchange(sim, before)
        again(sim)
        books.carry(sim)


class Books:
    """Energy and momentum before a change by hand, so that the ledger can go on behind it."""

    def __init__(self, E: float, p: np.ndarray):
        self.E, self.p = E, p

    @classmethod
    def of(cls, sim) -> "Books | None":
        """What stands in the books now; nothing before the start."""
        from .diagnostics.ledger import energies, momentum

        if not sim.begun:
            return None
        columns = sim.columns()
        return cls(energies(sim, columns)["E_tot"], momentum(sim, columns))

    def carry(self, sim) -> None:
        """Move the ledger's opening entries by what the change gave: the drift stays what it was."""
        after = Books.of(sim)
        sim.ledger.E0 += after.E - self.E
        sim.ledger.p0 = sim.ledger.p0 + (after.p - self.p)


def successor(sim, scene: Scene, spare: tuple):
    """A new simulation of the scene that starts from the state of another: for what needs other members, or a kernel.

    Raises InputError where the scene cannot be simulated from that state; the other one is as it was.
    """
    columns, books = sim.columns(), Books.of(sim)
    start = {name: columns[name] for name in ("x", "m", *state.KNOWN) if name in columns and name != "mass"}
    new = type(sim)(scene, start, spare)
    try:
        new.begin()
        inherit(new, columns)
        new.time, new.steps, new.floors, new.dt = sim.time, sim.steps, sim.floors, sim.dt
        new.ledger = replace(sim.ledger)
        again(new)
        books.carry(new)
    except BaseException:
        new.close()
        raise
    return new


ANEW = {"x", "v", "m", "h", "hinv", "g", "rho", "Omega", "x0", "h0", "b", "B", "u", "E", "P"}  # follow from the start


def inherit(new, columns: dict) -> None:
    """What a simulation kept beside the primitive state: the ledger's leaks, alpha of a switch, psi."""
    table, ids = new.particles.table()
    names = {name for part in new.parts for name in (*part.evolves, *part.keeps)} | {"held"}
    for name, width, first in new.particles.layout:
        if name in names - ANEW and name in columns:
            table[:, first : first + width] = columns[name].reshape(len(ids), -1)[ids]
    new.particles.admit(table, ids)


def restart(sim) -> None:
    """Back to the scene's start with the present terms and numbers: the bits of a new simulation."""
    sim.time, sim.steps, sim.floors, sim.ill, sim.dt, sim.longest = 0.0, 0, 0, 0, 0.0, 0.0
    sim.begun, sim.ledger, sim.watch.before, sim.watch.mean = False, None, 0.0, 0.0
    sim.neighbours.forget()
    state.fill(sim, state.opening(sim.scene))
