"""Field lines: iso-lines of A_z, B = curl(A_z e_z), drawn into the pixels of a 2-D picture.

laplacian A_z = - (curl B)_z on a grid, plus the linear part that the mean field has. A_z knows only the part of B
without divergence: the lines are closed or endless whatever div B does, and are no evidence for cleaning; h|div B|/|B|
is.
"""

import numpy as np
from PIL import Image

GRID = 128  # points along the longer side
LEVELS = 18  # lines across the range of A_z
INK, STRENGTH = np.array([0, 255], np.float32), 0.55  # on light ground, on dark ground
LIGHT = 3 * 170  # red + green + blue from which white lines would be lost
WIDTH, FLAT = 1.3, 1e-4  # of a line, in pixels to each side; levels a pixel where there is no line


def potential(sim, columns: dict, size: int = GRID) -> np.ndarray | None:
    """A_z (rows, columns) at the middles of a grid's cells, rows upwards; None where the plane has no field."""
    box = sim.scene.box
    if "B" not in columns or box.dim != 2 or not columns["B"][:, :2].any():
        return None
    spacing = max(box.size) / size
    shape = tuple(max(8, round(length / spacing)) for length in box.size)
    field = deposited(sim, columns, columns["B"][:, :2].astype(float), shape)
    return solved(field, box.size, sim.scene.boundary.periodic)


def deposited(sim, columns: dict, values: np.ndarray, shape: tuple[int, int]) -> list[np.ndarray]:
    """Values (N, 2) on the grid (columns, rows): each particle shared by the four cells around it, weighed by volume.

    Cells without a particle take the mean of their neighbours'.
    """
    box, periodic = sim.scene.box, sim.scene.boundary.periodic
    u = [(columns["x"][:, a] - box.lo[a]) / box.size[a] * shape[a] - 0.5 for a in (0, 1)]
    volume = columns["m"] / columns["rho"]
    cells, weights = [], []
    cell = [np.floor(one).astype(int) for one in u]
    for i in (0, 1):
        for j in (0, 1):
            weight = volume * np.abs(1 - i - (u[0] - cell[0])) * np.abs(1 - j - (u[1] - cell[1]))
            at = [
                np.mod(c, n) if wraps else np.clip(c, 0, n - 1)
                for c, n, wraps in zip((cell[0] + i, cell[1] + j), shape, periodic[:2], strict=True)
            ]
            cells.append(at[0] * shape[1] + at[1])
            weights.append(weight)
    cells, weights, count = np.concatenate(cells), np.concatenate(weights), shape[0] * shape[1]
    below = np.bincount(cells, weights, count).reshape(shape)
    sums = [np.bincount(cells, weights * np.tile(values[:, a], 4), count).reshape(shape) for a in (0, 1)]
    return [filled(above, below, periodic) for above in sums]


def filled(above: np.ndarray, below: np.ndarray, periodic) -> np.ndarray:
    """above/below; holes are filled from their sides inwards."""
    for _ in range(max(above.shape)):
        holes = below <= 1e-9 * below.max()
        if not holes.any():
            break
        above = np.where(holes, beside(above, periodic), above)
        below = np.where(holes, beside(below, periodic), below)
    return above / np.maximum(below, 1e-300)


def beside(values: np.ndarray, periodic) -> np.ndarray:
    """Sum over the four cells around each; beyond an edge without a period there is nothing."""
    framed = np.pad(values, 1)
    if periodic[0]:
        framed[0, 1:-1], framed[-1, 1:-1] = values[-1], values[0]
    if periodic[1]:
        framed[1:-1, 0], framed[1:-1, -1] = values[:, -1], values[:, 0]
    return framed[:-2, 1:-1] + framed[2:, 1:-1] + framed[1:-1, :-2] + framed[1:-1, 2:]


def solved(field: list[np.ndarray], lengths, periodic) -> np.ndarray:
    """A_z (rows, columns) of B (columns, rows): by Fourier transform; an axis without a period is continued mirrored.

    A mirror in x leaves B_x = dA/dy and turns B_y = -dA/dx, so that A_z is even there: it asks for no wall, for of all
    such A_z this one's curl is nearest to B.
    """
    mean = [part.mean() for part in field]
    bx, by = field[0] - mean[0], field[1] - mean[1]
    nx, ny = bx.shape
    if not periodic[0]:
        bx, by = np.concatenate([bx, bx[::-1]]), np.concatenate([by, -by[::-1]])
    if not periodic[1]:
        bx, by = np.concatenate([bx, -bx[:, ::-1]], axis=1), np.concatenate([by, by[:, ::-1]], axis=1)
    kx = 2 * np.pi * np.fft.fftfreq(bx.shape[0], lengths[0] / nx)[:, None]
    ky = 2 * np.pi * np.fft.fftfreq(bx.shape[1], lengths[1] / ny)[None, :]
    k2 = kx**2 + ky**2
    curl = 1j * kx * np.fft.fft2(by) - 1j * ky * np.fft.fft2(bx)
    A = np.fft.ifft2(curl / np.where(k2 > 0, k2, np.inf)).real[:nx, :ny]
    x = (np.arange(nx)[:, None] + 0.5) / nx * lengths[0]
    y = (np.arange(ny)[None, :] + 0.5) / ny * lengths[1]
    return (A + mean[0] * y - mean[1] * x).T


def draw_lines(rgb: np.ndarray, A: np.ndarray | None) -> np.ndarray:
    """The picture (H, W, 3) with iso-lines of A over it, half transparent, one and a half pixels wide."""
    if A is None or not np.ptp(A) > 0:
        return rgb
    high, wide = rgb.shape[:2]
    smooth = np.asarray(Image.fromarray(A[::-1].astype(np.float32)).resize((wide, high), Image.Resampling.BICUBIC))
    turns = (smooth - smooth.min()) * np.float32(LEVELS / np.ptp(A))
    along, across = np.gradient(turns)
    slope = np.sqrt(along * along + across * across)
    apart = np.abs(turns - np.round(turns))  # in levels; over the slope: in pixels to the next line
    near = np.nonzero((apart < WIDTH * slope) & (slope > FLAT))
    cover = (STRENGTH * np.minimum(WIDTH - apart[near] / slope[near], 1.0))[:, None]
    out, ground = rgb.copy(), rgb[near]
    ink = INK[(ground.sum(axis=1, dtype=np.int32) < LIGHT).astype(int)][:, None]
    out[near] = (ground + cover * (ink - ground)).astype(np.uint8)
    return out
