"""What formulae say of traces that a reader can follow by hand."""

import math

import numpy as np
import pytest

from fcl_sim.formula.text import plain
from fcl_sim.judge.judge import judge
from fcl_sim.judge.temporal.formula import bind, read
from fcl_sim.judge.temporal.verdict import Truth, consider
from fcl_sim.judge.verdict import Requirement, Status
from fcl_sim.loop.trace import Fault, Trace
from tests.judge.formulae import formula, trace

HALF = 500_000_000


def truth(text, x, y=None, ticks=None):
    return consider(formula(text), trace(x, y, ticks)).truth


def robustness(text, x, y=None, ticks=None):
    return consider(formula(text), trace(x, y, ticks)).robustness


def test_bounds_are_closed_and_compared_in_nanoseconds():
    bad_at_two = [0, 0, 9, 0]
    assert truth("always[2 s, 3 s] x < 1", bad_at_two) is Truth.FAILS
    assert truth("always[1 s, 2 s] x < 1", bad_at_two) is Truth.FAILS
    assert truth("always[2000000001 ns, 3 s] x < 1", bad_at_two) is Truth.FAILS  # held from 2 s to 3 s
    assert truth("always[0 s, 1999999999 ns] x < 1", bad_at_two) is Truth.HOLDS
    assert truth("always[3 s, 3 s] x < 1", bad_at_two) is Truth.HOLDS


def test_times_count_from_the_first_scan():
    late = np.array([100, 101, 102, 103]) * 2 * HALF
    assert truth("always[2 s, 2 s] x > 5", [0, 0, 9, 0], ticks=late) is Truth.HOLDS


def test_a_signal_is_held_between_scans_that_lie_unevenly():
    ticks = np.array([0, 1, 5, 6]) * HALF
    assert truth("always[1 s, 2 s] x > 5", [0, 9, 0, 0], ticks=ticks) is Truth.HOLDS
    assert truth("always[1 s, 2.5 s] x > 5", [0, 9, 0, 0], ticks=ticks) is Truth.FAILS


def test_robustness_is_how_far_the_deciding_sample_is_from_the_bound():
    assert robustness("always x < 5", [1, 3, 2]) == 2
    assert robustness("always x < 5", [1, 8, 2]) == -3
    assert robustness("eventually x > 5", [1, 3, 2]) == -2
    assert robustness("x > 0 until y > 0", [3, 2, -1, -1], [-1, -1, 5, -1]) == 2
    assert robustness("x > 0 until[0 s, 1 s] y > 0", [3, 2, -1, -1], [-1, -1, 5, -1]) == -1


def test_a_bound_that_is_met_exactly_is_told_apart_from_one_that_is_not():
    assert truth("x <= 5", [5]) is truth("x >= 5", [5]) is truth("x == 5", [5]) is Truth.HOLDS
    assert truth("x < 5", [5]) is truth("x > 5", [5]) is truth("x != 5", [5]) is Truth.FAILS
    assert robustness("x <= 5", [5]) == robustness("x < 5", [5]) == 0


def test_until_lets_go_at_the_scan_at_which_its_end_comes():
    assert truth("x > 0 until y > 0", [1, 1, 0], [0, 0, 1]) is Truth.HOLDS
    assert truth("x > 0 until y > 0", [1, 0, 0], [0, 0, 1]) is Truth.FAILS
    assert truth("x > 0 until y > 0", [1, 1, 1], [0, 0, 0]) is Truth.FAILS
    assert truth("x > 0 until[0 s, 5 s] y > 0", [1, 1, 1], [0, 0, 0]) is Truth.OPEN


def test_edges_need_a_scan_before():
    assert truth("eventually rise(x > 0)", [1, 1, 0, 1]) is Truth.HOLDS
    assert truth("eventually rise(x > 0)", [1, 1, 0, 0]) is Truth.FAILS
    assert truth("eventually fall(x > 0)", [1, 1, 0, 0]) is Truth.HOLDS


