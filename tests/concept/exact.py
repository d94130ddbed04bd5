"""What a block must give, in fractions: shapes as polylines, quotients cut off or rounded."""

from fractions import Fraction
from itertools import pairwise
from math import floor, trunc

from hypothesis import strategies as st

INTS = st.integers(-(2**15), 2**15 - 1)
DEGREES = st.integers(0, 10_000)
REAL_DEGREES = st.floats(0, 1, width=32)
ROUNDINGS = ("truncate", "round")

HALF_ULP = Fraction(1, 2**24)
"""Relative error of one operation in binary32."""


def on_polyline(corners, x):
    """Return the height at x of a line through corners (x, height) with rising x, level outside."""
    if x <= corners[0][0]:
        return Fraction(corners[0][1])
    for (x0, y0), (x1, y1) in pairwise(corners):
        if x0 <= x <= x1:
            return y0 + Fraction((x - x0) * (y1 - y0), x1 - x0)
    return Fraction(corners[-1][1])


def counts(exact, rounding):
    """Return a fraction as the whole number that `rounding` makes of it."""
    if rounding == "truncate":
        return trunc(exact)
    size = floor(abs(exact) + Fraction(1, 2))
    return size if exact >= 0 else -size


def points(least, most):
    """Return a strategy of rising INT points."""
    return st.lists(INTS, min_size=least, max_size=most, unique=True).map(sorted)


def named(stem, values):
    """Return values by the names of stretched inputs."""
    return {f"{stem}{i}": value for i, value in enumerate(values, 1)}
