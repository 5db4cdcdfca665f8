"""The kernels that steppers are made of: prediction and correction, Runge-Kutta stages, and what is ill."""

from math import inf

from .pairs import Pairs
from .runtime import ti
from .terms.held import free


@ti.func
def broken(x):
    """Not a number, infinite or beyond 1e38: by the exponent bits, since fast math removes x != x."""
    return ti.cast((ti.bit_cast(ti.cast(x, ti.f32), ti.i32) & 0x7F800000) == 0x7F800000, ti.i32)


@ti.data_oriented
class Advance:
    """The kernels steppers are made of. `free` is 0 for held particles, which only drift with their own velocity."""

    def __init__(self, particles, pairs: Pairs):
        self.p, self.pairs = particles, pairs

    @ti.func
    def ill(self, value, key: ti.template()):
        """Whether an evolved member is not finite, or u not positive."""
        found = 0
        if ti.static(key in self.p.vectors):
            for c in ti.static(range(3)):
                found |= broken(value[c])
        else:
            found = broken(value)
        if ti.static(key == "u"):
            found |= ti.cast(value <= 0.0, ti.i32)
        return found

    @ti.func
    def free(self, s, key: ti.template()):
        """Whether member `key` of this particle follows its rate: of the held ones only the ledger's do."""
        if ti.static(key.startswith("leak")):
            return ti.cast(1.0, float)
        else:
            return free(s)

    @ti.func
    def drift(self, n, s, r, dt):
        """x += dt (v + dt/2 a), s and r the particle and its rates at the start."""
        for a in ti.static(range(self.p.dim)):
            self.p.state[n].x[a] = s.x[a] + dt * (s.v[a] + 0.5 * dt * self.free(s, "v") * r.v[a])

    @ti.func
    def renew(self, n, key: ti.template(), value):
        """Write a member unless it is ill, and return whether it is: what is left tells which term spoilt it."""
        ill = self.ill(value, key)
        if ill == 0:
            self.p.state.get_member_field(key)[n] = value
        return ill

    @ti.kernel
    def predict(self, dt: float) -> ti.i32:
        """x += dt (v + dt/2 a), every evolved member q += dt dq/dt, old rates kept; returns the floors of u hit."""
        floors = 0
        for n in range(self.p.n):
            s, r = self.p.state[n], self.p.rate[n]
            self.p.old[n] = r
            self.drift(n, s, r, dt)
            for key in ti.static(r.keys):
                value = s[key] + dt * self.free(s, key) * r[key]
                if ti.static(key == "u"):
                    floors += ti.cast(value <= 0.0, ti.i32)
                    value = ti.select(value > 0.0, value, 0.5 * s[key])
                self.p.state.get_member_field(key)[n] = value
        return floors

    def bearable(self, loss: float) -> float:
        """The longest step that takes no more than this share of anybody's u, where u is evolved."""
        return self.spared(loss) if {"u", "u_own"} & set(self.p.names) else inf

    @ti.kernel
    def spared(self, loss: float) -> float:
        longest = ti.cast(1e30, float)
        for n in range(self.p.n):
            for key in ti.static([name for name in ("u", "u_own") if name in self.p.names]):
                down = ti.max(-self.free(self.p.state[n], key) * self.p.rate[n][key], 0.0)
                ti.atomic_min(longest, loss * self.p.state[n][key] / (down + 1e-30))
        return longest

    @ti.kernel
    def forward(self, dt: float) -> ti.i32:
        """x += dt (v + dt/2 a), every evolved member q += dt dq/dt; returns 1 + the place of an ill particle, or 0."""
        found = 0
        for n in range(self.p.n):
            s, r = self.p.state[n], self.p.rate[n]
            ill = 0
            self.drift(n, s, r, dt)
            for key in ti.static(r.keys):
                ill |= self.renew(n, key, s[key] + dt * self.free(s, key) * r[key])
            ti.atomic_max(found, ill * (n + 1))
        return found

    @ti.kernel
    def correct(self, dt: float) -> ti.i32:
        """q += dt/2 (new rate - old rate); returns 1 + the place of an ill particle, 0 for none."""
        found = 0
        for n in range(self.p.n):
            s, new, old = self.p.state[n], self.p.rate[n], self.p.old[n]
            ill = 0
            for key in ti.static(new.keys):
                ill |= self.renew(n, key, s[key] + 0.5 * dt * self.free(s, key) * (new[key] - old[key]))
            ti.atomic_max(found, ill * (n + 1))
        return found

    @ti.kernel
    def combine(self, saved: ti.template(), a: float, b: float, dt: float) -> ti.i32:
        """y = a y0 + b (y + dt dy/dt), a + b = 1; positions by their distance to y0: they may have been wrapped."""
        found = 0
        for n in range(self.p.n):
            s, r, start = self.p.state[n], self.p.rate[n], saved[n]
            ill = 0
            back = self.pairs.apart(start.x, s.x)
            for c in ti.static(range(self.p.dim)):
                self.p.state[n].x[c] = s.x[c] + a * back[c] + b * dt * s.v[c]
            for key in ti.static(r.keys):
                ill |= self.renew(n, key, a * start[key] + b * (s[key] + dt * self.free(s, key) * r[key]))
            ti.atomic_max(found, ill * (n + 1))
        return found

    @ti.kernel
    def save(self, saved: ti.template()):
        for n in range(self.p.n):
            saved[n].x = self.p.state[n].x
            for key in ti.static(self.p.names):
                saved.get_member_field(key)[n] = self.p.state.get_member_field(key)[n]
