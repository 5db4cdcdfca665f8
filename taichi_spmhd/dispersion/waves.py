"""Plane waves on a patch: the matrix of a wave vector, its growth rates, frequencies and eigenvectors.

    dq_a/dt = M_ab(k) q_b,   M_ab(k) = sum over the copies j of particle a of R_jb exp(-i k.(x_j - x_b))

R is the response, a and b run over the particles of the cell, q over positions and all evolved members. exp(lambda t):
Re lambda is the growth, |Im lambda| the frequency.
"""

from collections.abc import Callable

import numpy as np

from .response import Response

BLOCK = 2**22  # complex numbers held at once
LARGE, FEW = 100, 8  # matrices of more rows are worked out so many at a time, so that a bar can move


class PlaneWaves:
    """M(k) for any wave vectors k (K, d), in units of dx and of the response's pace."""

    def __init__(self, response: Response):
        patch = response.patch
        self.names, self.dim, self.size = response.names, patch.positions.shape[1], len(patch.cell)
        self.places = patch.positions[patch.cell] / patch.dx
        self.kernels = [self.folded(patch, who, values, b) for b, (who, values) in enumerate(response.answers)]

    def folded(self, patch, who: np.ndarray, values: np.ndarray, b: int) -> tuple:
        """Offsets (J, d) in dx, cell index of each answering particle (J,), values (columns, J, rows)."""
        size, x = np.array(patch.box.size), patch.positions
        apart = x[who] - x[patch.cell[b]]
        apart -= size * np.round(apart / size)
        return apart / patch.dx, self.kind(patch, who), values

    def kind(self, patch, who: np.ndarray) -> np.ndarray:
        """Which particle of the cell each of these is a copy of."""
        if self.size == 1:
            return np.zeros(len(who), int)
        if patch.name == "glass":  # copies follow one another in blocks
            return who % self.size
        z = patch.positions[who, 2] - patch.positions[patch.cell[0], 2]
        return np.round(z / (patch.dx * np.sqrt(2 / 3))).astype(int) % 2

    @property
    def rows(self) -> int:
        return len(self.names)

    def matrices(self, k: np.ndarray) -> np.ndarray:
        """(K, n, n) complex, n = particles of the cell times rows."""
        n, m = self.rows, self.size
        out = np.zeros((len(k), m, n, m, n), complex)
        for b, (offsets, kinds, values) in enumerate(self.kernels):
            phases = np.exp(-1j * (k @ offsets.T))
            for a in np.unique(kinds):
                own = kinds == a
                block = values[:, own].transpose(1, 2, 0).reshape(own.sum(), n * n)  # (J, rows, columns)
                out[:, a, :, b, :] += (phases[:, own] @ block).reshape(len(k), n, n)
        return out.reshape(len(k), m * n, m * n)

    def growth(self, k: np.ndarray, tell: Callable[[float], None] = lambda share: None) -> np.ndarray:
        """The largest growth rate of each wave vector, (K,); tell(share) hears of progress."""
        found, parts = [], self.parts(k)
        for n, part in enumerate(parts):
            found.append(np.linalg.eigvals(self.matrices(part)).real.max(axis=1))
            tell((n + 1) / len(parts))
        return np.concatenate(found)

    def modes(self, k: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Eigenvalues (K, n) and eigenvectors (K, n, n), one a column."""
        found = [np.linalg.eig(self.matrices(part)) for part in self.parts(k)]
        return np.concatenate([v for v, _ in found]), np.concatenate([v for _, v in found])

    def parts(self, k: np.ndarray) -> list[np.ndarray]:
        """Wave vectors in blocks that fit the memory."""
        k = np.atleast_2d(k)
        each = max(1, BLOCK // max((self.rows * self.size) ** 2, sum(len(o) for o, _, _ in self.kernels)))
        each = min(each, FEW) if self.rows * self.size > LARGE else each
        return [k[n : n + each] for n in range(0, len(k), each)]

    def wave_part(self, vector: np.ndarray, more: np.ndarray | None = None) -> np.ndarray:
        """The amplitudes (rows,) of the plane wave of k, or of k + more, in an eigenvector (n,) of k.

        In a cell of one particle that is all of it; in larger cells waves of several vectors are mixed.
        """
        phases = 1.0 if more is None else np.exp(-1j * self.places @ more)[:, None]
        return (phases * vector.reshape(self.size, self.rows)).mean(axis=0)

    def wave_vector(self, patch, vector: np.ndarray, k: np.ndarray, longest: float) -> np.ndarray:
        """The wave vector that an eigenvector of k displaces most particles by: the shortest of several alike."""
        near = patch.alike(k, longest)
        x = [n for n, (name, _) in enumerate(self.names) if name == "x"]
        share = np.array([np.linalg.norm(self.wave_part(vector, other - k)[x]) for other in near])
        return near[int(np.argmax(share > 0.999 * share.max()))]
