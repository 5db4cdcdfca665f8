"""Evolved members from primitive ones: at the start of a run, and for parts that join it on its way."""

from .runtime import ti


@ti.data_oriented
class Opening:
    """Runs `open` and then `close` of some parts, in the order of needs; those of higher rank open later.

    Each part's own members are there for those after it.
    """

    def __init__(self, particles, parts: tuple):
        parts = (part for part in parts if part.has("open") or part.has("close"))
        self.p = particles
        self.parts = tuple(sorted(parts, key=lambda part: part.rank if part.has("open") else 0))

    @ti.func
    def apply(self, n, part: ti.template()):
        """Write the members a hook returned."""
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
