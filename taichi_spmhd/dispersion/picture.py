"""The picture of an analysis: growth over wave vectors and over wavelength, speeds beside the exact ones."""

import numpy as np

from ..outputs.figure import finished, sheet
from .branches import NAMES
from .result import STILL, Dispersion
from .rows import unit

MARK, ON_MAP = "#c1440e", "#19a5fe"
COLOURS = {"fast": "#c1440e", "alfven": "#2a7f62", "slow": "#3558a6"}
WORDS = {"fast": "fast", "alfven": "Alfven", "slow": "slow"}
STYLES = ("-", "--", ":")
RING = {"marker": "o", "mfc": "none", "ms": 9, "mew": 1.4, "ls": "none"}


def draw(name: str, analysed: dict[str, Dispersion], caption: str, path) -> None:
    """A row of three panels a variant."""
    figure, canvas = sheet(15.0, 3.7 * len(analysed) + 0.4)
    top = max(10 * STILL, *(max(found.growth.max(), found.best["growth"]) for found in analysed.values()))
    panels = figure.subplots(len(analysed), 3, squeeze=False)
    for (label, found), row in zip(analysed.items(), panels, strict=True):
        (over_k if len(found.grid.angles) == 1 else over_plane)(figure, row[0], found, top)
        over_wavelength(row[1], found)
        speeds(row[2], found)
        row[0].set_title(f"{label}: growth over wave vectors", fontsize=10)
    finished(figure, canvas, f"{name}: small waves on the particles", caption, path)


def over_k(figure, axes, found: Dispersion, top: float) -> None:
    """In 1-D a curve."""
    axes.plot(found.grid.lengths, np.maximum(found.growth[:, 0, 0], 0), color="#444444")
    axes.set(xlabel="k dx", ylabel=f"growth [{unit(found)}]", ylim=(-0.02 * top, 1.1 * top))


def over_plane(figure, axes, found: Dispersion, top: float) -> None:
    """A map over k along and across the field; in 3-D the largest over the turns around it."""
    from matplotlib.colors import LogNorm

    shown = axes.pcolormesh(
        *half_disc(found), norm=LogNorm(STILL, top), cmap="inferno", shading="gouraud", rasterized=True
    )
    figure.colorbar(shown, ax=axes, label=f"growth [{unit(found)}]; black: below {STILL:g}")
    axes.set(xlabel=f"k dx along {axis_of(found)}", ylabel="k dx across it", aspect="equal")
    if found.best["growth"] > STILL:
        axes.plot(*seen(found), color=ON_MAP, clip_on=False, **RING)


def half_disc(found: Dispersion) -> tuple:
    """k along and across, growth: k and -k are one wave, so in the plane half a turn is all."""
    looked, growth = found.grid, np.maximum(found.growth.max(axis=2), STILL)
    theta = np.radians(looked.angles)
    if len(looked.axes) == 2:
        theta, growth = np.append(theta, np.pi), np.concatenate([growth, growth[:, :1]], axis=1)
    return looked.lengths[:, None] * np.cos(theta), looked.lengths[:, None] * np.sin(theta), growth


def seen(found: Dispersion) -> tuple[list, list]:
    """Where the fastest-growing wave lies on the map."""
    along, *across = found.grid.axes @ np.array(found.best["k"])
    if len(across) == 2:
        return [abs(along)], [float(np.hypot(*across))]
    turned = -1.0 if across[0] < 0 else 1.0
    return [turned * along], [turned * across[0]]


def over_wavelength(axes, found: Dispersion) -> None:
    """Growth at a few angles, and the largest of all."""
    best, room = found.best, max(found.best["growth"], 0.05)
    for (angle, columns), style in zip(found.lines.items(), STYLES, strict=False):
        growth = np.maximum(columns["growth"], 0)
        axes.plot(columns["wavelength"], growth, style, color="#222222", label=f"{angle:g} degrees")
    if best["growth"] > STILL:
        words = f"largest: {best['growth']:.3f}, {best['wavelength']:.2f} dx, {best['angle']:.0f} degrees"
        axes.plot([best["wavelength"]], [best["growth"]], color=MARK, label=words, **RING)
    axes.set(ylabel=f"growth [{unit(found)}]", ylim=(-0.02 * room, 1.15 * room))
    axes.set_title("largest growth of any mode" if best["growth"] > STILL else "nothing grows", fontsize=10)
    axes.legend(fontsize=8, frameon=False)
    over(axes)


def speeds(axes, found: Dispersion) -> None:
    """Phase speeds of the three waves at the first two angles; thin: the exact ones."""
    for (angle, columns), style in zip(list(found.lines.items())[:2], STYLES, strict=False):
        for name in NAMES:
            exact = columns[f"exact_{name}"]
            if exact > 0:
                words = f"{WORDS[name]}, {angle:g} degrees"
                axes.plot(columns["wavelength"], columns[name], style, color=COLOURS[name], label=words)
                axes.axhline(exact, color=COLOURS[name], ls=style, lw=0.7, alpha=0.7)
    axes.set_ylabel("phase speed / c_s")
    axes.set_title("phase speeds (thin: exact)", fontsize=10)
    axes.legend(fontsize=8, frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    over(axes)


def over(axes) -> None:
    """A logarithmic axis of wavelengths in plain numbers."""
    from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter

    axes.set(xscale="log", xlabel="wavelength / dx")
    axes.xaxis.set_major_locator(FixedLocator([1, 2, 3, 4, 6, 10, 20]))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())


def axis_of(found: Dispersion) -> str:
    """What angles are counted from."""
    B, dim = found.gas.B, len(found.grid.axes)
    if not np.linalg.norm(B[:dim]) > 1e-9 * np.linalg.norm(B):
        return "x"
    return "B" if np.linalg.norm(B[dim:]) < 1e-9 * np.linalg.norm(B) else "the part of B in the plane"
