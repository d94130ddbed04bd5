"""FUZ_STERM against each diagram of pp. 71 to 74."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fcl_sim import concept
from tests.concept.exact import HALF_ULP, INTS, ROUNDINGS, counts, named, on_polyline, points

# Points are places 0 .. 3 of four rising numbers: first S1 .., then where the diagram has its corners.
RAMPS_OF_2 = {
    "2 falling": ((1, 0), [(0, 1), (1, 0)]),
    "2 rising": ((0, 1), [(0, 0), (1, 1)]),
}
OF_3 = {
    "3 triangle": ((0, 1, 2), [(0, 0), (1, 1), (2, 0)]),
    "3 falling, S1 last": ((2, 0, 1), [(0, 1), (1, 0)]),
    "3 falling, S1 between": ((1, 0, 2), [(0, 1), (2, 0)]),
    "3 falling, S1 = S3": ((1, 0, 1), [(0, 1), (1, 0)]),
    "3 rising, S3 first": ((1, 2, 0), [(1, 0), (2, 1)]),
    "3 rising, S3 between": ((0, 2, 1), [(0, 0), (2, 1)]),
    "3 rising, S1 = S3": ((0, 1, 0), [(0, 0), (1, 1)]),
}
OF_4 = {
    "4 trapezium": ((0, 1, 2, 3), [(0, 0), (1, 1), (2, 1), (3, 0)]),
    "4 triangle, S3 = S2": ((0, 1, 1, 2), [(0, 0), (1, 1), (2, 0)]),
    "4 triangle, S3 between S1 and S2": ((0, 2, 1, 3), [(0, 0), (2, 1), (3, 0)]),
    "4 triangle, S3 = S1": ((0, 1, 0, 2), [(0, 0), (1, 1), (2, 0)]),
    "4 triangle, S3 first": ((1, 2, 0, 3), [(1, 0), (2, 1), (3, 0)]),
    "4 falling, S1 last": ((3, 0, 1, 2), [(1, 1), (2, 0)]),
    "4 falling, S1 between S2 and S3": ((1, 0, 2, 3), [(2, 1), (3, 0)]),
    "4 falling, S2 = S3": ((3, 1, 1, 2), [(1, 1), (2, 0)]),
    "4 falling, S1 = S4": ((2, 0, 1, 2), [(1, 1), (2, 0)]),
    "4 rising, S4 first": ((1, 2, 3, 0), [(1, 0), (2, 1)]),
    "4 rising, S4 between S2 and S3": ((0, 1, 3, 2), [(0, 0), (1, 1)]),
    "4 rising, S2 = S3": ((0, 2, 2, 1), [(0, 0), (2, 1)]),
    "4 rising, S4 = S1": ((0, 1, 2, 0), [(0, 0), (1, 1)]),
}
DIAGRAMS = RAMPS_OF_2 | OF_3 | OF_4

FOUR = points(4, 4)


def degree(kind, x, places, **options):
    block = kind(X=x, **named("S", places), **options)
    block()
    assert block.ENO
    return block.MD


@pytest.mark.parametrize("diagram", DIAGRAMS)
@settings(max_examples=30)
@given(FOUR, INTS, st.integers(0, 3))
def test_a_degree_is_the_diagrams(diagram, four, x, at):
    order, corners = DIAGRAMS[diagram]
    places = [four[each] for each in order]
    line = [(four[each], height) for each, height in corners]
    for value in (x, four[at]):
        exact = on_polyline(line, value)
        for rounding in ROUNDINGS:
            expected = counts(10_000 * exact, rounding)
            assert degree(concept.FUZ_STERM_INT, value, places, rounding=rounding) == expected
        assert abs(Fraction(degree(concept.FUZ_STERM_REAL, value, places)) - exact) <= HALF_ULP


@pytest.mark.parametrize("diagram", DIAGRAMS)
@settings(max_examples=30)
@given(FOUR, INTS, INTS)
def test_a_degree_is_monotone_on_each_side(diagram, four, x, y):
    order, corners = DIAGRAMS[diagram]
    places = [four[each] for each in order]
    low, high = sorted((x, y))
    first, second = (degree(concept.FUZ_STERM_INT, each, places) for each in (low, high))
    tops = [four[each] for each, height in corners if height == 1]
    rises, falls = corners[0][1] == 0, corners[-1][1] == 0
    if rises and (high <= tops[0] or not falls):
        assert first <= second
    if falls and (low >= tops[-1] or not rises):
        assert first >= second


BOXES = {
    "4 rectangle": ((0, 0, 1, 1), (0, 1)),
    "4 singleton": ((0, 0, 0, 0), (0, 0)),
    "3 points alike": ((0, 0, 0), (0, 0)),
    "2 points alike": ((0, 0), (0, 0)),
}


@pytest.mark.parametrize("box", BOXES)
@given(FOUR, INTS)
def test_a_vertical_edge_has_the_larger_degree(box, four, x):
    order, (begin, end) = BOXES[box]
    places = [four[each] for each in order]
    for value in (x, four[begin] - 1, four[begin], four[end], four[end] + 1):
        if -(2**15) <= value < 2**15:
            inside = four[begin] <= value <= four[end]
            assert degree(concept.FUZ_STERM_INT, value, places) == 10_000 * inside
            assert degree(concept.FUZ_STERM_REAL, value, places) == inside


@pytest.mark.parametrize(
    ("places", "corners"),
    [
        ((0, 0, 10), [(-1, 0), (0, 1), (10, 0)]),
        ((0, 10, 10), [(0, 0), (10, 1), (11, 0)]),
        ((0, 0, 5, 10), [(-1, 0), (0, 1), (5, 1), (10, 0)]),
        ((0, 5, 10, 10), [(0, 0), (5, 1), (10, 1), (11, 0)]),
    ],
)
def test_one_side_may_be_vertical(places, corners):
    for x in range(-5, 16):
        assert degree(concept.FUZ_STERM_INT, x, places) == 10_000 * on_polyline(corners, x)


@given(points(2, 9), INTS)
def test_the_terms_of_fuz_aterm_are_those_of_fuz_sterm_to_a_count(places, x):
    every = concept.FUZ_ATERM_INT(X=x, **named("S", places))
    every()
    shapes = [places[:2][::-1], *(places[i : i + 3] for i in range(len(places) - 2)), places[-2:]]
    for index, shape in enumerate(shapes, 1):
        single = degree(concept.FUZ_STERM_INT, x, shape)
        assert 0 <= getattr(every, f"MD{index}") - single <= 1


@pytest.mark.parametrize("kind", [concept.FUZ_STERM_INT, concept.FUZ_STERM_REAL])
def test_a_fifth_point_is_an_error_that_leaves_the_output(kind):
    block = kind(**named("S", range(5)), MD=1)
    block(X=2)
    assert block.event == "E_EFB_TOO_MANY_INPUTS"
    assert not block.ENO
    assert block.MD == 1


@pytest.mark.filterwarnings("ignore:overflow encountered")
def test_a_side_longer_than_every_real_is_reported():
    block = concept.FUZ_STERM_REAL(S1=-3e38, S2=3e38, MD=0.5)
    block(X=0.0)
    assert block.event == "OVERFLOW"
    assert block.MD == 0.5
