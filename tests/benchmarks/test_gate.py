"""The gate on speed: it is closed by what is slower than it may be, and by what was not measured."""

import math
import re

import pytest

from benchmarks.gate import beyond, bounds
from benchmarks.yardstick import Line
from tests.house.places import ROOT

SECTIONS = ("block", "loop")
LINES = (
    Line("crane, 10 ms", "2.4 ms", 2.0),
    Line("crane, 50 ms", "9 ms", 3.0),
    Line.of("memory: grows by 0"),
)


def test_a_line_of_text_has_no_ratio():
    assert Line.of("memory: grows by 0: nothing") == Line("memory", "grows by 0: nothing", None)


def test_what_is_within_its_bound_passes_and_what_is_beyond_is_named():
    assert list(beyond({"crane, 10 ms": 2.0}, LINES)) == []
    assert list(beyond({"crane, 10 ms": 1.9, "crane, 50 ms": 4}, LINES)) == [
        "crane, 10 ms: 2.00 times C, and 1.9 is allowed"
    ]


def test_what_was_not_measured_does_not_pass():
    assert list(beyond({"crane, 10ms": 9.0}, LINES)) == [
        "crane, 10ms: was not measured; did you mean `crane, 10 ms`?"
    ]
    assert len(list(beyond({"memory": 9.0}, LINES))) == 1
    assert len(list(beyond({"x": 9.0}, (Line("x", "", math.nan),)))) == 1


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[lop]\nx = 1.0", "there is no section lop; did you mean `loop`?"),
        ("loop = 1.0", "the bounds of loop are ratios to C"),
        ("[loop]\nx = '1 ms'", "the bounds of loop are ratios to C"),
        ("[loop]\nx = true", "the bounds of loop are ratios to C"),
        ("[loop]\n", "there is no bound: a gate of nothing must not be green"),
        ("", "there is no bound: a gate of nothing must not be green"),
        ("[loop", "the bounds are not TOML"),
    ],
)
def test_bounds_that_make_no_sense_are_refused(text, message):
    with pytest.raises(SystemExit, match=re.escape(message)):
        bounds(text, SECTIONS)


def test_the_shipped_bounds_are_read():
    found = bounds((ROOT / "benchmarks" / "gate.toml").read_text("utf-8"), ("block", "loop", "lag"))
    assert set(found) == {"block", "loop", "lag"}
