"""What a simulation says of itself: members, rates, samples, the summary. None of it changes a bit of the run."""

import numpy as np

from . import state


class Readable:
    """The part of a Simulation that is for readers."""

    def __len__(self) -> int:
        return self.particles.n

    def __getitem__(self, name: str) -> np.ndarray:
        """A member as a numpy copy, (N,) or (N, components), in the order in which the particles were given."""
        columns = self.columns()
        if name not in columns:
            raise KeyError(f"no member {name!r}; there are {', '.join(sorted(columns))}")
        return columns[name]

    def columns(self) -> dict[str, np.ndarray]:
        """All members at the present time, one read for all."""
        self.begin()
        self.rhs.close(self.time, 0.0)
        return state.present(self)

    def rates(self) -> dict[str, np.ndarray]:
        """d/dt of every evolved member at the present state; the run is not disturbed."""
        self.begin()
        return state.rates(self)

    def sample(self, name: str, points: np.ndarray) -> np.ndarray:
        """Normalised SPH interpolation sum m/rho A W / sum m/rho W at points (M, d) -> (M,) or (M, 3)."""
        from .diagnostics.sample import interpolate

        return interpolate(self, name, points)

    def summary(self) -> dict:
        """What summary.json says of a variant."""
        from .diagnostics.summary import summary

        return summary(self)
