"""The force of div B errors against the Lorentz force: rms |B S| / rms ( |J x B| / rho ), J = curl B.

B S is the part of the conservative force along B that there would not be if div B were zero (lecture pp. 18-19), S the
symmetric div B / rho of DivBSource, whether or not a scene lists that term: of B S it takes the share xi away.
"""

import numpy as np

from .field import differences

WEAK = 1e-6  # of B^2/(rho h): a Lorentz force below this is round-off, and the ratio is taken to this


def rms(vectors: np.ndarray) -> float:
    """The root of the mean square of vectors (N, 3)."""
    return float(np.sqrt((vectors.astype(float) ** 2).sum(axis=1).mean()))


def div_B_force(sim, columns: dict | None = None) -> float:
    """The ratio of the two r.m.s. forces per mass over all particles that are not held; 0 where there is no field.

    Two means are divided, not a mean taken of ratios: the Lorentz force vanishes somewhere in most fields. In a field
    that is uniform, J = 0, the number is large and says no more than that the particles are in disorder. J is taken by
    differences, so that disorder does not enter it. Raises KeyError in a scene without B.
    """
    columns = columns or sim.columns()
    free = columns["held"] == 0 if "held" in columns else np.ones(len(sim), bool)
    found = {name: values[free].astype(float) for name, values in differences(sim).items()}
    B, rho, h = (columns[name][free].astype(float) for name in ("B", "rho", "h"))
    lorentz = rms(np.cross(found["curl_B"], B) / rho[:, None])
    against = max(lorentz, WEAK * rms(B * (np.linalg.norm(B, axis=1) / (rho * h))[:, None]))
    return rms(B * found["S"][:, None]) / against if against > 0 else 0.0
