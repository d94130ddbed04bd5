"""AND on degrees with their complements, against the formulae of Table 3 in fractions."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.arithmetic.pairs import AND_BDIF, AND_MIN, AND_PROD, conjunction

SMALL = st.floats(0, 0.5)
FORMULAE = {AND_MIN: min, AND_PROD: lambda a, b: a * b, AND_BDIF: lambda a, b: max(Fraction(0), a + b - 1)}


def exactly(not_a):
    """Return a complement's degree, and the exact value that both are known of."""
    return 1.0 - not_a, 1 - Fraction(not_a)


@pytest.mark.parametrize("operator", FORMULAE)
@given(SMALL, SMALL)
def test_and_near_1_keeps_its_complement_s_digits(operator, not_a, not_b):
    (a, true_a), (b, true_b) = exactly(not_a), exactly(not_b)
    degree, complement = conjunction(operator, a, not_a, b, not_b)
    exact = FORMULAE[operator](true_a, true_b)
    assert abs(Fraction(complement) - (1 - exact)) <= 2**-51 * (1 - exact) + Fraction(2) ** -1070
    assert abs(Fraction(degree) - exact) <= 2**-52
    assert 0.0 <= degree <= 1.0
    assert 0.0 <= complement <= 1.0


@given(SMALL, SMALL)
def test_bdif_of_a_degree_near_0_and_one_near_1_keeps_its_digits(a, not_b):
    b, true_b = exactly(not_b)
    degree, _ = conjunction(AND_BDIF, a, 1.0 - a, b, not_b)
    exact = max(Fraction(0), Fraction(a) + true_b - 1)
    assert abs(Fraction(degree) - exact) <= 2**-52 * exact
