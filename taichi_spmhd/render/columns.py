"""From a simulation to the arrays a picture needs, and to a picture of its own."""

import numpy as np

from ..errors import InputError
from ..picture import Picture
from .panels import Panels


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
    member = _div_B(sim) if picture.member == "div_B" else _member(sim, picture.member)
    if member.ndim == 1:
        if picture.axis is not None:
            raise InputError(f"Picture: {picture.member!r} is a scalar; leave out axis={picture.axis}")
        return member
    if picture.axis is None:
        return np.sqrt((member.astype(float) ** 2).sum(axis=tuple(range(1, member.ndim))))
    if picture.axis >= member.shape[1]:
        raise InputError(f"Picture: {picture.member!r} has {member.shape[1]} components; axis={picture.axis} is none")
    return member[:, picture.axis]


def columns(sim, picture: Picture) -> dict:
    """The arrays Panels.frame takes for one variant: x (N, d), values, h, spacing = (m/rho)^(1/d), gaps if shown."""
    spacing = (_member(sim, "m") / _member(sim, "rho")) ** (1.0 / sim.dim)
    made = {"x": _member(sim, "x"), "values": values(sim, picture), "h": _member(sim, "h"), "spacing": spacing}
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
