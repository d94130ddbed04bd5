from fractions import Fraction
from math import prod

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim import concept
from tests.concept.exact import DEGREES, HALF_ULP, INTS, REAL_DEGREES, ROUNDINGS, counts, named

NAMES = ("FUZ_MIN", "FUZ_MAX", "FUZ_PROD", "FUZ_SUM")
FORMULAE = {
    "FUZ_MIN": lambda degrees: min(1, *degrees),
    "FUZ_MAX": lambda degrees: max(0, *degrees),
    "FUZ_PROD": prod,
    "FUZ_SUM": lambda degrees: min(1, sum(degrees)),
}
BOUNDS = {
    "FUZ_MIN": lambda out, degrees: out in degrees,
    "FUZ_MAX": lambda out, degrees: out in degrees,
    "FUZ_PROD": lambda out, degrees: 0 <= out <= min(degrees),
    "FUZ_SUM": lambda out, degrees: max(degrees) <= out,
}
MANY = st.lists(DEGREES, min_size=2, max_size=32)
MANY_REAL = st.lists(REAL_DEGREES, min_size=2, max_size=32)


def joined(name, degrees, **options):
    block = getattr(concept, name)(inputs=len(degrees), **options)
    block(**named(concept.BLOCKS[name].stem, degrees))
    assert block.ENO
    (out,) = block.outputs.values()
    return out


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("rounding", ROUNDINGS)
@given(MANY)
def test_an_int_operator_is_its_formula_to_a_count_for_each_division(name, rounding, degrees):
    out = joined(f"{name}_INT", degrees, rounding=rounding)
    exact = 10_000 * FORMULAE[name]([Fraction(each, 10_000) for each in degrees])
    divisions = len(degrees) - 1 if name == "FUZ_PROD" else 0
    if divisions == 1:
        assert out == counts(exact, rounding)
    assert abs(out - exact) <= divisions * (1 if rounding == "truncate" else Fraction(1, 2))


@pytest.mark.parametrize("name", NAMES)
@given(MANY_REAL)
def test_a_real_operator_is_its_formula_to_a_rounding_for_each_operation(name, degrees):
    out = joined(f"{name}_REAL", degrees)
    exact = FORMULAE[name]([Fraction(each) for each in degrees])
    operations = 0 if name in {"FUZ_MIN", "FUZ_MAX"} else len(degrees) - 1
    assert abs(Fraction(out) - exact) <= operations * HALF_ULP


@pytest.mark.parametrize("name", NAMES)
@given(MANY, MANY_REAL)
def test_an_operator_keeps_its_bounds(name, degrees, reals):
    out = joined(f"{name}_INT", degrees)
    assert 0 <= out <= 10_000
    assert BOUNDS[name](out, degrees)
    out = joined(f"{name}_REAL", reals)
    assert 0.0 <= out <= 1.0
    assert BOUNDS[name](out, reals)


@pytest.mark.parametrize("name", NAMES)
@given(DEGREES, DEGREES, REAL_DEGREES, REAL_DEGREES)
def test_an_operator_takes_two_degrees_in_either_order(name, a, b, c, d):
    assert joined(f"{name}_INT", [a, b]) == joined(f"{name}_INT", [b, a])
    assert joined(f"{name}_REAL", [c, d]) == joined(f"{name}_REAL", [d, c])


@pytest.mark.parametrize("name", NAMES)
@given(DEGREES, DEGREES, DEGREES)
def test_an_operator_rises_with_each_degree(name, a, b, c):
    low, high = sorted((a, b))
    assert joined(f"{name}_INT", [low, c]) <= joined(f"{name}_INT", [high, c])


def test_the_products_of_the_manual():
    assert joined("FUZ_PROD_INT", [3000, 6000]) == 1800
    assert joined("FUZ_PROD_REAL", [0.3, 0.6]) == pytest.approx(0.18, rel=2e-7)


@given(st.lists(INTS, min_size=2, max_size=4))
def test_what_is_no_degree_is_taken_as_the_formulae_take_it(values):
    assert joined("FUZ_MIN_INT", values) == min(10_000, *values)
    assert joined("FUZ_MAX_INT", values) == max(0, *values)


def test_sums_and_products_that_leave_an_int_are_reported():
    for name, values in [
        ("FUZ_SUM_INT", [-30_000, -30_000]),
        ("FUZ_PROD_INT", [32_767, 32_767]),
        ("FUZ_PROD_INT", [32_767, 32_767, 32_767, 0]),  # on the way
    ]:
        block = getattr(concept, name)(inputs=len(values), MD=5)
        block(**named("MD", values))
        assert block.event == "OVERFLOW"
        assert not block.ENO
        assert block.MD == 5


@pytest.mark.filterwarnings("ignore:overflow encountered")
@pytest.mark.parametrize(
    ("kind", "values"), [(concept.FUZ_SUM_REAL, (-3e38, -3e38)), (concept.FUZ_PROD_REAL, (1e30, 1e30))]
)
def test_sums_and_products_that_leave_a_real_are_reported(kind, values):
    block = kind(MD=0.5)
    block(**named("MD", values))
    assert block.event == "OVERFLOW"
    assert block.MD == 0.5
