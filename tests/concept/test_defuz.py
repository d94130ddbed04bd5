from fractions import Fraction

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from fcl_sim import concept
from tests.concept.exact import DEGREES, INTS, REAL_DEGREES, ROUNDINGS, counts, named

PLACES_32_BIT = st.integers(-23_000, 23_000)
"""Nine full degrees of these stay within 32 bits."""

SINGLETONS = st.lists(st.tuples(DEGREES, PLACES_32_BIT), min_size=2, max_size=9)


def defuzzified(kind, singletons, **options):
    flat = [number for pair in singletons for number in pair]
    block = kind(**named("MDiSi", flat), **options)
    block()
    return block


def structured(kind, structure, singletons, **options):
    degrees = [degree for degree, _ in singletons]
    block = kind(
        MD=structure(len(singletons), *degrees), **named("S", [place for _, place in singletons]), **options
    )
    block()
    return block


def mean(singletons):
    total = sum(Fraction(degree) for degree, _ in singletons)
    return sum(Fraction(degree) * Fraction(place) for degree, place in singletons) / total


@pytest.mark.parametrize("rounding", ROUNDINGS)
@given(SINGLETONS)
def test_an_int_output_is_the_weighted_mean_divided_once(rounding, singletons):
    assume(any(degree for degree, _ in singletons))
    block = defuzzified(concept.DEFUZ_INT, singletons, rounding=rounding)
    assert block.ENO
    assert block.Y == counts(mean(singletons), rounding)
    places = [place for _, place in singletons]
    assert min(places) <= block.Y <= max(places)
    twin = structured(concept.DEFUZ_STI, concept.FUZ_MD_INT, singletons, rounding=rounding)
    assert (twin.Y, twin.ENO, twin.event) == (block.Y, True, None)


REAL_PLACES = st.floats(-(2.0**40), 2.0**40, width=32, allow_subnormal=False)


@given(st.lists(st.tuples(REAL_DEGREES, REAL_PLACES), min_size=2, max_size=9))
def test_a_real_output_is_the_weighted_mean_to_its_roundings(singletons):
    assume(max(degree for degree, _ in singletons) >= 2**-60)
    block = defuzzified(concept.DEFUZ_REAL, singletons)
    total = sum(Fraction(degree) for degree, _ in singletons)
    size = sum(Fraction(degree) * abs(Fraction(place)) for degree, place in singletons) / total
    assert abs(Fraction(block.Y) - mean(singletons)) <= 24 * size * Fraction(1, 2**24) + Fraction(1, 2**60)
    assert structured(concept.DEFUZ_STR, concept.FUZ_MD_REAL, singletons).Y == block.Y


@given(st.lists(st.tuples(DEGREES, INTS), min_size=2, max_size=9))
def test_a_sum_that_leaves_32_bits_is_reported_and_no_other(singletons):
    sums = [sum(degree * place for degree, place in singletons[:n]) for n in range(1, len(singletons) + 1)]
    fits = all(-(2**31) <= each < 2**31 for each in sums)
    block = defuzzified(concept.DEFUZ_INT, singletons, Y=77)
    assert block.ENO == fits
    if not fits:
        assert block.event == "OVERFLOW"
        assert block.Y == 77


@pytest.mark.parametrize(
    ("place", "fits"), [(30_678, True), (30_679, False), (-30_678, True), (-30_679, False)]
)
def test_seven_full_degrees_reach_the_edge_of_32_bits(place, fits):
    block = defuzzified(concept.DEFUZ_INT, [(10_000, place)] * 7, Y=1)
    assert block.ENO == fits
    assert block.Y == (place if fits else 1)


@pytest.mark.filterwarnings("ignore:overflow encountered")
def test_a_sum_that_leaves_the_reals_is_reported():
    block = defuzzified(concept.DEFUZ_REAL, [(1.0, 3e38), (1.0, 3e38)], Y=2)
    assert (block.event, block.ENO, block.Y) == ("OVERFLOW", False, 2)


