"""The state of a simulation: how it starts, what is read from it, and what is said when it breaks."""

import numpy as np

from . import runtime
from .boundary import LOWER, Reflecting
from .eos import Radiating
from .errors import InputError

VECTORS = ("v", "B")
KNOWN = ("rho", "v", "P", "u", "cs", "B", "psi", "mass")


def opening(scene) -> dict[str, np.ndarray]:
    """What the scene's start(x) says, as full arrays: x, m, rho, v, P or u or cs, B, psi. Raises InputError."""
    x = scene.positions
    given = scene.start(x)
    if not isinstance(given, dict):
        raise InputError(f"start: returned {type(given).__name__}; it must return a dict of rho, v, P, ...")
    for name in given:
        if name not in KNOWN:
            raise InputError(f"start: unknown quantity {name!r}; it may give {', '.join(KNOWN)}")
    if "rho" not in given and "mass" not in given:
        raise InputError("start: give rho (or mass)")
    values = {name: broad(name, value, len(x)) for name, value in given.items()}
    volume = scene.box.volume / len(x)
    values["m"] = values.pop("mass") if "mass" in values else values["rho"] * volume
    values.setdefault("rho", values["m"] / volume)
    values.setdefault("v", np.zeros((len(x), 3)))
    for part in scene.parts:
        if "B" in part.reads and "B" not in values:
            raise InputError(f"start: {type(part).__name__} needs B; give B as an array (N, 3)")
    if not isinstance(scene.eos, Radiating) and not {"P", "u"} & set(values):
        raise InputError("start: give the pressure P (or the thermal energy u)")
    if "cs" in scene.eos.keeps and "cs" not in values:
        raise InputError(f"start: {type(scene.eos).__name__} needs the sound speed cs of every particle; give cs")
    check_start(x, values)
    check_used(scene, given)
    check_walls(scene)
    word = np.float32 if runtime.started().get("precision") == "f32" else float
    check_apart(x.astype(word), scene.box, scene.boundary.periodic)
    return {"x": x, **values}


def check_used(scene, given: dict) -> None:
    """Everything the start gives must be of use: what would be ignored is a misunderstanding."""
    read = {name for part in scene.parts for name in (*part.reads, *part.makes)}
    if "P" in given and "u" in given:
        raise InputError("start: P and u both given; give one of them")
    gas = type(scene.eos).__name__
    if isinstance(scene.eos, Radiating) and {"P", "u"} & set(given):
        raise InputError(f"start: {gas}: the pressure follows from rho alone; leave out P and u")
    if "cs" in given and "cs" not in scene.eos.keeps:
        raise InputError(f"start: cs given, but {gas} has its own sound speed; leave out cs or use LocallyIsothermal()")
    if "B" in given and "B" not in read:
        raise InputError("start: B given, but no term reads it; list Stress() and Induction(), or leave out B")


def check_walls(scene) -> None:
    """No particle starts behind a reflecting wall."""
    for a, sides in enumerate(scene.boundary.sides[: scene.dim]):
        x = scene.positions[:, a]
        outside = np.zeros(len(x), bool)
        if isinstance(sides[0], Reflecting):
            outside |= x < scene.box.lo[a]
        if isinstance(sides[1], Reflecting):
            outside |= x > scene.box.hi[a]
        if outside.any():
            k = int(np.argmax(outside))
            raise InputError(f"positions: particle {k} at {x[k]:.4g} along {'xyz'[a]} starts behind a reflecting wall")


def broad(name: str, value, n: int) -> np.ndarray:
    """A number, vector or array as (n,) or (n, 3)."""
    shape = (n, 3) if name in VECTORS else (n,)
    try:
        return np.array(np.broadcast_to(np.asarray(value, float), shape))
    except (ValueError, TypeError) as error:
        raise InputError(f"start: {name} has shape {np.shape(value)}; it must fit {shape}") from error


def check_start(x: np.ndarray, values: dict) -> None:
    """Finite numbers, positive masses, densities and pressures."""
    for name, array in {"positions": x, **values}.items():
        bad = ~np.isfinite(array).reshape(len(x), -1).all(axis=1)
        if bad.any():
            raise InputError(f"start: {name} of particle {np.argmax(bad)} is not finite; mend start() or the positions")
    for name in ("m", "rho", "P", "u", "cs"):
        if name in values and not (values[name] > 0).all():
            k = int(np.argmin(values[name]))
            raise InputError(f"start: {name} of particle {k} is {values[name][k]:.3g}; it must be positive")


