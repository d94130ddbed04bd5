"""Tables 3 and 5 against their formulae, in fractions."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.arithmetic.operators import clamped, maximum, minimum

DEGREES = st.floats(0, 1)

FORMULAE = {
    minimum: min,
    maximum: max,
}


@pytest.mark.parametrize("operator", FORMULAE, ids=lambda each: each.__name__)
@given(DEGREES, DEGREES)
def test_an_operator_is_its_formula(operator, a, b):
    exact = FORMULAE[operator](Fraction(a), Fraction(b))
    assert abs(Fraction(operator(a, b)) - exact) <= Fraction(1, 2**52)


@pytest.mark.parametrize("operator", FORMULAE, ids=lambda each: each.__name__)
@given(DEGREES, DEGREES)
def test_an_operator_stays_between_0_and_1_and_takes_its_arguments_in_any_order(operator, a, b):
    degree = operator(a, b)
    assert 0.0 <= degree <= 1.0
    assert abs(degree - operator(b, a)) <= 2**-52


@given(st.floats(allow_nan=False))
def test_a_clamped_number_is_the_nearest_degree(x):
    degree = clamped(x)
    assert 0.0 <= degree <= 1.0
    assert degree == x or (degree == 0.0 and x < 0.0) or (degree == 1.0 and x > 1.0)