def test_what_lies_beyond_the_end_is_open_unless_it_does_not_matter():
    assert truth("always[0 s, 5 s] x < 1", [0, 0]) is Truth.OPEN
    assert truth("always[0 s, 5 s] x < 1", [0, 2]) is Truth.FAILS
    assert truth("eventually[0 s, 5 s] x > 1", [0, 0]) is Truth.OPEN
    assert truth("eventually[0 s, 5 s] x > 1", [0, 2]) is Truth.HOLDS
    assert truth("always[7 s, end] x < 1", [0, 0]) is Truth.OPEN
    assert truth("whenever x > 1, then within 2 s y > 1", [0, 2, 0], [0, 0, 0]) is Truth.OPEN
    assert truth("whenever x > 1, then within 2 s y > 1", [0, 2, 0], [0, 0, 2]) is Truth.HOLDS


def test_a_trigger_that_never_comes_leaves_it_untested():
    found = consider(formula("whenever rise(x > 1), then y > 1"), trace([2, 0, 0]))
    assert found.truth is Truth.UNTESTED
    assert found.about == "rise(x > 1)"
    assert truth("always[2 s, 3 s] (x > 1 implies y > 1)", [2, 2, 0, 0]) is Truth.UNTESTED
    assert truth("always (x > 1 implies y > 1)", [0, 2], [0, 0]) is Truth.FAILS
    assert truth("always (x > 1 implies y > 1)", [0, 2], [0, 2]) is Truth.HOLDS
    assert truth("always (not (x > 1) or y > 1)", [0, 0]) is Truth.HOLDS


def test_a_trigger_that_might_come_after_the_end_has_not_come():
    assert truth("whenever eventually[0 s, 9 s] x > 1, then true", [0, 0]) is Truth.UNTESTED
    assert truth("whenever eventually[0 s, 9 s] x > 1, then true", [0, 2]) is Truth.HOLDS


def test_a_missing_number_behind_a_trigger_that_does_not_come_is_not_looked_at():
    assert truth("whenever x > 1, then y > 1", [0, 2, 0], [math.nan, 2, math.nan]) is Truth.HOLDS
    assert truth("whenever x > 1, then y > 1", [0, 2, 0], [2, math.nan, 2]) is Truth.BROKEN


def test_a_missing_number_far_off_does_not_spoil_a_promise_that_was_kept():
    found = consider(formula("x > 0 until[0 s, 1 s] y > 0"), trace([1, 1, math.nan, 1], [0, 1, 0, math.nan]))
    assert (found.truth, found.robustness) == (Truth.HOLDS, 1)


def test_units_are_converted_before_anything_is_compared():
    run = trace([0.0, 90.0], [2.0, 2.0], units={"x": "deg", "y": "km"})

    def found(text):
        return consider(formula(text, run.units), run)

    assert found("always x <= 1.6 rad").truth is Truth.HOLDS
    assert found("always x <= 1.6 rad").robustness == pytest.approx(math.degrees(1.6) - 90)
    assert found("y + 500 m == 2500 m").truth is Truth.HOLDS
    far = trace([1500.0, 2500.0], [2.0, 2.0], units={"x": "m", "y": "km"})
    assert consider(formula("always x <= y", far.units), far).robustness == -500.0
    assert consider(formula("always y >= min(x, 1 km)", far.units), far).robustness == 1.0
    assert found("always[0 s, 1 s] y / 1 min < 3 km/min").truth is Truth.HOLDS


