"""Metrics equal their closed forms, are right where others divide by zero, and say what they compute."""

import cmath
import itertools
import math

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.optimize import brentq

from fcl_sim.judge.extent import (
    final_error,
    final_value,
    largest_error,
    maximum,
    mean,
    minimum,
    peak,
    steady_state_error,
)
from fcl_sim.judge.integral import iae, ise, itae, itse
from fcl_sim.judge.metric import Bound, Kind
from fcl_sim.judge.metrics import METRICS
from fcl_sim.judge.response import overshoot, rise_time, settling_time
from fcl_sim.units import parse_unit

TAU = 2.0
FIRST_ORDER = np.linspace(0.0, 40.0, 40_001)


def first_order(final: float, start: float) -> np.ndarray:
    return final + (start - final) * np.exp(-FIRST_ORDER / TAU)


@pytest.mark.parametrize(("start", "final"), [(0.0, 1.0), (25.0, 0.0), (-3.0, 4.0), (1.0, 0.999)])
def test_a_first_order_response_has_its_closed_forms(start: float, final: float) -> None:
    values, way = first_order(final, start), abs(final - start)
    assert settling_time(FIRST_ORDER, values, final=final, band=0.02 * way) == pytest.approx(
        TAU * math.log(50), abs=1e-6
    )
    assert rise_time(FIRST_ORDER, values, final=final, low=0.1, high=0.9) == pytest.approx(
        TAU * math.log(9), abs=1e-6
    )
    assert overshoot(FIRST_ORDER, values, final=final) == pytest.approx(0.0, abs=1e-12 * max(1, abs(final)))
    assert iae(FIRST_ORDER, values, final=final) == pytest.approx(way * TAU, rel=1e-7)
    assert ise(FIRST_ORDER, values, final=final) == pytest.approx(way**2 * TAU / 2, rel=1e-6)
    assert itae(FIRST_ORDER, values, final=final) == pytest.approx(way * TAU**2, rel=1e-6)


@pytest.mark.parametrize("damping", [0.1, 0.3, 0.7])
def test_a_second_order_response_has_its_closed_forms(damping: float) -> None:
    time = np.linspace(0.0, 100.0, 200_001)
    damped = math.sqrt(1 - damping**2)
    phase = math.acos(damping)
    values = 1 - np.exp(-damping * time) / damped * np.sin(damped * time + phase)
    expected = math.exp(-math.pi * damping / damped)
    assert overshoot(time, values, final=1.0) == pytest.approx(expected, abs=1e-6)
    assert maximum(time, values) == pytest.approx(1 + expected, abs=1e-6)
    outside = time[np.abs(values - 1) > 0.05][-1]
    assert 0 < settling_time(time, values, final=1.0, band=0.05) - outside < time[1]


def pieces(damping: float, power: int) -> list[complex]:
    """Return the integrals of t**power exp(s t + i phase) from zero to zero of a second-order error.

    The first piece begins at 0; s = -damping + i sqrt(1 - damping²), the natural frequency is 1, and the
    error is the imaginary part over sqrt(1 - damping²).
    """
    damped, phase = math.sqrt(1 - damping**2), math.acos(damping)
    s = complex(-damping, damped)

    def primitive(t: float) -> complex:
        return cmath.exp(s * t + 1j * phase) * (1 / s if power == 0 else t / s - 1 / s**2)

    zeros = [0.0, *((k * math.pi - phase) / damped for k in range(1, 200))]
    return [primitive(end) - primitive(start) for start, end in itertools.pairwise(zeros)]


