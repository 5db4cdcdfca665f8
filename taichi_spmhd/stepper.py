"""Time steppers.  (a choice)   Each starts and ends with rates that belong to the state."""

from dataclasses import dataclass

from .errors import InputError
from .terms.base import Choice
from .types import struct, vecd


class Stepper(Choice):
    """What steppers share: the safety factors of the time step, C_cour h/v_sig, C_force sqrt(h/|a|), C_cool u/(-du/dt).

    The last keeps gas that is torn apart faster than sound can follow from giving away more heat than it has.
    """

    live = {"cour": (0.05, 1.0), "force": (0.05, 1.0), "cool": (0.05, 1.0)}
    centred = False  # whether terms must centre their rates in time themselves

    def __post_init__(self):
        for name in ("cour", "force", "cool"):
            value = getattr(self, name)
            if not 0 < value <= 1:
                raise InputError(f"{type(self).__name__}: {name} = {value} must lie in (0, 1]")

    def prepare(self, particles) -> object:
        """Extra fields, placed before the memory is allocated."""
        return None


@dataclass(frozen=True)
class LeapfrogKDK(Stepper):
    """v^(1/2) = v + dt/2 a,  x += dt v^(1/2),  v = v^(1/2) + dt/2 a_new:   kick, drift, kick; one evaluation a step

    u, B/rho and psi/c_h likewise; rates are evaluated with v, u, b predicted to the end of the step (Price et al.
    2018). Second order; reversible for smooth forces.
    """

    cour: float = 0.3
    force: float = 0.25
    cool: float = 0.5

    def step(self, sim, dt: float) -> float:
        """One step; returns the longest next one."""
        sim.floors += sim.advance.predict(dt)
        longest = sim.rhs.evaluate(sim.time + dt, dt)
        sim.ill = sim.advance.correct(dt)
        return longest


LOSS = 0.8  # of u: the most that a step may take, or it is tried again, shorter
SHORTENED = 5  # times at the most


@dataclass(frozen=True)
class TimeCentred(Stepper):
    """x += dt (v + dt/2 dv/dt),   q += dt dq/dt:   one evaluation a step, for terms that centre their rates in time

    Godunov's scheme predicts the states of its Riemann problems to the middle of the step and heats with the velocity
    there, v + dt/2 dv/dt (Inutsuka 2002): second order, and exact in energy for any dt. Such a rate belongs to one
    step: it is evaluated when the step is known, but before anything has moved, so that a step which would take nearly
    all of u is made shorter. With other terms this would be Euler's method.
    """

    cour: float = 0.3
    force: float = 0.25
    cool: float = 0.5
    centred = True

    def step(self, sim, dt: float) -> float:
        """One step, shorter than asked for (sim.dt) where u would be lost; returns the longest next one."""
        longest = sim.rhs.from_density(sim.time, dt)
        for _ in range(SHORTENED):
            bearable = sim.advance.bearable(LOSS)
            if sim.dt <= bearable:
                break
            sim.dt = self.cool / LOSS * bearable
            longest = sim.rhs.from_density(sim.time, sim.dt)
        sim.ill = sim.advance.forward(sim.dt)
        if sim.ill:
            return 0.0
        return min(longest, sim.rhs.renew(sim.time + sim.dt))


class RungeKutta(Stepper):
    """y <- a y0 + b (y + dt f(y)), which then belongs to t + c dt, for each stage (a, b, c)."""

    stages: tuple = ()

    def prepare(self, particles) -> object:
        kind = struct({"x": vecd, **particles.evolved}, particles.dim)
        saved, spare = particles.place(kind), particles.place(kind)
        particles.companions.append((saved, spare))
        return saved

    def step(self, sim, dt: float) -> float:
        """One step; returns the longest next one."""
        sim.advance.save(sim.saved)
        for a, b, c in self.stages:
            sim.ill = sim.advance.combine(sim.saved, a, b, dt)
            if sim.ill:
                return 0.0
            longest = sim.rhs.evaluate(sim.time + c * dt, dt)
        return longest


@dataclass(frozen=True)
class Heun(RungeKutta):
    """y1 = y + dt f(y),   y = (y + y1 + dt f(y1))/2:   second order, two evaluations a step"""

    cour: float = 0.3
    force: float = 0.25
    cool: float = 0.5
    stages = ((0.0, 1.0, 1.0), (0.5, 0.5, 1.0))


@dataclass(frozen=True)
class SSPRK3(RungeKutta):
    """Shu & Osher 1988, third order, three evaluations a step: energy drifts with dt^3"""

    cour: float = 0.3
    force: float = 0.25
    cool: float = 0.5
    stages = ((0.0, 1.0, 1.0), (0.75, 0.25, 0.5), (1 / 3, 2 / 3, 1.0))
