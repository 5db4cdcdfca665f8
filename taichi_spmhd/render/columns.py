"""From a simulation to the arrays a picture needs, and to a picture of its own."""

import numpy as np

from ..errors import InputError
from ..picture import Picture
from .layout import is_profile
from .panels import Panels

CURVE = 801  # points of an exact curve


def _member(members, name: str) -> np.ndarray:
    """members[name], or an InputError that names the member. members: a simulation, or its columns."""
    try:
        return np.asarray(members[name])
    except KeyError as error:
        raise InputError(f"Picture: no member {name!r}; `spmhd show` lists those of the scene") from error


def _div_B(sim, members=None) -> np.ndarray:
    from ..diagnostics import div_B  # diagnostics come with the simulation; pictures alone do without

    return np.asarray(div_B(sim, members))


def _gaps(sim, members=None) -> np.ndarray:
    from ..diagnostics import nearest_gaps

    return np.asarray(nearest_gaps(sim, members))


WORKED_OUT = {"div_B": _div_B, "gap": _gaps}  # for pictures alone: no member of the particles


def values(sim, picture: Picture, members: dict | None = None) -> np.ndarray:
    """What the picture shows of each particle, (N,): a scalar, a component, a magnitude, h |div B| / |B| or the gap.

    members: sim.columns() of the present, where it was read already.
    """
    if picture.member in WORKED_OUT:
        return chosen(WORKED_OUT[picture.member](sim, members), picture)
    return chosen(_member(sim if members is None else members, picture.member), picture)


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


def columns(sim, picture: Picture, members: dict | None = None) -> dict:
    """The arrays Panels.frame takes: x (N, d), values, h, spacing = (m/rho)^(1/d); gaps and exact curve if any.

    members: sim.columns() of the present, where it was read already.
    """
    source = sim if members is None else members
    spacing = (_member(source, "m") / _member(source, "rho")) ** (1.0 / sim.dim)
    made = {"x": _member(source, "x"), "values": values(sim, picture, members)}
    made |= {"h": _member(source, "h"), "spacing": spacing, "exact": exact_curve(sim, picture)}
    return made | {"gaps": _gaps(sim, members)} if picture.gaps else made


def snapshot(
    sim, member: str = "rho", axis: int | None = None, draw: str = "particles", limits=None, size: int = 800, **more
) -> np.ndarray:
    """A picture (H, W, 3) uint8 of the simulation as it is now, with axes and colour bar, at most `size` pixels wide.

    member, axis, draw, limits and more (colours=, log=, gaps=) are those of Picture. Raises InputError as it does.
    """
    picture = Picture(member, axis, limits, draw, width=size, **more)
    panels = Panels([""], sim.scene.box, picture, periodic=sim.scene.boundary.periodic)
    return panels.frame(sim.time, {"": columns(sim, picture)})