BLOCKS = {
    "DEFUZ_INT": lambda pairs, **options: defuzzified(concept.DEFUZ_INT, pairs, **options),
    "DEFUZ_REAL": lambda pairs, **options: defuzzified(concept.DEFUZ_REAL, pairs, **options),
    "DEFUZ_STI": lambda pairs, **options: structured(concept.DEFUZ_STI, concept.FUZ_MD_INT, pairs, **options),
    "DEFUZ_STR": lambda pairs, **options: structured(
        concept.DEFUZ_STR, concept.FUZ_MD_REAL, pairs, **options
    ),
}


@pytest.mark.parametrize("block", BLOCKS)
@pytest.mark.parametrize(("zero_y", "expected"), [(False, 42), (True, 0)])
def test_without_a_degree_zero_y_decides(block, zero_y, expected):
    instance = BLOCKS[block]([(0, 100), (0, 200)], ZERO_Y=zero_y, Y=42)
    assert (instance.Y, instance.ENO, instance.event) == (expected, True, None)


@pytest.mark.parametrize("zero_y", [False, True])
def test_zero_y_says_nothing_where_there_is_a_degree(zero_y):
    block = concept.DEFUZ_INT(MDiSi1=1, MDiSi2=100, MDiSi4=200, ZERO_Y=zero_y)
    block()
    assert block.Y == 100
    block(MDiSi1=0)
    assert block.Y == (0 if zero_y else 100)


@pytest.mark.parametrize("block", BLOCKS)
@pytest.mark.parametrize("wrong", ["below", "above"])
def test_a_degree_outside_its_range_is_an_error_that_leaves_the_output(block, wrong):
    above = 1.5 if block in {"DEFUZ_REAL", "DEFUZ_STR"} else 10_001
    instance = BLOCKS[block]([(1, 5), (-1 if wrong == "below" else above, 6)], Y=3)
    assert (instance.event, instance.ENO, instance.Y) == ("E_EFB_INPUT_VALUE_OUT_OF_RANGE", False, 3)


@pytest.mark.parametrize("kind", [concept.DEFUZ_INT, concept.DEFUZ_REAL])
@pytest.mark.parametrize(
    ("inputs", "event"),
    [
        (4, None),
        (5, "E_EFB_WRONG_NUMBER_OF_INPUTS"),
        (17, "E_EFB_WRONG_NUMBER_OF_INPUTS"),
        (18, None),
        (19, "E_EFB_TOO_MANY_INPUTS"),
        (20, "E_EFB_TOO_MANY_INPUTS"),
    ],
)
def test_inputs_come_in_pairs_of_which_there_are_nine_at_most(kind, inputs, event):
    block = kind(inputs=inputs, MDiSi1=1, MDiSi2=8, Y=3)
    block()
    assert (block.event, block.ENO, block.Y) == (event, event is None, 8 if event is None else 3)


STRUCTURED = [(concept.DEFUZ_STI, concept.FUZ_MD_INT), (concept.DEFUZ_STR, concept.FUZ_MD_REAL)]


@pytest.mark.parametrize(("kind", "structure"), STRUCTURED)
@pytest.mark.parametrize(("terms", "y"), [(0, 9), (1, 10), (2, 15), (3, 20), (4, 20), (9, 20), (-1, 9)])
def test_another_number_of_terms_is_a_warning_and_the_terms_in_use_count(kind, structure, terms, y):
    block = kind(S1=10, S2=20, S3=30, MD=structure(terms, 1, 1, 1, 1), Y=9)
    block()
    assert block.event == (None if terms == 3 else "E_EFB_WRONG_NUMBER_OF_INPUTS")
    assert block.ENO
    assert block.Y == y


@pytest.mark.parametrize(("kind", "structure"), STRUCTURED)
def test_a_tenth_singleton_is_an_error(kind, structure):
    block = kind(inputs=10, MD=structure(9, 1), Y=3)
    block()
    assert (block.event, block.ENO, block.Y) == ("E_EFB_TOO_MANY_INPUTS", False, 3)
