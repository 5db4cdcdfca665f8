"""The exact waves of ideal MHD, and which mode of the particles is which of them."""

from dataclasses import dataclass

import numpy as np

NAMES = ("fast", "alfven", "slow")


def speeds(cs: float, v_A: float, cosine) -> dict[str, np.ndarray]:
    """c^2 = ( cs^2 + v_A^2 +- sqrt( (cs^2 + v_A^2)^2 - 4 cs^2 v_A^2 cos^2 ) ) / 2   and   c = v_A |cos|

    Phase speeds of the fast, slow and Alfven wave at the cosine of the angle between k and B.
    """
    total, cosine = cs**2 + v_A**2, np.asarray(cosine, float)
    root = np.sqrt(np.maximum(total**2 - 4 * cs**2 * v_A**2 * cosine**2, 0.0))
    fast = 0.5 * (total + root)
    slow = cs**2 * v_A**2 * cosine**2 / np.maximum(fast, 1e-300)  # total - root would be a difference
    return {"fast": np.sqrt(fast), "alfven": v_A * np.abs(cosine), "slow": np.sqrt(slow)}


@dataclass(frozen=True, eq=False)
class Gas:
    """P, cs and v_A of the background as the code has them, B its field, (3,)."""

    P: float
    cs: float
    v_A: float
    B: np.ndarray

    @property
    def beta(self) -> float:
        """2P/B^2; inf without a field."""
        return 2 * self.P / float(self.B @ self.B) if self.v_A else np.inf

    @property
    def fastest(self) -> float:
        """sqrt(cs^2 + v_A^2)."""
        return float(np.hypot(self.cs, self.v_A))

    @property
    def pace(self) -> float:
        """What growth rates are measured in, times dx: v_A, or cs where there is no field."""
        return self.v_A or self.cs

    def cosine(self, k: np.ndarray) -> float:
        """Of the angle between k (d,) and B, or the x axis where there is no field."""
        along = self.B if self.v_A else np.eye(3)[0]
        return float(k @ along[: len(k)] / (np.linalg.norm(k) * np.linalg.norm(along)))

    def polarisations(self, k: np.ndarray) -> dict[str, np.ndarray]:
        """Unit vectors (3,) along which the gas moves in each wave; they stand at right angles to each other.

        fast, slow: ( c^2 - v_A^2 cos^2 ) v_t = - v_A^2 sin cos v_k in the plane of k and B, t across k; alfven across
        both.
        """
        along = np.zeros(3)
        along[: len(k)] = k / np.linalg.norm(k)
        across = self.B / np.linalg.norm(self.B) if self.v_A else np.zeros(3)
        across = across - (across @ along) * along
        if np.linalg.norm(across) < 1e-9:
            across = np.eye(3)[1] if abs(along[1]) < 0.9 else np.eye(3)[0]
            across = across - (across @ along) * along
        across /= np.linalg.norm(across)
        found = self.in_plane(self.cosine(k), along, across)
        return {**found, "alfven": np.cross(along, across)}

    def in_plane(self, cosine: float, along: np.ndarray, across: np.ndarray) -> dict[str, np.ndarray]:
        """The larger eigenvalue's vector of [[cs^2 + v_A^2 sin^2, -v_A^2 sin cos], [.., v_A^2 cos^2]] and the other."""
        sine = np.sqrt(max(0.0, 1 - cosine**2))
        mixed = -(self.v_A**2) * sine * cosine
        slow, fast = np.linalg.eigh([[self.cs**2 + self.v_A**2 * sine**2, mixed], [mixed, self.v_A**2 * cosine**2]])[
            1
        ].T
        return {name: v[0] * along + v[1] * across for name, v in (("fast", fast), ("slow", slow))}


def matched(waves, gas: Gas, k: np.ndarray, values: np.ndarray, vectors: np.ndarray) -> dict[str, complex]:
    """For each exact wave the eigenvalue of the mode that moves most like it, |v.e|^2; no mode is taken twice."""
    v = [n for n, (name, _) in enumerate(waves.names) if name == "v"]
    moves = np.stack([waves.wave_part(vectors[:, m])[v] for m in range(len(values))])
    like = {name: np.abs(moves @ e) ** 2 for name, e in gas.polarisations(k).items()}
    table = np.where(values.imag >= -1e-9, np.stack([like[name] for name in NAMES]), -1.0)  # modes come in pairs
    found = {}
    for _ in NAMES:
        wave, mode = np.unravel_index(int(table.argmax()), table.shape)
        found[NAMES[wave]] = values[mode]
        table[wave], table[:, mode] = -2.0, -2.0
    return found
