"""The method of characteristics for the Alfven wave: transverse field and velocity between two particles.

w = v_perp +- s B_perp/sqrt(rho) is carried from either side, s the sign of B_parallel (Iwasaki & Inutsuka 2011). A wave
with v_perp = + B_perp/sqrt(rho) runs against the field.
"""

from ..runtime import ti


@ti.func
def sign(x):
    """-1, 0 or 1."""
    return ti.select(x > 0.0, 1.0, 0.0) - ti.select(x < 0.0, 1.0, 0.0)


@ti.func
def crossed(root_L, root_R, s, v_L, v_R, B_L, B_R):
    """B* and v* of one transverse component; root = sqrt(rho) of the sides, s = sign of B_parallel.

    B* = [ B_R/sqrt(rho_R) + B_L/sqrt(rho_L) + s (v_R - v_L) ] / ( 1/sqrt(rho_R) + 1/sqrt(rho_L) )
    v* = [ sqrt(rho_R) v_R + sqrt(rho_L) v_L + s (B_R - B_L) ] / ( sqrt(rho_R) + sqrt(rho_L) )
    """
    share = 1.0 / (root_L + root_R)
    B = (root_L * B_R + root_R * B_L + s * root_L * root_R * (v_R - v_L)) * share
    v = (root_R * v_R + root_L * v_L + s * (B_R - B_L)) * share
    return B, v
