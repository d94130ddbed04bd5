"""Laws of references: what thinning leaves out, what a tube lets through, and what it never does."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from fcl_sim.judge.baseline import DIGITS, Baseline, Figure, MetricReference, SignalReference
from fcl_sim.judge.compare import compare
from fcl_sim.judge.thin import line_at, rounded, thin
from fcl_sim.judge.tube import tube
from fcl_sim.judge.verdict import Requirement, Status, Verdict
from fcl_sim.loop.trace import Fault, Trace

SCAN = 50_000_000
VALUES = st.floats(-1e3, 1e3).map(lambda each: round(each, 4))
SIGNALS = st.lists(VALUES, min_size=1, max_size=60).map(np.array)
TOLERANCES = st.sampled_from([0.0, 1e-3, 0.1, 5.0, 100.0])


def ticks_of(values):
    return np.arange(len(values), dtype=np.int64) * SCAN


def reference(values, *, thinned=0.0, **tolerances):
    ticks, kept = thin(ticks_of(values), values, thinned)
    settings = {"absolute": 0.0} | tolerances
    return SignalReference(name="x", unit="m", ticks=ticks, values=kept, thinned=thinned, **settings)


def trace_of(values, ticks=None, *, unit="m", fault=None):
    return Trace(
        ticks=ticks_of(values) if ticks is None else ticks,
        names=("x",),
        units={"x": unit},
        values=np.asarray(values, dtype=np.float64).reshape(-1, 1),
        fault=fault,
    )


def baseline(*signals, metrics=()):
    return Baseline(
        scenario="s", variant="base", date="2026-01-31", reason="r", signals=signals, metrics=metrics
    )


def beside(values, made, **given):
    (change,) = compare(trace_of(values, **given), (), baseline(made)).signals
    return change


@given(SIGNALS, TOLERANCES)
def test_every_sample_that_is_left_out_is_within_the_tolerance_of_the_line(values, tolerance):
    ticks, kept = thin(ticks_of(values), values, tolerance)
    away = np.abs(line_at(ticks, kept, ticks_of(values)) - values)
    assert np.all(away <= tolerance + 1e-12 * np.abs(values).max(initial=1.0))
    assert (ticks[0], ticks[-1]) == (0, ticks_of(values)[-1])


@given(st.integers(2, 300), VALUES, st.floats(-5.0, 5.0), st.sampled_from([1e-3, 0.1, 5.0]))
def test_of_a_straight_line_the_ends_are_left(count, start, slope, tolerance):
    values = start + slope * np.arange(count)
    ticks, _ = thin(ticks_of(values), values, tolerance)
    assert ticks.tolist() == [0, (count - 1) * SCAN]


def test_a_step_keeps_both_of_its_sides():
    values = np.repeat([0.0, 1.0], 20)
    ticks, kept = thin(ticks_of(values), values, 0.01)
    assert (ticks // SCAN).tolist() == [0, 19, 20, 39]
    assert kept.tolist() == [0.0, 0.0, 1.0, 1.0]


@given(SIGNALS, st.sampled_from([1e-6, 1e-3, 0.1, 5.0, 1e4]))
def test_rounding_stays_within_its_error_and_is_done_once(values, error):
    near = rounded(values, error)
    assert np.all(np.abs(near - values) <= error)
    assert np.array_equal(rounded(near, error), near)


@given(SIGNALS, TOLERANCES, st.integers(0, 3), st.integers(0, 3))
def test_a_run_keeps_the_baseline_that_was_made_of_it(values, thinned, leading, lagging):
    made = reference(values, thinned=thinned, leading=leading * SCAN, lagging=lagging * SCAN)
    assert beside(values, made).status is Status.PASS


@given(SIGNALS, TOLERANCES, st.sampled_from([0.0, 0.1, 20.0]), st.data())
def test_one_sample_beyond_the_tolerances_is_always_found_at_its_scan(values, thinned, absolute, data):
    made = reference(values, thinned=thinned, absolute=absolute, relative=0.01)
    where = data.draw(st.integers(0, len(values) - 1))
    sign = data.draw(st.sampled_from([-1.0, 1.0]))
    allowed = 2.0 * thinned + absolute + 0.01 * (abs(values[where]) + thinned)
    moved = values.copy()
    moved[where] += sign * (allowed + 0.001)
    found = beside(moved, made)
    assert (found.status, found.time) == (Status.FAIL, where * SCAN / 1e9)
    assert not found.low <= found.value <= found.high


@given(SIGNALS, TOLERANCES, st.sampled_from([0.1, 20.0]), st.data())
def test_what_stays_within_the_tolerance_is_no_alarm(values, thinned, absolute, data):
    made = reference(values, thinned=thinned, absolute=absolute)
    noise = data.draw(st.lists(st.floats(-1.0, 1.0), min_size=len(values), max_size=len(values)))
    assert beside(values + absolute * np.array(noise), made).status is Status.PASS


@given(SIGNALS.filter(lambda each: len(each) > 8), st.integers(-4, 4), st.integers(0, 4), st.integers(0, 4))
def test_a_run_that_is_early_or_late_by_no_more_than_is_allowed_is_no_alarm(values, shift, leading, lagging):
    """`shift` scans late; what is not known of it holds."""
    assume(-leading <= shift <= lagging)
    made = reference(values, leading=leading * SCAN, lagging=lagging * SCAN)
    moved = values[np.clip(np.arange(len(values)) - shift, 0, len(values) - 1)]
    assert beside(moved, made).status is Status.PASS


@given(st.integers(1, 6), st.integers(0, 6), st.booleans(), st.sampled_from([0.3, 1.0, 7.0]))
def test_a_ramp_that_is_shifted_by_more_than_is_allowed_is_found(beyond, allowed, early, slope):
    ramp = slope * np.arange(60.0)
    shift = (allowed + beyond) * (-1 if early else 1)
    moved = slope * (np.arange(60.0) - shift)
    tolerances = {"leading" if early else "lagging": allowed * SCAN, "absolute": 0.9 * slope * beyond}
    other = {"lagging" if early else "leading": 50 * SCAN}
    assert beside(moved, reference(ramp, **tolerances)).status is Status.FAIL
    assert beside(moved, reference(ramp, **tolerances, **other)).status is Status.FAIL


@given(
    SIGNALS, st.integers(0, 5), st.integers(0, 5), st.lists(st.integers(0, 60 * SCAN), min_size=1, max_size=9)
)
def test_the_tube_is_that_of_a_fine_search(values, leading, lagging, times):
    made = reference(values, absolute=0.5, relative=0.1, leading=leading * SCAN, lagging=lagging * SCAN)
    at = np.array(sorted(times), dtype=np.int64)
    low, high = tube(made, at)
    for index, time in enumerate(at.tolist()):
        vertices = [
            each for each in made.ticks.tolist() if time - made.lagging <= each <= time + made.leading
        ]
        looked = np.array([time - made.lagging, time + made.leading, *vertices])
        line = line_at(made.ticks, made.values, looked)
        assert low[index] == min(line) - 0.5 - 0.1 * abs(min(line))
        assert high[index] == max(line) + 0.5 + 0.1 * abs(max(line))


def test_nan_is_outside_of_every_tube():
    values = np.zeros(5)
    moved = np.array([0.0, 0.0, np.nan, 0.0, 0.0])
    assert beside(moved, reference(values, absolute=1e300)).time == 0.1


def test_a_run_of_another_length_is_told():
    made = reference(np.zeros(5), absolute=1.0)
    short, long = beside(np.zeros(3), made), beside(np.zeros(9), made)
    assert (short.status, short.reason) == (Status.FAIL, "the run ends at 0.1 s, its reference at 0.2 s")
    assert (long.status, long.reason) == (Status.NO_BASELINE, "the reference ends at 0.2 s")


def test_a_reference_is_compared_in_the_unit_of_the_run():
    made = reference(np.arange(4.0), absolute=0.001)
    assert beside(1000.0 * np.arange(4.0), made, unit="mm").status is Status.PASS
    found = beside(1000.0 * np.arange(4.0) + 2.0, made, unit="mm")
    assert (found.status, found.unit) == (Status.FAIL, "mm")
    assert found.high == pytest.approx(1.0)
    assert beside(np.arange(4.0), made, unit="s").reason == "the reference is in m, the run in s"


def test_a_run_that_broke_down_is_a_fault_whatever_it_was():
    made = baseline(reference(np.zeros(3)))
    broken = trace_of(np.zeros(3), fault=Fault(tick=2 * SCAN, signal="x", reason="is NaN"))
    assert compare(broken, (), made).status is Status.FAULT


def verdict(value, *, unit="s", measured=Status.PASS):
    asked = Requirement(id="R-1", text="", metric="settling_time", signal="x", maximum=9.0, unit=unit)
    return Verdict(
        requirement=asked, status=measured, measured=measured, value=value, definition="", reason=""
    )


def figure(value, **tolerances):
    made = Figure(value) if not isinstance(value, str) else Figure(None, value)
    return MetricReference(id="R-1", about="settling_time of x", figure=made, unit="s", **tolerances)


def changed(verdicts, *metrics):
    return compare(trace_of(np.zeros(1)), verdicts, baseline(metrics=metrics)).metrics


def test_a_margin_that_was_kept_in_degrees_celsius_is_the_same_in_kelvin():
    kept = replace(figure(8.0, absolute=0.5), unit="degC")
    for value, status in ((8.4, Status.PASS), (8.9, Status.FAIL)):
        (change,) = changed((verdict(value, unit="K"),), kept)
        assert (change.status, change.old.value, change.unit) == (status, 8.0, "K")


@given(st.floats(-1e6, 1e6), st.sampled_from([0.0, 0.5]), st.sampled_from([0.0, 0.1]), st.floats(-1.0, 1.0))
def test_a_figure_may_change_by_its_tolerances_and_no_more(old, absolute, relative, part):
    kept = float(f"{old:.{DIGITS}g}")
    made = figure(kept, absolute=absolute, relative=relative)
    (same,) = changed([verdict(old)], made)
    assert same.status is Status.PASS
    (within,) = changed([verdict(kept + part * made.allowed)], made)
    (beyond,) = changed([verdict(kept + 1.01 * made.allowed + 1e-6)], made)
    assert (within.status, beyond.status) == (Status.PASS, Status.FAIL)


@pytest.mark.parametrize(
    ("old", "new", "status"),
    [
        ("never", verdict(None), Status.PASS),
        ("never", verdict(3.0), Status.FAIL),
        (3.0, verdict(None), Status.FAIL),
        ("untested", verdict(None, measured=Status.UNTESTED), Status.PASS),
        ("never", verdict(None, measured=Status.UNTESTED), Status.FAIL),
    ],
)
def test_what_never_happens_is_no_number(old, new, status):
    (found,) = changed([new], figure(old))
    assert found.status is status


def test_a_requirement_that_is_not_asked_any_more_is_a_regression():
    (found,) = changed([], figure(3.0))
    assert (found.status, found.new) == (Status.FAIL, None)


def test_a_new_requirement_has_no_baseline_nor_has_another_one_under_an_old_id():
    (new,) = changed([verdict(3.0)])
    (other,) = changed([verdict(3.0)], replace(figure(3.0), about="peak of x"))
    assert new.status is other.status is Status.NO_BASELINE


def test_a_figure_is_compared_in_the_unit_of_its_requirement():
    (found,) = changed([verdict(3010.0, unit="ms")], figure(3.0, absolute=0.02))
    assert (found.status, found.old) == (Status.PASS, Figure(3000.0))


def test_a_signal_that_is_asked_for_and_not_kept_has_no_baseline():
    found = compare(trace_of(np.zeros(2)), (), baseline(), ("x",))
    assert (found.status, found.signals[0].reason) == (Status.NO_BASELINE, "the baseline does not have it")