def check_box(scene, kernel, n: int) -> None:
    """A periodic box holds two supports along every axis, or a pair would meet twice."""
    spacing = (scene.box.volume / n) ** (1 / scene.dim)
    support = scene.density.reach * kernel.support * kernel.h_fact * spacing
    for a in range(scene.dim):
        if scene.boundary.periodic[a] and scene.box.size[a] < 2 * support:
            raise InputError(
                f"box: {scene.box.size[a]:.3g} along {'xyz'[a]} is narrower than two kernel supports "
                f"({2 * support:.3g}); raise nx, widen the box or take a smaller kernel"
            )


def check_apart(x: np.ndarray, box, periodic: tuple) -> None:
    """No two particles on one spot: their order would be undefined and nothing would ever part them."""
    if not all((x[:, a] >= box.lo[a]).all() and (x[:, a] <= box.hi[a]).all() for a in range(box.dim) if periodic[a]):
        size, lo = np.array(box.size), np.array(box.lo)
        wrapped = np.where(periodic[: box.dim], lo + np.mod(x - lo, size), x)
    else:
        wrapped = x
    order = np.lexsort(wrapped.T)
    same = (np.diff(wrapped[order], axis=0) == 0).all(axis=1)
    if same.any():
        k = int(np.argmax(same))
        one, other, spot = order[k], order[k + 1], wrapped[order[k]].tolist()
        raise InputError(f"positions: particles {one} and {other} are on one spot {spot}; move one of them")


def fill(sim, values: dict) -> None:
    """Write the start into the particles: records in the caller's order, h from the density the scene gives."""
    p, scene, kernel = sim.particles, sim.scene, sim.neighbours.kernel
    h = kernel.h_fact * (values["m"] / values["rho"]) ** (1 / sim.dim)
    own = {**values, "h": h, "hinv": 1 / h, "h0": h, "x0": values["x"], "held": held(scene, values["x"])}
    table = np.zeros((p.n, p.width), p.word)
    for name, kind, first in p.layout:
        if name in own:
            table[:, first : first + kind] = np.asarray(own[name]).reshape(p.n, -1)
    p.admit(table, np.arange(p.n, dtype=np.int32))
    sim.given_u = values.get("u")


def held(scene, x: np.ndarray) -> np.ndarray:
    """1 for the particles of the frozen ends."""
    out = np.zeros(len(x))
    for axis, side, width in scene.boundary.frozen:
        edge = x[:, axis] - scene.box.lo[axis] if side == LOWER else scene.box.hi[axis] - x[:, axis]
        out[edge < width] = 1
    return out


def open_members(sim) -> None:
    """Evolved members from primitive ones, now that the summed density is known."""
    if sim.given_u is not None and not isinstance(sim.scene.eos, Radiating):
        p = sim.particles
        table, ids = p.table()
        table[:, p.first["P"]] = (sim.scene.eos.gamma - 1) * table[:, p.first["rho"]] * sim.given_u[ids]
        p.admit(table, ids)
    sim.rhs.open()


def present(sim) -> dict[str, np.ndarray]:
    """Members by name in the caller's order, positions folded into the box."""
    columns = sim.particles.read()
    box = sim.scene.box
    for a in range(sim.dim):
        if sim.scene.boundary.periodic[a]:
            x = box.lo[a] + np.mod(columns["x"][:, a] - box.lo[a], box.size[a])
            columns["x"][:, a] = np.where(x < box.hi[a], x, box.lo[a])
    return columns


def rates(sim) -> dict[str, np.ndarray]:
    """d/dt of every evolved member in the caller's order; the state is put back as it was, to the bit."""
    p = sim.particles
    table, ids = p.table()
    before, story = p.rates(), sim.neighbours.story()
    sim.rhs.evaluate(sim.time, 0.0)
    _, now_ids = p.table()
    out = {}
    for name, values in p.rates().items():
        out[name] = np.empty_like(values)
        out[name][now_ids] = values
    p.admit(table, ids)
    p.admit_rates(before)
    if sim.neighbours.retell(story):
        sim.neighbours.rebuild()
    return out
