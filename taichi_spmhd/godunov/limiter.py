"""Limiters: how much of its slope a side may use. Odd in all arguments, so that i and j of a pair see the same.

`slope` is what the side's own gradient gives over the distance of the pair, `jump` the difference between the pair.
Neither state can then leave the interval between both particles: densities and pressures stay positive.
"""

from ..runtime import ti


@ti.func
def iwasaki_inutsuka(slope, jump):
    """sgn(df) min( 2 |df|, |D|, 2 |2 D - df| ) where df, D and 2 D - df agree in sign, else 0

    Iwasaki & Inutsuka 2011. 2 D - df is the difference to the virtual particle on the other side.
    """
    twice = 2.0 * jump
    far = 4.0 * slope - twice
    least, most = ti.min(ti.min(slope, twice), far), ti.max(ti.max(slope, twice), far)
    return ti.max(least, 0.0) + ti.min(most, 0.0)


@ti.func
def minmod(slope, jump):
    """The smaller of slope and jump where they agree in sign, else 0: never steeper than the pair itself."""
    return ti.max(ti.min(slope, jump), 0.0) + ti.min(ti.max(slope, jump), 0.0)


@ti.func
def unlimited(slope, jump):
    """The slope as it is: for smooth waves, and to see what the limiter costs them."""
    return slope


LIMITERS = {"II11": iwasaki_inutsuka, "minmod": minmod, "none": unlimited}
