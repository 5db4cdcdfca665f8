"""Which energy is integrated in time.  (a choice)"""

from dataclasses import dataclass

from .terms.base import Choice
from .types import real


@dataclass(frozen=True)
class Thermal(Choice):
    """u is evolved: every term states the heat it gives, du_i/dt   (lecture p. 4)"""

    evolves = {"u": real}
