"""Integer division against fractions, and the edges of 16 and 32 bits."""

from fractions import Fraction
from math import floor, trunc

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.arithmetic.integer import (
    DINT_LEAST,
    DINT_MOST,
    INT_LEAST,
    INT_MOST,
    ROUND,
    TRUNCATE,
    fits_dint,
    fits_int,
    quotient,
    scaled,
)

DINTS = st.integers(DINT_LEAST, DINT_MOST)
POSITIVE = st.integers(1, DINT_MOST)


def nearest(exact):
    """Return the nearest whole number, halves away from zero."""
    size = floor(abs(exact) + Fraction(1, 2))
    return size if exact >= 0 else -size


@given(DINTS, POSITIVE)
def test_a_quotient_is_cut_off_towards_zero_or_rounded_to_the_nearest(dividend, divisor):
    exact = Fraction(dividend, divisor)
    assert quotient(dividend, divisor, TRUNCATE) == trunc(exact)
    assert quotient(dividend, divisor, ROUND) == nearest(exact)


@pytest.mark.parametrize(
    ("dividend", "truncated", "rounded"), [(5, 2, 3), (-5, -2, -3), (3, 1, 2), (-3, -1, -2), (4, 2, 2)]
)
def test_a_half_is_rounded_away_from_zero(dividend, truncated, rounded):
    assert quotient(dividend, 2, TRUNCATE) == truncated
    assert quotient(dividend, 2, ROUND) == rounded


@given(st.integers(0, 65_535), st.integers(0, 10_000), st.integers(1, 65_535))
def test_scaling_divides_once_after_multiplying(part, factor, whole):
    exact = Fraction(part * factor, whole)
    assert scaled(part, factor, whole, TRUNCATE) == trunc(exact)
    assert scaled(part, factor, whole, ROUND) == nearest(exact)


@pytest.mark.parametrize(
    ("fits", "least", "most"), [(fits_int, INT_LEAST, INT_MOST), (fits_dint, DINT_LEAST, DINT_MOST)]
)
def test_a_data_type_ends_where_its_bits_end(fits, least, most):
    assert fits(least)
    assert fits(most)
    assert not fits(least - 1)
    assert not fits(most + 1)
    assert -least == most + 1
