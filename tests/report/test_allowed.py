"""What is shaded as allowed is what every requirement on the signal allows, at any time."""

from math import inf

from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.judge.verdict import Band
from fcl_sim.report.allowed import allowed, of_runs

TIMES, LIMITS = st.integers(0, 9), st.none() | st.integers(-3, 3)


@st.composite
def bands(draw):
    start, end = sorted([draw(TIMES), draw(TIMES)])
    low, high = draw(LIMITS), draw(LIMITS)
    if low is not None and high is not None and low > high:
        low, high = high, low
    if low is None and high is None:
        low = 0
    return band(start, end, low, high)


def band(start, end, low, high):
    return Band(signal="x", low=low, high=high, start=start, end=end)


def holds(each, time, value):
    low, high = -inf if each.low is None else each.low, inf if each.high is None else each.high
    return each.start <= time <= each.end and low <= value <= high


@given(st.lists(bands(), max_size=5), st.integers(0, 8), st.integers(-7, 7))
def test_between_the_ends_of_bands_that_is_allowed_which_all_of_them_allow(asked, step, value):
    time, value = step + 0.5, value / 2.0
    at_work = [each for each in asked if each.start <= time <= each.end]
    expected = bool(at_work) and all(holds(each, time, value) for each in at_work)
    assert any(holds(each, time, value) for each in allowed(asked)) == expected


@given(st.lists(bands(), max_size=5))
def test_at_an_instant_that_is_asked_for_all_that_hold_there_count(asked):
    for each in (each for each in allowed(asked) if each.start == each.end):
        for value in (-3.5, -1.0, 0.0, 0.5, 3.0):
            at_work = [other for other in asked if other.start <= each.start <= other.end]
            assert holds(each, each.start, value) == all(holds(one, each.start, value) for one in at_work)


def test_a_wide_bound_does_not_hide_a_narrow_one():
    assert allowed([band(0, 60, -40, 40), band(35, 60, -0.5, 0.5)]) == [
        band(0, 35, -40, 40),
        band(35, 60, -0.5, 0.5),
    ]


def test_where_bounds_exclude_one_another_nothing_is_allowed():
    assert allowed([band(0, 9, 1, None), band(3, 5, None, 0)]) == [band(0, 3, 1, None), band(5, 9, 1, None)]


def test_several_runs_share_what_any_of_them_is_allowed():
    one, other = [band(0, 9, 0, 1)], [band(0, 9, 2, 3)]
    assert of_runs([one, other, one]) == [*one, *other]
