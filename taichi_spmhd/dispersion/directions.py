"""Which wave vectors are looked at: lengths and directions about the field, and a finer look around the largest."""

from dataclasses import dataclass

import numpy as np

from ..exact.waves import frame

SHORTEST = {1: np.pi, 2: 4.45, 3: 5.45}  # |k| dx: the corner of what a lattice tells apart, sqrt(d) pi
STEPS = 60  # moves and halvings of the finer look


@dataclass(frozen=True, eq=False)
class Grid:
    """lengths |k| dx (L,), angles to the field (A,) and turns around it (T,) in degrees; axes (d, d): along the field
    first."""

    lengths: np.ndarray
    angles: np.ndarray
    turns: np.ndarray
    axes: np.ndarray

    def vectors(self) -> np.ndarray:
        """(L, A, T, d)."""
        return self.lengths[:, None, None, None] * self.units()

    def units(self) -> np.ndarray:
        """Directions (A, T, d)."""
        theta, phi = np.radians(self.angles)[:, None], np.radians(self.turns)[None]
        parts = [np.cos(theta) + 0 * phi, np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi)]
        return np.stack(parts[: len(self.axes)], axis=-1) @ self.axes


def grid(dim: int, B: np.ndarray | None, cell: int) -> Grid:
    """Fine where a wave vector is cheap (one particle in the cell), coarse where it is not."""
    fine = {1: (400, 1, 1), 2: (90, 60, 1), 3: (40, 19, 12)}[dim]
    counts = fine if cell <= 2 else {1: (100, 1, 1), 2: (14, 7, 1), 3: (8, 4, 2)}[dim]
    lengths = SHORTEST[dim] * np.arange(1, counts[0] + 1) / counts[0]
    angles = np.zeros(1) if dim == 1 else np.linspace(0, 180 if dim == 2 else 90, counts[1] + (dim == 2))[: counts[1]]
    return Grid(lengths, angles, 360 * np.arange(counts[2]) / counts[2], axes(dim, B))


def axes(dim: int, B: np.ndarray | None) -> np.ndarray:
    """Unit vectors of the space, the first along the field's part in it; along x where there is none."""
    along = np.zeros(3) if B is None else np.where(np.arange(3) < dim, B, 0.0)
    if not np.linalg.norm(along) > (0.0 if B is None else 1e-9 * np.linalg.norm(B)):
        along = np.array([1.0, 0.0, 0.0])
    return {1: np.eye(1), 2: frame(along)[:2, :2], 3: frame(along)}[dim]


def finest(growth, k: np.ndarray, step: float) -> np.ndarray:
    """From k uphill along the axes and their diagonals, in steps that are halved where none leads up."""
    dim = len(k)
    ways = np.stack(np.meshgrid(*[[-1, 0, 1]] * dim, indexing="ij"), axis=-1).reshape(-1, dim)
    best = growth(k[None])[0]
    for _ in range(STEPS):
        around = k + step * ways
        found = growth(around)
        if found.max() > best:
            k, best = around[int(found.argmax())], found.max()
        else:
            step *= 0.5
        if step < 1e-5:
            break
    return k