VIOLATIONS = [
    ("always x < 5", [1, 8, 9, 1, 8], None, (1, 2)),
    ("always[3 s, end] x < 5", [1, 8, 9, 1, 8], None, (4, 4)),
    ("eventually[1 s, 3 s] x > 5", [9, 1, 1, 1, 9], None, (1, 3)),
    ("never x > 5", [1, 8, 9, 1, 8], None, (1, 2)),
    ("always x < 5 and always y < 5", [1, 1, 1, 8], [1, 8, 1, 1], (1, 1)),
    ("always (x < 5 or y < 5)", [1, 8, 8, 8], [8, 8, 8, 1], (1, 2)),
    ("x < 5 until y > 0", [1, 1, 8, 8], [0, 0, 0, 1], (0, 2)),
    ("whenever rise(x > 1), then within 2 s y > 1", [0, 2, 2, 0, 0, 0], [0, 0, 0, 0, 2, 0], (1, 3)),
    ("whenever x > 1, then y > 1 for at least 2 s", [0, 2, 0, 0, 0], [0, 2, 2, 0, 2], (1, 3)),
    ("x > 1 lasts at least 2 s", [0, 2, 2, 0, 2, 2, 2], None, (1, 3)),
    ("within 2 s x < 1 for good", [0, 0, 0, 0, 9], None, (4, 4)),
    ("within 2 s x < 1 for good", [9, 9, 0, 0, 9, 9, 0], None, (4, 5)),
    ("within 2 s x < 1 for good", [9, 9, 9, 9, 0, 9, 0], None, (2, 3)),
    ("not always (eventually x > 1)", [0, 2, 0, 2, 2], None, (4, 4)),
]


@pytest.mark.parametrize(
    ("text", "x", "y", "expected"), VIOLATIONS, ids=[f"{each[0]} {each[1]}" for each in VIOLATIONS]
)
def test_the_first_violation_is_where_a_reader_would_look(text, x, y, expected):
    assert consider(formula(text), trace(x, y)).violation == expected


BLAMED = [
    ("always (x < 5 and y < 5)", [1, 8, 1], [1, 1, 1], ("x",)),
    ("always (x < 5 and y < 5)", [1, 8, 1], [1, 9, 1], ("x", "y")),
    ("within 3 s (x < 5 and y < 5) for good", [1, 8, 8, 8, 8], [1, 1, 1, 1, 1], ("x",)),
    ("whenever x > 1, then y > 1", [0, 2, 0], [0, 0, 0], ("y",)),
    ("never (x > 5 or y > 5)", [1, 1, 1], [1, 8, 1], ("y",)),
    ("always not (x > 5 implies y > 5)", [9, 1, 9], [1, 1, 1], ("x",)),
    ("x < 5 until y > 0", [1, 1, 8, 8], [0, 0, 0, 1], ("x", "y")),
    ("eventually rise(x > 1)", [0, 0, 0], [0, 0, 0], ("x",)),
]


@pytest.mark.parametrize(
    ("text", "x", "y", "expected"), BLAMED, ids=[f"{each[0]} {each[1]} {each[2]}" for each in BLAMED]
)
def test_to_blame_are_the_signals_that_make_it_false_there(text, x, y, expected):
    assert consider(formula(text), trace(x, y)).blamed == expected


def test_of_a_formula_that_holds_no_signal_is_to_blame():
    assert consider(formula("always x < 5"), trace([1, 1])).blamed == ()


def verdict(run: Trace, text: str, *, expect_fail: bool = False):
    asked = formula(text, run.units)
    requirement = Requirement(
        id="F-1", text="as told", formula=asked, unit=asked.unit or "", expect_fail=expect_fail
    )
    (found,) = judge(run, [requirement])
    return found


def sways(*values) -> Trace:
    return trace(values, units={"crane.sway": "deg", "crane.distance": "m"})


def test_a_verdict_says_by_how_much_by_what_and_when():
    found = verdict(sways(0, 6, 4, 9), "always abs(crane.sway) < 9.25 deg")
    assert (found.status, found.value, found.violation) == (Status.PASS, 0.25, None)
    assert found.definition == "always (abs(crane.sway) < 9.25 deg)"
    assert found.reason == (
        "The formula holds, by a margin of 0.25 deg, that of `abs(crane.sway) < 9.25 deg` at 3 s."
    )


