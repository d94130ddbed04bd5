"""Verdicts: in order of gravity, strict about expectations, and readable as sentences."""

import math

import numpy as np
import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.judge.judge import judge
from fcl_sim.judge.verdict import Band, Requirement, Status, Verdict, worst
from fcl_sim.loop.trace import Fault, Trace

SCAN = 50_000_000


def trace(distance, *, fault: Fault | None = None, scan: int = SCAN) -> Trace:
    values = np.asarray(distance, dtype=float)
    ticks = np.arange(values.size, dtype=np.int64) * scan
    return Trace(
        ticks=ticks,
        names=("crane.distance", "crane.sway"),
        units={"crane.distance": "m", "crane.sway": "deg"},
        values=np.column_stack([values, np.zeros_like(values)]),
        fault=fault,
    )


def requirement(**given) -> Requirement:
    asked = {
        "id": "CR-1",
        "text": "The container stands within half a metre of the target",
        "metric": "settling_time",
        "signal": "crane.distance",
        "arguments": {"final": 0.0, "band": 0.5},
        "maximum": 35.0,
        "unit": "s",
    }
    return Requirement(**{**asked, **given})


def one(run: Trace, **given) -> Verdict:
    (verdict,) = judge(run, [requirement(**given)])
    return verdict


def approach(rate: float, seconds: float = 60.0) -> Trace:
    time = np.arange(0, seconds + 0.025, 0.05)
    return trace(25 * np.exp(-rate * time))


OVERSHOOT = {"metric": "overshoot", "arguments": {"final": 0.0}, "maximum": 1.0, "unit": "m"}
LANDED = {"metric": "final_error", "arguments": {"final": 0.0}, "maximum": 0.1, "unit": "m"}


def test_a_met_requirement_passes_with_its_number_bound_and_signal() -> None:
    verdict = one(approach(0.2))
    assert verdict.status is verdict.measured is Status.PASS
    assert verdict.value == pytest.approx(5 * math.log(50), abs=1e-3)
    assert verdict.reason == "The settling time of crane.distance is 19.56 s; at most 35 s is allowed."
    assert verdict.definition.endswith("; final = 0 m, band = 0.5 m")
    assert verdict.band == Band(signal="crane.distance", low=-0.5, high=0.5, start=35.0, end=60.0)
    assert verdict.violation is None


def test_a_missed_requirement_fails_with_the_first_interval_outside() -> None:
    verdict = one(approach(0.1))
    assert verdict.status is Status.FAIL
    assert verdict.reason == (
        "The settling time of crane.distance is 39.12 s; at most 35 s is allowed, "
        "first violated from 35 s to 39.1 s."
    )
    assert verdict.violation == (35.0, 39.1)


def test_what_never_settles_fails_and_says_where_it_is() -> None:
    verdict = one(approach(0.01))
    assert verdict.status is Status.FAIL
    assert verdict.value is None
    assert verdict.reason == (
        "crane.distance does not settle: at 60 s it is at 13.72 m; at most 35 s is allowed, "
        "first violated from 35 s to 60 s."
    )


def test_a_number_is_written_with_enough_digits_to_differ_from_its_bound() -> None:
    verdict = one(trace([1.0, 0.100002]), **LANDED)
    assert verdict.reason == "The final error of crane.distance is 0.100002 m; at most 0.1 m is allowed."


def test_an_expected_miss_is_a_pass_that_measured_a_fail() -> None:
    verdict = one(trace([1.0, 0.317]), **LANDED, expect_fail=True)
    assert (verdict.status, verdict.measured) == (Status.PASS, Status.FAIL)
    assert verdict.reason == (
        "The final error of crane.distance is 0.317 m; at most 0.1 m is allowed. This miss is expected."
    )


def test_an_unexpected_pass_is_a_fail() -> None:
    verdict = one(trace([1.0, 0.05]), **LANDED, expect_fail=True)
    assert (verdict.status, verdict.measured) == (Status.FAIL, Status.PASS)
    assert verdict.reason == (
        "The final error of crane.distance is 0.05 m; at most 0.1 m is allowed. "
        "A miss was expected: the expectation no longer holds."
    )


