from dataclasses import dataclass

from ..errors import InputError
from ..runtime import ti
from ..types import real, vec3
from .fast_speed import Directional
from .resistivity import Resistivity


@dataclass(frozen=True)
class TriccoPrice2013(Directional, Resistivity):
    """Resistivity with alpha_B = min( h |grad B|/|B|, alpha ) and the mean fast speed in place of |v_ij x e|

    v_B = (vw_i + vw_j)/2 - beta min(v_ij.e, 0), and of alpha_B the mean of the pair; |grad B| is the root of the sum
    of squares of all d_a B_b (Tricco & Price 2013; lecture p. 21). Looks at the field where Resistivity looks at the
    flow: it finds a current sheet at rest, and a fast shock along whose normal the gas moves, and it diffuses a smooth
    field by a little, with h^2. Nothing in a uniform field on any particles. Advice: use it if B rings at shocks;
    directional=True puts the fast speed along the pair in place of vw.
    """

    beta: float = 0.0
    directional: bool = False
    reads = {**Resistivity.reads, "vw": real, "h": real}
    makes, live = {"alpha_B": real}, {"alpha": (0.0, 3.0), "beta": (0.0, 6.0)}
    gathers = {"dB_dx": vec3, "dB_dy": vec3, "dB_dz": vec3}

    def __post_init__(self):
        super().__post_init__()
        if not 0 <= self.beta < 100:
            raise InputError(f"TriccoPrice2013: beta = {self.beta} must lie in 0..100; 0 is usual")
        self.look_along()

    @ti.func
    def gather(self, i, j, w):
        """By differences: a uniform field has no gradient on disordered particles either."""
        dB = (j.B - i.B) * (w.Gi * i.rho)
        return ti.Struct(dB_dx=dB * w.e.x, dB_dy=dB * w.e.y, dB_dz=dB * w.e.z)

    @ti.func
    def gathered(self, i, sums, now):
        x, y, z = sums.dB_dx, sums.dB_dy, sums.dB_dz
        steepness = ti.sqrt(x.dot(x) + y.dot(y) + z.dot(z))
        return ti.Struct(alpha_B=ti.min(i.h * steepness / (i.B.norm() + 1e-30), self.alpha))

    @ti.func
    def alpha_v(self, i, j, w):
        v_B = 0.5 * (self.wave(i, w.e) + self.wave(j, w.e)) - self.beta * ti.min((i.v - j.v).dot(w.e), 0.0)
        return 0.5 * (i.alpha_B + j.alpha_B) * v_B
