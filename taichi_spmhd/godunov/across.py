"""The directions across a pair's axis: a frame in which limiters act on components and see no coordinate axes."""

from ..runtime import ti
from ..vector import Vector3, named, nothing, traced

X, Y, Z = Vector3((1.0, 0.0, 0.0)), Vector3((0.0, 1.0, 0.0)), Vector3((0.0, 0.0, 1.0))


@traced
def across(e):
    """Two unit vectors that complete e: y and z in 1-D, the turned axis and z in 2-D, in 3-D those of Duff et al. 2017.

    -e has the same ones up to their signs.
    """
    if nothing(e.y):
        return Y, Z
    if nothing(e.z):
        return named(Vector3((-1.0 * e.y, e.x, 0.0))), Z
    return turned(e)


@traced
def turned(e):
    """The two of a frame in 3-D, without a branch (Duff et al. 2017).

    The sides of e.z < 0 and > 0 differ. Where e.z = 0, as in a lattice, e.y decides: e and -e on one side would have
    frames turned against each other.
    """
    flat = ti.select(e.y < 0.0, -1.0, 1.0)
    side = ti.lang.impl.expr_init(ti.select(e.z < 0.0, -1.0, ti.select(e.z > 0.0, 1.0, flat)))
    a = ti.lang.impl.expr_init(-1.0 / (side + e.z))
    b = ti.lang.impl.expr_init(e.x * e.y * a)
    first = Vector3((side * e.x * e.x * a + 1.0, side * b, -1.0 * side * e.x))
    second = Vector3((b, e.y * e.y * a + side, -1.0 * e.y))
    return named(first), named(second)
