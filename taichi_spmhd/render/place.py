"""The place where a run went wrong: the particles around it by the member that went wrong, the ill one ringed."""

import numpy as np

from ..errors import RunError
from .colours import auto_limits

REACH = 6.0  # smoothing lengths to be seen on each side
FEWEST = 40  # particles to be seen, however far they are
INCHES, DPI = (6.4, 5.6), 100
RED = "#d6202a"
SPAN = 1e3  # of values that are drawn by their logarithm


def place(sim, error: RunError) -> np.ndarray:
    """The surroundings of error.particle in the present state, as pixels (H, W, 3) uint8."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    columns, k = sim.particles.read(), error.particle
    name, values = shown(columns, error.member)
    figure = Figure(figsize=INCHES, dpi=DPI, layout="constrained")
    axes = figure.add_subplot()
    centre, d, h = surroundings(sim, columns, k)
    seen = inside(d, h, sim.neighbours.support, k)
    (profile if sim.dim == 1 else plane)(axes, centre + d, values, seen, name, figure)
    (rule if sim.dim == 1 else ring)(axes, centre, sim.neighbours.support * h, values[k])
    if sim.dim > 1:
        axes.set_aspect("equal")
    axes.set_title(title(error), fontsize=9, loc="left")
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.array(canvas.buffer_rgba())[:, :, :3]


def title(error: RunError) -> str:
    """What went wrong, where and when, in two lines."""
    blame = f", largest rate from {error.term}" if error.term else ""
    who = f"particle {error.particle}, member {error.member}{blame}"
    return f"{error.cause} at t = {error.time:.6g}, step {error.step}\n{who}"


def shown(columns: dict, member: str) -> tuple[str, np.ndarray]:
    """A name and a number (N,) for every particle: the member, the size of a vector; v in place of positions."""
    name = "v" if member == "x" or member not in columns else member
    values = columns[name].astype(float)
    return (f"|{name}|", np.sqrt((values**2).sum(axis=1))) if values.ndim == 2 else (name, values)


def surroundings(sim, columns: dict, k: int) -> tuple[np.ndarray, np.ndarray, float]:
    """The place (d,), the distance vectors of all particles to it (N, d) to the nearest image, and h there."""
    x, h = columns["x"].astype(float), float(columns["h"][k])
    centre = x[k] if np.isfinite(x[k]).all() else columns["x0"][k].astype(float)
    if not (np.isfinite(h) and h > 0):
        h = float(np.nanmedian(columns["h"]))
    d = x - centre
    for a in range(sim.dim):
        if sim.scene.boundary.periodic[a]:
            d[:, a] -= sim.scene.box.size[a] * np.round(d[:, a] / sim.scene.box.size[a])
    return centre, d, h


def inside(d: np.ndarray, h: float, support: float, k: int) -> np.ndarray:
    """Who is drawn (N,): a square, or a ball's slab of one support in 3-D, that holds at least FEWEST."""
    far = np.where(np.isfinite(d).all(axis=1), np.abs(np.nan_to_num(d)).max(axis=1), np.inf)
    reach = max(REACH * h, float(np.sort(far)[min(FEWEST, len(far)) - 1]))
    seen = (far <= reach) & np.isfinite(far)
    if d.shape[1] == 3:
        slab = seen & (np.abs(d[:, 2]) <= support * h)
        seen = slab if slab.sum() > 1 else seen
    seen[k] = np.isfinite(far[k])
    return seen


def plane(axes, x: np.ndarray, values: np.ndarray, seen: np.ndarray, name: str, figure) -> None:
    """Dots at x, y by the colour of their value; crosses where it is not finite."""
    from matplotlib.colors import LogNorm, Normalize

    fine = seen & np.isfinite(values)
    low, high = auto_limits(values[fine])
    norm = LogNorm(low, high) if low > 0 and high > SPAN * low else Normalize(low, high)
    size = min(120.0, max(4.0, 2e4 / max(1, seen.sum())))
    dots = axes.scatter(x[fine, 0], x[fine, 1], size, values[fine], cmap="viridis", norm=norm, linewidths=0)
    figure.colorbar(dots, ax=axes, label=name)
    lost = seen & ~np.isfinite(values)
    axes.scatter(x[lost, 0], x[lost, 1], size, "black", marker="x")
    axes.set_xlabel("x")
    axes.set_ylabel("y" if x.shape[1] == 2 else "y   (a slab of one support in z)")


def profile(axes, x: np.ndarray, values: np.ndarray, seen: np.ndarray, name: str, figure) -> None:
    """Values against x."""
    axes.plot(x[seen, 0], values[seen], "o", ms=4, color="#30678d")
    axes.set_xlabel("x")
    axes.set_ylabel(name)


def ring(axes, centre: np.ndarray, radius: float, value: float) -> None:
    """Around the ill particle, and the circle of its support."""
    from matplotlib.patches import Circle

    axes.plot(centre[0], centre[1], "o", ms=14, mfc="none", mec=RED, mew=2)
    axes.add_patch(Circle(centre[:2], radius, fill=False, color=RED, lw=0.8, ls="--"))


def rule(axes, centre: np.ndarray, radius: float, value: float) -> None:
    """A line where the ill particle is, a ring at its value, and the ends of its support."""
    axes.axvline(centre[0], color=RED, lw=1)
    axes.plot(centre[0], value, "o", ms=12, mfc="none", mec=RED, mew=2)
    for end in (centre[0] - radius, centre[0] + radius):
        axes.axvline(end, color=RED, lw=0.8, ls="--")
