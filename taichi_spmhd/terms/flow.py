"""div v and curl v, for the switches that tell a compression from a shear."""

from ..runtime import ti
from ..types import real, vec3


class Flow:
    """div v = - rho_i sum_j v_ij.e Gi,   curl v = rho_i sum_j (v_ij x e) Gi:   to be added to a term

    By differences, so both vanish exactly in uniform motion; div v is the one the summed density changes with.
    """

    gathers = {"div_v": real, "curl_v": vec3}

    @ti.func
    def gather(self, i, j, w):
        dv = (i.v - j.v) * (w.Gi * i.rho)
        return ti.Struct(div_v=-dv.dot(w.e), curl_v=dv.cross(w.e))
