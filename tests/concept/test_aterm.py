from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim import concept
from tests.concept.exact import HALF_ULP, INTS, ROUNDINGS, counts, named, on_polyline, points


def degrees(block):
    return [getattr(block, f"MD{i}") for i in range(1, 10)]


def term(places, index, x):
    return on_polyline([(place, int(i == index)) for i, place in enumerate(places)], x)


@pytest.mark.parametrize("rounding", ROUNDINGS)
@given(points(2, 9), INTS)
def test_each_int_degree_is_the_exact_one_to_a_count(rounding, places, x):
    block = concept.FUZ_ATERM_INT(rounding=rounding, **named("S", places))
    block(X=x)
    segment = max([i for i in range(len(places) - 1) if places[i] <= x], default=0)
    up = counts(10_000 * term(places, segment + 1, x), rounding)
    expected = [0] * 9
    expected[segment], expected[segment + 1] = 10_000 - up, up
    assert degrees(block) == expected
    assert block.ENO
    for index, degree in enumerate(degrees(block)[: len(places)]):
        assert abs(degree - 10_000 * term(places, index, x)) < 1


@given(points(2, 9), INTS)
def test_each_real_degree_is_the_exact_one_to_a_rounding(places, x):
    block = concept.FUZ_ATERM_REAL(**named("S", places))
    block(X=x)
    for index, degree in enumerate(degrees(block)[: len(places)]):
        assert abs(Fraction(degree) - term(places, index, x)) <= HALF_ULP


@pytest.mark.parametrize("rounding", ROUNDINGS)
@given(points(2, 9), INTS)
def test_the_sum_of_int_degrees_is_always_10000(rounding, places, x):
    block = concept.FUZ_ATERM_INT(rounding=rounding, X=x, **named("S", places))
    block()
    assert sum(degrees(block)) == 10_000
    assert all(0 <= degree <= 10_000 for degree in degrees(block))


REALS = st.floats(-(2.0**100), 2.0**100, width=32)


@given(st.lists(REALS, min_size=2, max_size=9, unique=True).map(sorted), REALS)
def test_the_sum_of_real_degrees_is_always_1(places, x):
    block = concept.FUZ_ATERM_REAL(X=x, **named("S", places))
    block()
    assert np.array(degrees(block), np.float32).sum() == 1.0
    assert all(0.0 <= degree <= 1.0 for degree in degrees(block))


@given(points(3, 9), INTS, INTS, st.data())
def test_a_degree_rises_up_to_its_point_and_falls_past_it(places, x, y, data):
    index = data.draw(st.integers(0, len(places) - 1))
    block = concept.FUZ_ATERM_INT(**named("S", places))
    near, far = sorted((x, y), key=lambda each: abs(each - places[index]))
    if (near < places[index]) == (far < places[index]):
        block(X=near)
        degree = degrees(block)[index]
        block(X=far)
        assert degrees(block)[index] <= degree


def test_outputs_of_terms_that_are_not_there_are_0():
    block = concept.FUZ_ATERM_INT(S1=0, S2=10, S3=20, MD3=7, MD4=8, MD9=9)
    block(X=20)
    assert degrees(block) == [0, 0, 10_000, 0, 0, 0, 0, 0, 0]


@given(points(2, 9), INTS)
def test_the_structure_has_the_same_degrees_and_their_number(places, x):
    plain = concept.FUZ_ATERM_INT(X=x, **named("S", places))
    structured = concept.FUZ_ATERM_STI(X=x, **named("S", places))
    plain()
    structured()
    assert structured.MD == (len(places), *degrees(plain))
    real = concept.FUZ_ATERM_REAL(X=x, **named("S", places))
    structure = concept.FUZ_ATERM_STR(X=x, **named("S", places))
    real()
    structure()
    assert structure.MD == (len(places), *degrees(real))


@pytest.mark.parametrize(
    ("block", "structure"),
    [(concept.FUZ_ATERM_STI, concept.FUZ_MD_INT), (concept.FUZ_ATERM_STR, concept.FUZ_MD_REAL)],
)
def test_the_structure_keeps_the_terms_that_are_not_there(block, structure):
    instance = block(S1=0, S2=1, MD=structure(9, 1, 1, 1, 0, 1, 0, 1, 0, 1))
    instance(X=0)
    full = 10_000 if structure is concept.FUZ_MD_INT else 1.0
    assert instance.MD == structure(2, full, 0, 1, 0, 1, 0, 1, 0, 1)


KINDS = [concept.FUZ_ATERM_INT, concept.FUZ_ATERM_REAL, concept.FUZ_ATERM_STI, concept.FUZ_ATERM_STR]


@pytest.mark.parametrize("kind", KINDS, ids=lambda each: each.args[0].name)
@pytest.mark.parametrize("places", [(0, 0), (1, 0), (0, 10, 10), (0, 10, 5), (5, 0, 10)])
def test_points_that_do_not_rise_are_an_error_that_leaves_the_outputs(kind, places):
    block = kind(S1=0, S2=20, S3=30)
    block(X=30)
    before = block.outputs
    block(X=5, **named("S", (*places, 10)[:3]))
    assert block.event == "E_EFB_INPUT_VALUE_OUT_OF_RANGE"
    assert not block.ENO
    assert block.outputs == before
    block(X=30, S1=0, S2=20, S3=30)
    assert block.event is None
    assert block.ENO


@pytest.mark.parametrize("kind", KINDS, ids=lambda each: each.args[0].name)
def test_a_tenth_point_is_an_error(kind):
    most = kind(**named("S", range(9)))
    most(X=8)
    assert most.ENO
    more = kind(**named("S", range(10)))
    more(X=8)
    assert more.event == "E_EFB_TOO_MANY_INPUTS"
    assert not more.ENO
    assert set(more.outputs.values()) <= {0, concept.FUZ_MD_INT()}


@pytest.mark.filterwarnings("ignore:overflow encountered")
def test_a_segment_longer_than_every_real_is_reported():
    block = concept.FUZ_ATERM_REAL(S1=-3e38, S2=3e38)
    block(X=0.0)
    assert block.event == "OVERFLOW"
    assert not block.ENO
