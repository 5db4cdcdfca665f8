"""The fast magnetosonic speed along a direction: what a signal needs from one particle to the next."""

from ..runtime import ti
from ..types import real, vec3

NEEDS = {"vw": real, "cs": real, "rho": real, "B": vec3}  # members fast_speed looks at


@ti.func
def fast_speed(s, e):
    """c_f(e)^2 = 1/2 [ vw^2 + sqrt( vw^4 - 4 c_s^2 (B.e)^2/rho ) ],   vw^2 = c_s^2 + v_A^2, of particle s

    Between max(c_s, v_A) along B and vw across it, which is what terms use where they are not asked for this one.
    """
    along = 2.0 * s.cs * s.B.dot(e) / (s.vw * s.vw)
    return s.vw * ti.sqrt(0.5 + 0.5 * ti.sqrt(ti.max(1.0 - along * along / s.rho, 0.0)))


class Directional:
    """Signals between a pair run at vw, or with directional=True at c_f(e), along their line: to be added to a term."""

    def look_along(self) -> None:
        """Read what fast_speed looks at, if asked for it."""
        if self.directional:
            object.__setattr__(self, "reads", {**self.reads, **NEEDS})

    @ti.func
    def wave(self, s, e):
        """The speed of the waves of particle s along e."""
        if ti.static(self.directional):
            return fast_speed(s, e)
        else:
            return s.vw
