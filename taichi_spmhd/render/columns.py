"""From a simulation to the arrays a picture needs, and to a picture of its own."""

import numpy as np

from ..errors import InputError
from ..picture import Picture
from .layout import is_profile
from .panels import Panels

CURVE = 801  # points of an exact curve


def _member(sim, name: str) -> np.ndarray:
    """sim[name], or an InputError that names the member."""
    try:
        return np.asarray(sim[name])
    except KeyError as error:
        raise InputError(f"Picture: no member {name!r}; `spmhd show` lists those of the scene") from error


def _div_B(sim) -> np.ndarray:
    from ..diagnostics import div_B  # diagnostics come with the simulation; pictures alone do without

    return np.asarray(div_B(sim))


def _gaps(sim) -> np.ndarray:
    from ..diagnostics import nearest_gaps

    return np.asarray(nearest_gaps(sim))


def values(sim, picture: Picture) -> np.ndarray:
    """What the picture shows of each particle, (N,): a scalar, a component, a magnitude, or h |div B| / |B|."""
    return chosen(_div_B(sim) if picture.member == "div_B" else _member(sim, picture.member), picture)


def chosen(member: np.ndarray, picture: Picture) -> np.ndarray:
    """The component or magnitude of a member that the picture shows, (N,)."""
    if member.ndim == 1:
        if picture.axis is not None:
            raise InputError(f"Picture: {picture.member!r} is a scalar; leave out axis={picture.axis}")
        return member
    if picture.axis is None:
        return np.sqrt((member.astype(float) ** 2).sum(axis=tuple(range(1, member.ndim))))
    if picture.axis >= member.shape[1]:
        raise InputError(f"Picture: {picture.member!r} has {member.shape[1]} components; axis={picture.axis} is none")
    return member[:, picture.axis]


def exact_curve(sim, picture: Picture) -> np.ndarray | None:
    """Points (M, 2) of the exact solution along the middle of the first axis, where the scene has one; else None."""
    box, exact = sim.scene.box, getattr(sim.scene, "exact", None)
    if exact is None or not is_profile(box):
        return None
    points = np.tile([0.5 * (lo + hi) for lo, hi in zip(box.lo, box.hi, strict=True)], (CURVE, 1))
    points[:, 0] = np.linspace(box.lo[0], box.hi[0], CURVE)
    solution = exact(points, sim.time)
    if picture.member not in solution:
        return None
    return np.column_stack([points[:, 0], chosen(np.asarray(solution[picture.member]), picture)])


def columns(sim, picture: Picture) -> dict:
    """The arrays Panels.frame takes: x (N, d), values, h, spacing = (m/rho)^(1/d); gaps and exact curve if any."""
    spacing = (_member(sim, "m") / _member(sim, "rho")) ** (1.0 / sim.dim)
    made = {"x": _member(sim, "x"), "values": values(sim, picture), "h": _member(sim, "h"), "spacing": spacing}
    made["exact"] = exact_curve(sim, picture)
    return made | {"gaps": _gaps(sim)} if picture.gaps else made


def snapshot(
    sim, member: str = "rho", axis: int | None = None, draw: str = "particles", limits=None, size: int = 800, **more
) -> np.ndarray:
    """A picture (H, W, 3) uint8 of the simulation as it is now, with axes and colour bar, at most `size` pixels wide.

    member, axis, draw, limits and more (colours=, log=, gaps=) are those of Picture. Raises InputError as it does.
    """
    picture = Picture(member, axis, limits, draw, width=size, **more)
    panels = Panels([""], sim.scene.box, picture, periodic=sim.scene.boundary.periodic)
    return panels.frame(sim.time, {"": columns(sim, picture)})
