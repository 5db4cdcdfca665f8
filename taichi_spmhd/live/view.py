"""View: the field of one simulation as pixels, without axes. Members are read once a frame, for all that is drawn."""

from dataclasses import replace

import numpy as np
from PIL import Image

from ..picture import PSEUDO, Picture
from ..render.colours import auto_limits, palette
from ..render.columns import columns, values
from ..render.layout import is_profile
from ..render.panels import CURVE, DOT
from ..render.pixels import draw, draw_curve, draw_profile
from .lines import draw_lines, potential

# what every simulation keeps for itself: nothing that a picture teaches
INNER = {"x", "x0", "m", "h0", "hinv", "g", "held", "id", "leak_v", "leak_E", "E_stored", "div_v_before"}
FULL = {"div_B": 0.01, "gap": 1.2}  # the colours reach at least this far from 0: limits stay while these change
COARSE = 2  # the smoothed field has no structure as small as two pixels of the screen, and costs a quarter
PAD = 0.06  # of the range, above and below the dots of a profile
FAINT = 1e-3  # of the other sign: too little to count as a sign of its own
TINY = 1e-30  # below this colours, which are worked out in f32, know no differences


def names(sim) -> list[dict]:
    """What can be drawn: [{"name", "components"}], members first, then those worked out for pictures."""
    members = [(name, count) for name, count, _ in sim.particles.layout if name not in INNER]
    worked_out = [name for name in PSEUDO if name != "div_B" or "B" in dict(members)]
    return [{"name": name, "components": count} for name, count in [*members, *((name, 1) for name in worked_out)]]


def limits(sims: list, picture: Picture) -> tuple[float, float]:
    """Colour limits that hold all the simulations have at present: symmetric about 0 for a component of both signs."""
    shown = np.concatenate([values(sim, picture) for sim in sims])
    if picture.member in FULL:
        lo, hi = auto_limits(np.append(shown, FULL[picture.member]), picture.log)
        return (lo if picture.log else 0.0), hi
    lo, hi = auto_limits(shown, picture.log)
    if max(abs(lo), abs(hi)) < TINY:
        return 0.0, 1.0
    if picture.log:
        return lo, hi
    if is_profile(sims[0].scene.box):
        return lo - PAD * (hi - lo), hi + PAD * (hi - lo)
    most = max(-lo, hi)
    return (-most, most) if picture.axis is not None and min(-lo, hi) > FAINT * most else (lo, hi)


def image(sim, picture: Picture, limits: tuple[float, float], size: tuple[int, int], lines: bool = False) -> np.ndarray:
    """The field (h, w, 3) uint8 of size (w, h), field lines over it if asked for. Raises InputError as Picture does."""
    members = sim.columns() if lines or picture.member in PSEUDO else unsorted(sim)
    drawn, box = columns(sim, replace(picture, gaps=None), members), sim.scene.box
    if is_profile(box):
        dots = draw_profile(box, drawn["x"], drawn["values"], size, limits, DOT, picture.log)
        return draw_curve(dots, box, drawn["exact"], limits, CURVE, picture.log)
    inner = tuple(max(64, length // COARSE) for length in size) if picture.draw == "sph" else size
    rgb = draw(
        picture.draw, box, drawn["x"], drawn["values"], drawn["h"], inner, palette(picture.colour_map(limits)), limits,
        spacing=drawn["spacing"], periodic=sim.scene.boundary.periodic, log=picture.log,
    )  # fmt: skip
    if inner != size:
        rgb = np.asarray(Image.fromarray(rgb).resize(size, Image.Resampling.BILINEAR))
    return draw_lines(rgb, potential(sim, members)) if lines else rgb


def unsorted(sim) -> dict[str, np.ndarray]:
    """Members by name, (N,) or (N, components), in memory order: quicker, and a picture does not ask who is who."""
    sim.begin()
    sim.rhs.close(sim.time, 0.0)
    table, _ = sim.particles.table()
    scalars = sim.particles.scalars
    return {
        name: table[:, first] if name in scalars else table[:, first : first + width]
        for name, width, first in sim.particles.layout
    }
