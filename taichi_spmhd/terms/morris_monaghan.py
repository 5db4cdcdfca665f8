from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti
from ..types import real
from .viscosity import Viscosity


@dataclass(frozen=True)
class MorrisMonaghan(Viscosity):
    """Viscosity with dalpha_i/dt = max(-div v, 0) (alpha - alpha_i) - (alpha_i - alpha_min) decay vw/h

    Morris & Monaghan 1997, with the limit of Rosswog et al. 2000: alpha_i is a quantity of the particle, alpha_min at
    the start, that rises towards `alpha` while the gas is compressed and decays within some h/decay behind the shock.
    It is late at strong shocks (CullenDehnen jumps ahead of them) and rises in smooth compressions too. Use it in
    place of Viscosity (lecture p. 21). Advice: decay 0.1 to 0.2.
    """

    alpha_min: float = 0.1
    decay: float = 0.1
    reads = {**Viscosity.reads, "h": real, "alpha": real}
    evolves = {**Viscosity.evolves, "alpha": real}
    sums = {"closing": real}
    live = {**Viscosity.live, "alpha_min": (0.0, 1.0), "decay": (0.0, 1.0)}

    def __post_init__(self):
        super().__post_init__()
        if not (0 <= self.alpha_min <= self.alpha and 0 <= self.decay <= 10):
            raise InputError(
                f"MorrisMonaghan: alpha_min = {self.alpha_min} must lie in 0..alpha = {self.alpha}, the largest "
                f"viscosity, and decay = {self.decay} in 0..10; 0.1 and 0.1 are usual"
            )

    @ti.func
    def open(self, i, now):
        return ti.Struct(alpha=ti.cast(self.alpha_min, float))

    @ti.func
    def strength(self, s):
        return s.alpha

    @ti.func
    def after(self, i, total, now):
        rise = ti.max(i.rho * total.closing, 0.0) * (self.alpha - i.alpha)
        return ti.Struct(alpha=rise - (i.alpha - self.alpha_min) * self.decay * i.vw / i.h)