@pytest.mark.parametrize("damping", [0.2, 0.5, 0.8])
def test_the_whole_of_a_second_order_response_has_its_closed_forms(damping: float) -> None:
    """With unit natural frequency; the integrals of the squares are by Parseval, the others zero by zero."""
    time = np.linspace(0.0, 100.0, 200_001)
    damped, phase = math.sqrt(1 - damping**2), math.acos(damping)

    def error(t):
        return np.exp(-damping * t) / damped * np.sin(damped * t + phase)

    values = 1 - error(time)
    square = 1 / (4 * damping**2) - (cmath.exp(2j * phase) / (2 * damping - 2j * damped) ** 2).real
    assert iae(time, values, final=1.0) == pytest.approx(
        sum(abs(each.imag) for each in pieces(damping, 0)) / damped, abs=1e-6
    )
    assert itae(time, values, final=1.0) == pytest.approx(
        sum(abs(each.imag) for each in pieces(damping, 1)) / damped, abs=1e-6
    )
    assert ise(time, values, final=1.0) == pytest.approx((1 + 4 * damping**2) / (4 * damping), abs=1e-6)
    assert itse(time, values, final=1.0) == pytest.approx(square / (2 * damped**2), abs=1e-6)
    peak_at = math.pi / damped
    low, high = (brentq(lambda t, part=part: 1 - error(t) - part, 0.0, peak_at) for part in (0.1, 0.9))
    assert rise_time(time, values, final=1.0, low=0.1, high=0.9) == pytest.approx(high - low, abs=1e-6)
    band = 0.05
    ends = [k * peak_at for k in range(200)]  # the extremes of the error: between two, it is monotonic
    last = max(k for k, each in enumerate(ends) if abs(error(each)) > band)
    edge = math.copysign(band, error(ends[last]))
    settled = brentq(lambda t: error(t) - edge, ends[last], ends[last + 1])
    assert settling_time(time, values, final=1.0, band=band) == pytest.approx(settled, abs=1e-6)
    assert settling_time(time, values, final=1.0, part=band) == pytest.approx(settled, abs=1e-6)


def test_a_band_may_be_a_part_of_the_way_and_of_both_the_narrower_counts() -> None:
    time = np.linspace(0.0, 40.0, 40_001)
    values = 20.0 - 4.0 * np.exp(-time)
    assert settling_time(time, values, final=20.0, part=0.02) == pytest.approx(math.log(50), abs=1e-6)
    assert settling_time(time, values, final=20.0, part=0.02, initial=10.0) == pytest.approx(
        math.log(4 / 0.2), abs=1e-6
    )
    assert settling_time(time, values, final=20.0, part=0.5, band=0.04) == pytest.approx(
        math.log(100), abs=1e-6
    )
    assert math.isnan(settling_time(time, values, final=16.0, part=0.02))
    assert settling_time(time, 0 * time, final=0.0, part=0.02, band=0.1) == 0.0


@pytest.mark.parametrize("damping", [0.2, 0.5, 1.5])
def test_python_control_finds_the_same_where_it_is_right(damping: float) -> None:
    system = control.tf([1.0], [1.0, 2 * damping, 1.0])
    time = np.linspace(0.0, 80.0, 80_001)
    _, values = control.step_response(system, time)
    theirs = control.step_info(values, T=time, yfinal=1.0)
    scan = time[1]
    assert settling_time(time, values, final=1.0, band=0.02) == pytest.approx(
        theirs["SettlingTime"], abs=scan
    )
    assert rise_time(time, values, final=1.0, low=0.1, high=0.9) == pytest.approx(
        theirs["RiseTime"], abs=2 * scan
    )
    assert overshoot(time, values, final=1.0) == pytest.approx(theirs["Overshoot"] / 100, abs=1e-9)
    assert peak(time, values) == pytest.approx(theirs["Peak"])


def test_regulation_to_zero_is_measured_in_the_unit_of_the_signal() -> None:
    time = np.linspace(0.0, 60.0, 6_001)
    values = 25 * np.exp(-time / 4) * np.cos(time)
    assert overshoot(time, values, final=0.0) == pytest.approx(-float(values.min()))
    assert settling_time(time, values, final=0.0, band=0.5) < 4 * math.log(25 / 0.5)


def test_a_crossing_is_interpolated_between_two_scans() -> None:
    time, values = np.array([0.0, 1.0, 2.0, 3.0]), np.array([4.0, 2.0, 0.0, 0.0])
    assert settling_time(time, values, final=0.0, band=0.5) == 1.75
    assert rise_time(time, values, final=0.0, low=0.25, high=0.75) == 1.0


def test_the_edge_of_the_band_belongs_to_it() -> None:
    time = np.array([0.0, 1.0, 2.0])
    assert settling_time(time, np.array([0.5, -0.5, 0.5]), final=0.0, band=0.5) == 0.0


def test_what_never_settles_or_rises_takes_forever() -> None:
    time = np.linspace(0.0, 10.0, 101)
    assert settling_time(time, np.sin(time), final=0.0, band=0.1) == math.inf
    assert rise_time(time, 0.5 * time / 10, final=1.0, low=0.1, high=0.9) == math.inf
    assert rise_time(time, 0.0 * time, final=1.0, low=0.1, high=0.9) == math.inf