def test_a_failed_verdict_says_where_it_is_first_violated():
    found = verdict(sways(0, 6, 7, 0, 9), "always crane.sway < 5 deg")
    assert (found.status, found.value, found.violation) == (Status.FAIL, -4.0, (1.0, 2.0))
    assert found.reason == (
        "The formula does not hold, by a margin of -4 deg, that of `crane.sway < 5 deg` at 4 s, "
        "first violated from 1 s to 2 s."
    )


def test_what_a_formula_waits_for_is_not_told_as_what_decides_a_miss():
    """The edge of y is nearer to being none than x is to its bound, and so decides the robustness."""
    run = trace([0.0, 90.0, 90.0], [0.0, 2.0, 2.0])
    found = verdict(run, "whenever rise(y > 1), then x < 20")
    assert found.reason == "The formula does not hold for x, first violated at 1 s."
    assert (found.value, found.blamed) == (-1.0, ("x",))


def test_the_margin_of_a_miss_is_told_where_it_is_missed():
    found = verdict(sways(0, 7, 0, 0, 7), "within 3 s crane.sway < 5 deg for good")
    assert found.reason == (
        "The formula does not hold, by a margin of -2 deg, that of `crane.sway < 5 deg` at 4 s, "
        "first violated at 4 s."
    )


def test_comparisons_in_several_units_have_a_margin_and_no_value():
    found = verdict(sways(0, 1), "always (crane.sway < 5 deg and crane.distance < 1 m)")
    assert (found.status, found.value) == (Status.PASS, None)
    assert "a margin of 1 m, that of `crane.distance < 1 m`" in found.reason


def test_an_expected_miss_of_a_formula_passes_and_an_open_one_does_not():
    assert verdict(sways(9), "always crane.sway < 5 deg", expect_fail=True).status is Status.PASS
    assert verdict(sways(1), "always crane.sway < 5 deg", expect_fail=True).status is Status.FAIL
    found = verdict(sways(1), "always[0 s, 5 s] crane.sway < 5 deg", expect_fail=True)
    assert found.status is Status.INCONCLUSIVE
    assert found.reason == (
        "The trace ends at 0 s, before it is decided whether the formula holds. "
        "That is not the expected miss."
    )


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_nan_never_passes_a_formula_that_looks_at_it(bad):
    run = sways(1, bad, 1)
    for text in ("always crane.sway < 5 deg", "eventually crane.sway < 5 deg", "never crane.sway > 5 deg"):
        found = verdict(run, text)
        assert (found.status, found.value) == (Status.FAULT, None)
        assert "is not finite at 1 s" in found.reason
    assert verdict(run, "always[2 s, 2 s] crane.sway < 5 deg").status is Status.PASS


def test_what_cannot_be_computed_is_a_fault_as_well():
    found = verdict(sways(1, 0), "always 1 deg / crane.sway < 5")
    assert found.status is Status.FAULT


def test_a_run_that_broke_off_satisfies_nothing():
    run = sways(1, 1)
    broken = Trace(run.ticks, run.names, run.units, run.values, fault=Fault(1, "crane.sway", "it diverges"))
    assert verdict(broken, "always crane.sway < 5 deg").status is Status.FAULT


def test_a_trace_without_a_scan_tells_nothing():
    assert verdict(sways(), "always crane.sway < 5 deg").status is Status.INCONCLUSIVE


def test_a_margin_between_temperatures_is_a_difference_and_that_is_in_kelvin():
    units = {"x": "degC", "y": "K"}
    asked = bind(read(plain("always x < 95 degC")), units)
    assert asked.unit == "K"
    (found,) = judge(
        trace([80.0, 86.5], units=units), [Requirement(id="T", text="t", formula=asked, unit="K")]
    )
    assert found.reason.startswith("The formula holds, by a margin of 8.5 K, that of `x < 95 degC` at 1 s")
    assert bind(read(plain("always (x < 95 degC and y < 2 K)")), units).unit is None
