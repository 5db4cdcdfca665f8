"""Whether a particle follows its rates: those that frozen ends hold do not."""

from ..runtime import ti


@ti.func
def free(i):
    """1, or 0 where frozen ends hold the particle."""
    out = ti.cast(1.0, float)
    if ti.static("held" in i.keys):
        out -= ti.cast(i.held, float)
    return out
