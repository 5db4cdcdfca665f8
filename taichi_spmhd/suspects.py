"""Which particle, and which of its members, went wrong: by its place in memory."""

import numpy as np

from .cures import DRIFT, GROWN, LOST, MET, NOT_FINITE, PASSED_WALL, STRAYED
from .search import IMAGE


def suspect(sim, cause: str) -> tuple[int, str]:
    """(place in memory, member)."""
    columns = sim.particles.in_memory()
    if sim.ill:
        return sim.ill - 1, spoilt(sim, columns, sim.ill - 1)
    return FINDERS[cause](sim, columns)


def spoilt(sim, columns: dict, memory: int) -> str:
    """The evolved member of an ill particle that is not finite, or u where all are."""
    rates = sim.particles.rates()
    ill = [
        name
        for name, values in rates.items()
        if not (np.isfinite(values[memory]).all() and np.isfinite(columns[name][memory]).all())
    ]
    return ill[0] if ill else "u" if "u" in rates else "v"


def broken(sim, columns: dict) -> tuple[int, str]:
    """The first particle with a member that is not finite."""
    for name in ("x", "h", *sim.particles.names):
        bad = ~np.isfinite(columns[name].reshape(len(sim), -1)).all(axis=1)
        if bad.any():
            return int(np.argmax(bad)), name
    return oddest(sim, columns)


def coldest(sim, columns: dict) -> tuple[int, str]:
    """The least thermal energy."""
    return int(np.argmin(np.nan_to_num(columns["u"], nan=-np.inf))), "u"


def oddest(sim, columns: dict) -> tuple[int, str]:
    """The smoothing length farthest from the middle one, up or down."""
    h = columns["h"].astype(float)
    odd = np.abs(np.log(np.maximum(h, 1e-300) / np.median(h)))
    return int(np.argmax(np.nan_to_num(odd, nan=np.inf))), "h"


def widest(sim, columns: dict) -> tuple[int, str]:
    """The largest smoothing length."""
    return int(np.argmax(np.nan_to_num(columns["h"], nan=np.inf))), "h"


def loneliest(sim, columns: dict) -> tuple[int, str]:
    """The fewest neighbours, by the list; the oddest smoothing length where the list does not tell."""
    near, count = sim.neighbours.near.to_numpy(), sim.neighbours.count.to_numpy()
    if sim.neighbours.fewest > sim.dim + 1 or count.max() > near.shape[1]:
        return oddest(sim, columns)
    there = np.arange(near.shape[1]) < count[:, None]
    somebody = (near & ((1 << IMAGE) - 1)) != len(sim)
    return int(np.argmin((there & somebody).sum(axis=1))), "h"


def outermost(sim, columns: dict) -> tuple[int, str]:
    """The farthest outside of the box."""
    x, box = columns["x"], sim.scene.box
    lo, hi = np.array(box.lo[: sim.dim]), np.array(box.hi[: sim.dim])
    return int(np.argmax(np.maximum(lo - x, x - hi).max(axis=1))), "x"


def hottest(sim, columns: dict) -> tuple[int, str]:
    """The energy per mass farthest from the middle one, and the member that holds most of it."""
    forms = {"v": 0.5 * (columns["v"].astype(float) ** 2).sum(axis=1)}
    if "u" in columns:
        forms["u"] = columns["u"].astype(float)
    if "B" in columns:
        forms["B"] = 0.5 * (columns["B"].astype(float) ** 2).sum(axis=1) / columns["rho"]
    far = {name: np.abs(form - np.median(form)) for name, form in forms.items()}
    k = int(np.argmax(np.nan_to_num(sum(far.values()), nan=np.inf)))
    return k, max(far, key=lambda name: far[name][k])


FINDERS = {
    NOT_FINITE: broken,
    LOST: loneliest,
    STRAYED: widest,
    GROWN: widest,
    MET: oddest,
    PASSED_WALL: outermost,
    DRIFT: hottest,
}
