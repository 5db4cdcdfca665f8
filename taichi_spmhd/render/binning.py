"""Particles into cells of the screen, so that each pixel finds those that can reach it. Numpy only, deterministic."""

from dataclasses import dataclass

import numpy as np

from ..box import Box

LEVELS = 8  # octaves of reach that get a grid of their own
SMALLEST_CELL = 2.0  # pixels
LARGEST_GRID = 2048  # cells along an axis


@dataclass(frozen=True)
class Bins:
    """Particles sorted by cell, one grid for each octave of reach; all lengths in pixels, rows run downwards.

    points: (M, 4) x, y, depth, reach    order: (M,) index of the caller    start: (cells + 1,) first point of a cell
    grid: (L, 3) cells along x and y, first cell    cell: (L, 2) cell sizes    origin: (2,) corner    wraps: (2,) 0 or 1
    """

    points: np.ndarray
    order: np.ndarray
    start: np.ndarray
    grid: np.ndarray
    cell: np.ndarray
    origin: np.ndarray
    wraps: np.ndarray


def place(box: Box, x: np.ndarray, size: tuple[int, int], periodic) -> np.ndarray:
    """Screen positions (N, 3) of x (N, d >= 2): pixels right, pixels down, depth behind the middle of axis 3."""
    scale = size[0] / box.size[0], size[1] / box.size[1]
    x = np.array(x, dtype=np.float64)
    for axis in (0, 1):
        if periodic[axis]:
            x[:, axis] = box.lo[axis] + np.mod(x[:, axis] - box.lo[axis], box.size[axis])
    depth = (x[:, 2] - 0.5 * (box.lo[2] + box.hi[2])) * scale[0] if x.shape[1] > 2 else np.zeros(len(x))
    return np.stack([(x[:, 0] - box.lo[0]) * scale[0], (box.hi[1] - x[:, 1]) * scale[1], depth], axis=1)


def visible(places: np.ndarray, reach: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Which particles (N,) are finite and at most a quarter of the panel outside it: a blow-up must stay drawable."""
    finite = np.isfinite(places).all(axis=1) & np.isfinite(reach) & (reach > 0)
    near = np.ones(len(places), bool)
    for axis in (0, 1):
        near &= np.abs(places[:, axis] - 0.5 * size[axis]) <= 0.75 * size[axis]
    return finite & near


def _octaves(reach: np.ndarray) -> np.ndarray:
    """Octave of each reach below the largest: 0 for (R/2, R], 1 for (R/4, R/2], ..."""
    ratio = reach.max() / reach
    return np.clip(np.floor(np.log2(ratio)), 0, LEVELS - 1).astype(np.int64)


def _extent(places: np.ndarray, size, wraps) -> tuple[np.ndarray, np.ndarray]:
    """Corner and lengths of the grid: the panel along periodic axes, else the panel and all particles."""
    low, high = np.zeros(2), np.array(size, dtype=np.float64)
    for axis in (0, 1):
        if len(places) and not wraps[axis]:
            low[axis] = min(0.0, places[:, axis].min())
            high[axis] = max(size[axis], places[:, axis].max())
    return low, high - low


def _cells_of(places, low, cell, counts) -> np.ndarray:
    """Number of the cell (M,) that holds each place."""
    index = np.floor((places[:, :2] - low) / cell).astype(np.int64)
    index = np.clip(index, 0, counts - 1)
    return index[:, 1] * counts[0] + index[:, 0]


def bin_points(places: np.ndarray, reach: np.ndarray, size, periodic, cell_size: float | None = None) -> Bins:
    """Sort places (N, 3) by cell. No cell is narrower than the reach of its particles, so 3 x 3 cells always suffice.

    With `cell_size` all particles share one grid of about that cell, whatever their reach (for growing rings).
    """
    wraps = np.array([bool(periodic[0]), bool(periodic[1])])
    low, lengths = _extent(places, size, wraps)
    octave = np.zeros(len(reach), np.int64) if cell_size or not len(reach) else _octaves(reach)
    grids, cells, numbers, first = [], [], np.zeros(len(reach), np.int64), 0
    for level in np.unique(octave):
        mine = octave == level
        side = max(cell_size or reach[mine].max(), SMALLEST_CELL)
        counts = np.clip(np.floor(lengths / side), 1, LARGEST_GRID).astype(np.int64)
        numbers[mine] = first + _cells_of(places[mine], low, lengths / counts, counts)
        grids.append((*counts, first))
        cells.append(lengths / counts)
        first += int(counts.prod())
    order = np.argsort(numbers, kind="stable")
    start = np.concatenate([[0], np.cumsum(np.bincount(numbers, minlength=first))])
    return Bins(
        points=np.column_stack([places, reach])[order].astype(np.float32),
        order=order,
        start=start.astype(np.int32),
        grid=np.array(grids, np.int32).reshape(-1, 3),
        cell=np.array(cells, np.float32).reshape(-1, 2),
        origin=low.astype(np.float32),
        wraps=wraps.astype(np.int32),
    )