@pytest.mark.parametrize("expect_fail", [False, True])
def test_a_fault_satisfies_nothing(expect_fail: bool) -> None:
    fault = Fault(tick=12_350_000_000, signal="crane.speed", reason="`crane.speed` is NaN or infinite")
    verdict = one(trace([1.0, 0.0], fault=fault), expect_fail=expect_fail)
    assert verdict.status is verdict.measured is Status.FAULT
    assert verdict.value is None
    assert verdict.reason.startswith("The run ended at 12.35 s: `crane.speed` is NaN or infinite.")


@pytest.mark.parametrize("bad", [math.nan, math.inf])
@pytest.mark.parametrize("metric", ["settling_time", "overshoot", "final_error", "peak", "minimum", "iae"])
@pytest.mark.parametrize("expect_fail", [False, True])
def test_nan_never_passes(bad: float, metric: str, expect_fail: bool) -> None:
    arguments = {"settling_time": {"final": 0.0, "band": 0.5}, "peak": {}, "minimum": {}}
    given = {"metric": metric, "arguments": arguments.get(metric, {"final": 0.0}), "expect_fail": expect_fail}
    verdict = one(trace([1.0, bad, 0.0]), **given, maximum=None, minimum=-1e9)
    assert verdict.status is Status.FAULT
    assert verdict.reason.startswith("crane.distance is not a finite number at 0.05 s.")


def test_nan_outside_the_window_is_none_of_its_business() -> None:
    verdict = one(trace([math.nan, 0.05, 0.05]), **{**LANDED, "arguments": {"final": 0.0, "from": 0.05}})
    assert verdict.status is Status.PASS


@pytest.mark.parametrize("expect_fail", [False, True])
def test_a_trace_that_ends_before_the_bound_is_inconclusive(expect_fail: bool) -> None:
    verdict = one(approach(0.5, seconds=30), expect_fail=expect_fail)
    assert verdict.status is verdict.measured is Status.INCONCLUSIVE
    expected = "The trace ends at 30 s, and 35 s are needed to tell; at most 35 s is allowed."
    assert verdict.reason == expected + (" That is not the expected miss." if expect_fail else "")


def test_a_trace_that_ends_before_the_window_is_inconclusive() -> None:
    verdict = one(approach(0.5, seconds=30), **{**LANDED, "arguments": {"final": 0.0, "from": 40.0}})
    assert verdict.status is Status.INCONCLUSIVE
    assert verdict.reason == "The trace ends at 30 s, before the window begins at 40 s."


def test_what_may_still_rise_after_the_end_of_the_trace_is_inconclusive() -> None:
    given = {"metric": "rise_time", "arguments": {"final": 0.0}}
    assert one(trace([25.0, 20.0, 15.0]), **given, maximum=35.0).status is Status.INCONCLUSIVE
    assert one(trace([25.0, 20.0, 15.0]), **given, maximum=0.1).status is Status.FAIL


def test_what_is_violated_before_the_trace_ends_fails_all_the_same() -> None:
    given = {"metric": "peak", "arguments": {"to": 60.0}, "maximum": 20.0, "unit": "m"}
    assert one(approach(0.5, seconds=30), **given).status is Status.FAIL
    assert one(approach(0.5, seconds=30), **{**given, "maximum": 30.0}).status is Status.INCONCLUSIVE


def test_a_window_between_two_scans_tests_nothing() -> None:
    verdict = one(approach(0.5), **{**LANDED, "arguments": {"final": 0.0, "from": 1.01, "to": 1.02}})
    assert verdict.status is Status.UNTESTED
    assert verdict.reason == "No scan falls into the window from 1.01 s to 1.02 s."


