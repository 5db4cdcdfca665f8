"""The specific volume between a pair: a curve through both, its square weighed with both kernels, and where that lies.

Along the axis e, s = r/2 at i and -r/2 at j, V(s) = A s^3 + B s^2 + C s + D. The product of two Gaussian kernels of
width h is W(r, sqrt(2) h) times a Gaussian of variance h^2/4 around the middle (Inutsuka 2002), so that

    V_ij^2(h) = < V^2 >,   s*(h) = < s V^2 > / V_ij^2      < s^2 > = h^2/4,  < s^4 > = 3 h^4/16,  < s^6 > = 15 h^6/64

Here the coefficients are multiplied with r^3, r^2, r and 1, and t = (h/r)^2. Where V is the same, V_ij^2 = V^2, s* = 0.
"""

from ..runtime import ti

CLOSEST = 0.1  # r/h: curves of closer pairs are weighed as if they were that far apart


@ti.func
def spread(q):
    """t = (h/r)^2 of q = r/h."""
    return 1.0 / ti.max(q * q, CLOSEST * CLOSEST)


class Linear:
    """V = C s + D:   V_ij^2 = C^2 h^2/4 + D^2,   s* = C D h^2/2 / V_ij^2"""

    @ti.func
    def curve(self, i, j, V_i, V_j, e, r):
        return ti.Struct(C=V_i - V_j, D=0.5 * (V_i + V_j))

    @ti.func
    def square(self, V, t):
        """V_ij^2"""
        return 0.25 * t * V.C * V.C + V.D * V.D

    @ti.func
    def moment(self, V, t):
        """2 s*/r V_ij^2"""
        return t * V.C * V.D


class Cubic:
    """The cubic through V and grad V of both, the line where they slope against each other:

    V_ij^2 = 15/64 A^2 h^6 + 3/16 (2 A C + B^2) h^4 + 1/4 (2 B D + C^2) h^2 + D^2
    s* = [ 15/32 A B h^6 + 3/8 (A D + B C) h^4 + 1/2 C D h^2 ] / V_ij^2
    """

    @ti.func
    def curve(self, i, j, V_i, V_j, e, r):
        """From what the slopes dV of both give over the distance of the pair."""
        at_i, at_j, jump = r * i.dV.dot(e), r * j.dV.dot(e), V_i - V_j
        bent = ti.select(at_i * at_j < 0.0, 0.0, 1.0)
        A, B = bent * (at_i + at_j - 2.0 * jump), 0.5 * bent * (at_i - at_j)
        return ti.Struct(A=A, B=B, C=jump - 0.25 * A, D=0.5 * (V_i + V_j) - 0.25 * B)

    @ti.func
    def square(self, V, t):
        """V_ij^2"""
        second, fourth = 2.0 * V.B * V.D + V.C * V.C, 2.0 * V.A * V.C + V.B * V.B
        return V.D * V.D + t * (0.25 * second + t * (3.0 / 16.0 * fourth + 15.0 / 64.0 * t * V.A * V.A))

    @ti.func
    def moment(self, V, t):
        """2 s*/r V_ij^2"""
        return t * (V.C * V.D + t * (0.75 * (V.A * V.D + V.B * V.C) + 15.0 / 16.0 * t * V.A * V.B))


BETWEEN = {"linear": Linear(), "cubic": Cubic()}