def test_a_signal_that_starts_at_its_final_value_has_no_rise_and_no_overshoot() -> None:
    time = np.linspace(0.0, 10.0, 101)
    assert math.isnan(rise_time(time, np.sin(time), final=0.0, low=0.1, high=0.9))
    assert math.isnan(overshoot(time, np.sin(time), final=0.0))
    assert overshoot(time, np.sin(time), final=0.0, initial=-1.0) == pytest.approx(1.0, abs=1e-3)


def test_an_error_that_changes_sign_is_integrated_exactly() -> None:
    time, values = np.array([0.0, 2.0, 4.0]), np.array([1.0, -1.0, 1.0])
    assert iae(time, values, final=0.0) == pytest.approx(2.0)
    assert ise(time, values, final=0.0) == pytest.approx(4 / 3)
    assert itae(time, values, final=0.0) == pytest.approx(4.0)


finite = st.floats(-1e6, 1e6)


@st.composite
def signals(draw: st.DrawFn) -> tuple[np.ndarray, np.ndarray]:
    size = draw(st.integers(1, 20))
    steps = draw(arrays(np.float64, size, elements=st.floats(0.01, 10.0)))
    return np.cumsum(steps) - steps[0], draw(arrays(np.float64, size, elements=finite))


@given(signals(), finite, st.floats(0.0, 1e6))
def test_after_settling_every_sample_is_in_the_band(signal, final, band) -> None:
    time, values = signal
    settled = settling_time(time, values, final=final, band=band)
    inside = np.abs(values - final) <= band
    if math.isinf(settled):
        assert not inside[-1]
    else:
        assert inside[time > settled].all()
        assert settled == 0.0 or not inside[time < settled][-1]


@given(signals(), finite, finite)
def test_mirroring_the_signal_changes_no_metric_of_distance(signal, final, shift) -> None:
    time, values = signal
    for name in ("settling_time", "overshoot", "final_error", "largest_error", "iae", "ise", "itae"):
        given_ = {"final": final, "band": abs(shift)}
        mirrored = {"final": -final, "band": abs(shift)}
        metric = METRICS[name]
        here, there = metric.measure(time, values, given_), metric.measure(time, -values, mirrored)
        assert here == there or (math.isnan(here) and math.isnan(there))


@given(signals(), finite)
def test_metrics_of_extent_order_themselves(signal, final) -> None:
    time, values = signal
    slack = 1e-9 * (1 + peak(time, values))
    assert minimum(time, values) - slack <= mean(time, values) <= maximum(time, values) + slack
    assert peak(time, values) == max(maximum(time, values), -minimum(time, values))
    assert final_error(time, values, final=final) <= largest_error(time, values, final=final)
    assert steady_state_error(time, values, final=final) <= largest_error(time, values, final=final) + slack
    assert final_value(time, values) == values[-1]


def test_every_metric_says_what_it_is() -> None:
    for name, metric in METRICS.items():
        assert metric.name == name
        assert metric.words
        assert len(metric.definition) > 10
        assert all(each.meaning for each in metric.arguments)
        assert metric.never or name not in {"settling_time", "rise_time"}


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("settling_time", "s"),
        ("overshoot", "m"),
        ("iae", "m s"),
        ("ise", "m2 s"),
        ("itae", "m s2"),
        ("mean", "m"),
    ],
)
def test_a_metric_has_the_unit_of_its_rule(name: str, unit: str) -> None:
    assert METRICS[name].unit.unit(parse_unit("m")).same_as(parse_unit(unit))


def test_every_metric_runs_on_one_sample() -> None:
    time, values = np.array([0.0]), np.array([2.0])
    given_ = {Kind.SIGNAL: 1.0, Kind.DIFFERENCE: 1.0, Kind.TIME: 0.0, Kind.NUMBER: 0.5}
    for metric in METRICS.values():
        arguments = {each.name: given_[each.kind] for each in metric.arguments if each.required}
        metric.measure(time, values, arguments)


def test_nan_keeps_no_bound_not_even_none():
    assert Bound(minimum=1.0, maximum=2.0).holds(1.0)
    assert Bound(minimum=1.0, maximum=2.0).holds(2.0)
    assert not Bound(minimum=1.0, maximum=2.0).holds(2.1)
    assert not Bound(minimum=1.0).holds(0.9)
    assert not Bound().holds(math.nan)
