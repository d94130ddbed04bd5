"""Values of a channel come to counts exactly, however near the middle between two they lie (S36)."""

from fractions import Fraction

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

from fcl_sim.concept.scale import Scale

numbers = st.floats(-1e6, 1e6)
factors = st.floats(1e-6, 1e6)


@given(numbers, factors, numbers)
@example(0.5, 1.0, 0.0)
@example(1.5, 1.0, 0.0)
@example(0.49999999999999994, 1.0, 0.0)
@example(0.15, 0.1, 0.0)
@example(1e300, 1e-300, 0.0)
def test_counts_are_the_nearest_of_the_exact_quotient(value, factor, offset):
    exact = (Fraction(value) - Fraction(offset)) / Fraction(factor)
    assert Scale(factor, offset).counts(value) == round(exact)


@given(st.integers(-40000, 40000), factors, numbers)
def test_near_the_middle_between_two_counts_the_exact_quotient_decides(count, factor, offset):
    middle = float((Fraction(count) + Fraction(1, 2)) * Fraction(factor) + Fraction(offset))
    for value in (np.nextafter(middle, -np.inf), middle, np.nextafter(middle, np.inf)):
        exact = (Fraction(float(value)) - Fraction(offset)) / Fraction(factor)
        assert Scale(factor, offset).counts(float(value)) == round(exact)


@given(st.lists(numbers, max_size=20), factors, numbers)
def test_sure_counts_of_an_array_are_those_of_its_numbers(values, factor, offset):
    scale = Scale(factor, offset)
    counts, sure = scale.sure_counts(np.array(values, np.float64))
    for value, found, is_sure in zip(values, counts.tolist(), sure.tolist(), strict=True):
        assert not is_sure or found == scale.counts(value)


def test_few_counts_are_left_in_doubt():
    values = np.linspace(0.0, 100.0, 10007)
    _, sure = Scale(0.01).sure_counts(values)
    assert np.count_nonzero(~sure) < 10
