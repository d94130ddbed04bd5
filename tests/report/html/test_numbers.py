"""Numbers as the script writes them, beside those of the rest of the report."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.report.words import number
from tests.report.html.scripts import Script

SCRIPT = Script("numbers.js")


@given(st.floats(-9999, 9999).filter(lambda value: value == 0 or abs(value) >= 1e-4))
def test_a_number_of_common_size_reads_as_on_paper(value):
    assert SCRIPT.call("number", value) == number(value)


@pytest.mark.parametrize(
    ("value", "text"), [(12345.6, "12350"), (1.5e-5, "1.5e−5"), (-2e7, "−2e7"), (0, "0")]
)
def test_large_and_small_numbers(value, text):
    assert SCRIPT.call("number", value) == text


@given(st.floats(-1e5, 1e5), st.floats(1e-3, 1e5), st.integers(2, 9))
def test_marks_are_round_and_evenly_spaced_inside_of_the_axis(low, span, most):
    marks = SCRIPT.call("marks", low, low + span, most)
    places = [each["at"] for each in marks]
    assert len(places) <= most + 1
    assert all(low - 1e-6 * span <= at <= low + (1 + 1e-6) * span for at in places)
    labels = [each["label"] for each in marks]
    assert len(set(labels)) == len(labels)
    if len(places) > 2:
        steps = [after - before for before, after in pairwise(places)]
        assert max(steps) == pytest.approx(min(steps), rel=1e-6)


@pytest.mark.parametrize(
    ("time", "scan", "text"),
    [(1.25, 0.05, "1.25"), (60, 0.5, "60.0"), (14400, 1, "14400"), (0.0125, 0.0025, "0.0125")],
)
def test_a_time_has_the_decimals_of_its_scan(time, scan, text):
    assert SCRIPT.call("seconds", time, scan) == text