@pytest.mark.parametrize("expect_fail", [False, True])
def test_overshoot_of_a_signal_without_a_way_to_go_is_untested(expect_fail: bool) -> None:
    verdict = one(trace([0.0, 1.0, 0.0]), **OVERSHOOT, expect_fail=expect_fail)
    assert verdict.status is Status.UNTESTED
    assert verdict.reason.startswith(
        "crane.distance starts at its final value, so there is no motion towards it to measure."
    )


def test_window_bounds_are_closed_and_counted_in_ticks() -> None:
    run = trace([0.0, 5.0, 0.0, 7.0, 0.0], scan=100_000_000)
    given = {"metric": "peak", "maximum": 1.0, "unit": "m"}
    assert one(run, **given, arguments={"from": 0.1, "to": 0.2}).value == 5.0
    assert one(run, **given, arguments={"from": 0.2, "to": 0.3}).value == 7.0


def test_times_count_from_the_start_of_the_window() -> None:
    run = approach(0.2)
    whole = one(run).value
    late = one(run, arguments={"final": 0.0, "band": 0.5, "from": 10.0})
    assert whole is not None
    assert late.value == pytest.approx(whole - 10.0)
    assert late.band is not None
    assert (late.band.start, late.band.end) == (45.0, 60.0)


def test_overshoot_draws_its_limit_on_the_far_side() -> None:
    verdict = one(trace([25.0, 3.0, -2.0, 0.0]), **OVERSHOOT)
    assert verdict.value == 2.0
    assert verdict.band == Band(signal="crane.distance", low=-1.0, high=None, start=0.0, end=0.15)
    assert verdict.violation == (0.1, 0.1)


@pytest.mark.parametrize(
    ("metric", "bounds", "band"),
    [
        ("peak", {"maximum": 2.0}, (-2.0, 2.0, 0.0)),
        ("maximum", {"maximum": 2.0}, (None, 2.0, 0.0)),
        ("minimum", {"minimum": -2.0}, (-2.0, None, 0.0)),
        ("final_value", {"minimum": -2.0, "maximum": 2.0}, (-2.0, 2.0, 0.1)),
        ("final_error", {"maximum": 2.0}, (-1.0, 3.0, 0.1)),
        ("largest_error", {"maximum": 2.0}, (-1.0, 3.0, 0.0)),
    ],
)
def test_a_bound_on_the_signal_itself_is_drawn_and_its_violation_found(metric, bounds, band) -> None:
    arguments = {"final": 1.0} if metric.endswith("error") else {}
    given = {"metric": metric, "arguments": arguments, "unit": "m", "maximum": None, **bounds}
    inside = one(trace([0.5, -0.5, 0.5]), **given)
    low, high, start = band
    assert inside.band == Band(signal="crane.distance", low=low, high=high, start=start, end=0.1)
    assert inside.status is Status.PASS
    outside = one(trace([0.5, 0.5, -9.0 if high is None else 9.0]), **given)
    assert outside.status is Status.FAIL
    assert outside.violation == (0.1, 0.1)


def test_both_bounds_are_named() -> None:
    verdict = one(trace([1.0, 1.0]), metric="mean", arguments={}, minimum=2.0, maximum=3.5, unit="m")
    assert verdict.reason == "The mean of crane.distance is 1 m; 2 to 3.5 m is required."


def test_a_signal_that_the_trace_lacks_is_refused_with_the_nearest() -> None:
    with pytest.raises(InputFault) as caught:
        judge(trace([0.0]), [requirement(), requirement(id="CR-2", signal="crane.distanz")])
    assert str(caught.value) == (
        "error[JDG101]: CR-2 asks for `crane.distanz`, which the trace does not have\n"
        "  hint: did you mean `crane.distance`?"
    )


def test_the_gravest_verdict_counts() -> None:
    assert worst([Status.PASS, Status.UNTESTED, Status.INCONCLUSIVE]) is Status.INCONCLUSIVE
    assert worst([Status.FAIL, Status.FAULT]) is Status.FAULT
    assert worst([]) is Status.UNTESTED
