"""The contract of a part: a term (effect that adds to the rates) or a choice declares members and offers small hooks.

A part is a frozen dataclass. Everything below is optional.

    reads    {name: type}    members it looks at
    evolves  {name: type}    members integrated in time; its hooks return rates under these names
    makes    {name: type}    members it computes from evolved ones in `close`
    keeps    {name: type}    members saved with the state but neither evolved nor given by the scene
    gathers  {name: type}    neighbour sums its `gather` returns
    sums     {name: type}    sums over pairs its `pair` returns beside rates, for an `after`
    mosts    {name: type}    numbers of which its `most` gives each particle's, and `now` holds the largest
    weighs   (name, ...)     weights beside w.e, w.r, w.Gi, w.Gj that its `pair` uses (density.py: F, near, shift)
    together (name, ...)     members its `pair` loads of every neighbour, if they are many: they lie side by side then
    centred  bool            whether its rates are those of a step as a whole, centred in time (stepper.TimeCentred)
    rank     number          parts of higher rank open, and run `after`, later
    live     {name: (low, high)}   numbers that may slide while a live run goes on, and the range that teaches something

    among(self, parts) -> part           the part beside the others of its scene (plain Python)
    smooth(self) -> part                 the part without limiters and switches, for linear analysis (plain Python)
    at(self, dim) -> part                the part for a number of dimensions (plain Python, when a Simulation is built)
    open(self, i, now) -> Struct         evolved members from primitive ones, once at t = 0
    close(self, i, now) -> Struct        the members it makes, at every evaluation
    most(self, i) -> Struct              numbers >= 0 whose largest over all particles is in `now` from here on
    gather(self, i, j, w) -> Struct      neighbour sums needed before the rates (names of `gathers`)
    gathered(self, i, sums, now) -> Struct   members from those sums (names of `makes` or `keeps`)
    pair(self, i, j, w, now) -> Struct   what neighbour j adds to the rates of i
    local(self, i, now) -> Struct        what i adds to its own rates
    after(self, i, total, now) -> Struct what it adds to the rates once all pairs are summed (total: rates and sums)
    speed(self, i, j, w, now)            a signal speed between i and j, >= 0; the largest one limits the time step
    max_dt(self, i, now)                 the longest step this effect allows otherwise
    longest(self, i, total, now)         the longest step those sums allow
    settle(self, i, now) -> Struct       members renewed in place at the end of a step

`i` and `j` are particle records, `w` the pair's weights (w.e, w.r, w.Gi, w.Gj), `now` the present moment (now.t,
now.dt = the step being taken, 0 before the first, and the largest numbers of `most`). What changes B by other ways than
induction is stated as `b`, a rate of B/rho, under `sums`: Induction knows what to do with it. A `pair` is branch-free
(min, max, select) and vanishes by itself for j = i and outside the support, because it is built from w.Gi, w.Gj and
differences. Numbers of a frozen term are compile-time constants, except in a live run, where those named in `live` are
read from the device (sliding.py): use them in arithmetic, never in ti.static.
"""

from dataclasses import fields


def known_as(name: str):
    """Marks a form of a part that `among` chooses: messages, sliders and saved states know it by the scene's name."""

    def renamed(kind: type) -> type:
        kind.__name__ = kind.__qualname__ = name
        return kind

    return renamed


class Part:
    """What terms and choices share: nothing is read, evolved, made or kept unless a class says so."""

    reads: dict = {}
    evolves: dict = {}
    makes: dict = {}
    keeps: dict = {}
    gathers: dict = {}
    sums: dict = {}
    mosts: dict = {}
    weighs: tuple = ()
    together: tuple = ()
    centred: bool = False
    rank: int = 0
    live: dict = {}

    def among(self, parts: tuple) -> "Part":
        """This part beside the others of its scene."""
        return self

    def at(self, dim: int) -> "Part":
        """This part for a number of dimensions."""
        return self

    def smooth(self) -> "Part":
        """This part without what small waves do not see: limiters, switches for shocks."""
        return self

    def has(self, hook: str) -> bool:
        """Whether this part offers the hook."""
        return callable(getattr(self, hook, None))

    def members(self) -> dict:
        """Every member this part touches."""
        return {**self.reads, **self.keeps, **self.makes, **self.evolves}

    def __str__(self) -> str:
        """As a scene file would write it: every number, and options that are not the default."""
        values = [(f, getattr(self, f.name)) for f in fields(self)]
        given = [f"{f.name}={shown(v)}" for f, v in values if isinstance(v, float) or v != f.default]
        return f"{type(self).__name__}({', '.join(given)})"


def shown(value) -> str:
    """A parameter as a reader wants it: four digits are enough."""
    if not isinstance(value, float):
        return repr(value)
    text = f"{value:.4g}"
    return text if set(text) & set(".en") else f"{text}.0"


class Term(Part):
    """An effect that adds to the rates; a scene lists any number, each class once."""


class Choice(Part):
    """One of several alternatives, of which a scene has exactly one: equation of state, energy, density, ..."""
