"""Metrics of effort and oscillation equal their closed forms, and are right at their edges."""

import math

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fcl_sim.judge.effort import (
    energy,
    peak_rate,
    reversals,
    saturation_time,
    time_undefined,
    total_variation,
)
from fcl_sim.judge.extent import fraction_in_range
from fcl_sim.judge.integral import itse
from fcl_sim.judge.oscillation import (
    oscillation_amplitude,
    oscillation_decay,
    oscillation_period,
    residual_sway,
)
from fcl_sim.judge.response import settling_time, transient_time, undershoot

FINE = np.linspace(0.0, 40.0, 400_001)
ABOUT = {"final": 0.0, "least": 0.0}


@pytest.mark.parametrize(("start", "final"), [(0.0, 1.0), (25.0, 0.0), (-3.0, 4.0)])
def test_a_first_order_response_has_its_closed_forms(start, final):
    tau, way = 2.0, abs(final - start)
    values = final + (start - final) * np.exp(-FINE / tau)
    assert itse(FINE, values, final=final) == pytest.approx(way**2 * tau**2 / 4, rel=1e-6)
    assert transient_time(FINE, values, final=final, part=0.02) == pytest.approx(tau * math.log(50), abs=1e-6)
    assert undershoot(FINE, values, final=final) == 0.0
    assert total_variation(FINE, values) == pytest.approx(way, rel=1e-6)
    assert peak_rate(FINE, values) == pytest.approx(way / tau, rel=1e-4)
    assert reversals(FINE, values, least=0.0) == 0
    assert oscillation_amplitude(FINE, values, **ABOUT | {"final": final}) == 0.0
    assert math.isnan(oscillation_period(FINE, values, **ABOUT | {"final": final}))
    assert math.isnan(oscillation_decay(FINE, values, **ABOUT | {"final": final}))
    assert residual_sway(FINE, values) == pytest.approx(way / 2)


@pytest.mark.parametrize("final", [0.0, 5.0])
@pytest.mark.parametrize("damping", [0.05, 0.2])
def test_a_second_order_response_has_its_period_and_decay(damping, final):
    damped = math.sqrt(1 - damping**2)
    values = final + 3.0 * np.exp(-damping * FINE) * np.cos(damped * FINE)
    given_ = {"final": final, "least": 0.0}
    period = 2 * math.pi / damped
    assert oscillation_period(FINE, values, **given_) == pytest.approx(period, abs=1e-6)
    assert oscillation_decay(FINE, values, **given_) == pytest.approx(math.exp(-damping * period), abs=1e-6)
    first = (math.pi - math.atan(damping / damped)) / damped
    expected = abs(3.0 * math.exp(-damping * first) * math.cos(damped * first))
    assert oscillation_amplitude(FINE, values, **given_) == pytest.approx(expected, abs=1e-6)


def test_a_sine_has_its_closed_forms():
    values = 2.0 * np.sin(math.pi * FINE)
    assert oscillation_amplitude(FINE, values, **ABOUT) == pytest.approx(2.0, abs=1e-6)
    assert oscillation_decay(FINE, values, **ABOUT) == pytest.approx(1.0, abs=1e-6)
    assert residual_sway(FINE, values) == pytest.approx(2.0, abs=1e-6)
    assert reversals(FINE, values, least=0.1) == 40
    assert total_variation(FINE, values) == pytest.approx(20 * 8.0, rel=1e-6)
    assert energy(FINE, values, recovered=0.0) == pytest.approx(20 * 4 / math.pi, rel=1e-6)
    assert energy(FINE, values, recovered=1.0) == pytest.approx(0.0, abs=1e-6)
    assert energy(FINE, values, recovered=-1.0) == pytest.approx(40 * 4 / math.pi, rel=1e-6)
    assert fraction_in_range(FINE, values, high=0.0) == pytest.approx(0.5, abs=1e-3)
    assert saturation_time(FINE, values, low=-1.0, high=1.0) == pytest.approx(40 * 2 / 3, abs=1e-2)


def test_a_non_minimum_phase_response_goes_behind_its_start():
    """1 - (1 + 2t) exp(-t) of (1 - s) / (1 + s)²: least where its derivative (2t - 1) exp(-t) is zero."""
    values = 1 - (1 + 2 * FINE) * np.exp(-FINE)
    assert undershoot(FINE, values, final=1.0) == pytest.approx(2 * math.exp(-0.5) - 1, abs=1e-6)
    assert undershoot(FINE, 5 - values, final=4.0) == pytest.approx(2 * math.exp(-0.5) - 1, abs=1e-6)
    assert undershoot(FINE, values, final=1.0, initial=-1.0) == 0.0
    assert math.isnan(undershoot(FINE, values, final=0.0))


def test_noise_within_the_dead_band_neither_crosses_nor_turns():
    values = 2.0 * np.sin(math.pi * FINE) + 0.01 * np.sin(40_000 * FINE)
    assert oscillation_period(FINE, values, final=0.0, least=0.1) == pytest.approx(2.0, abs=1e-3)
    assert reversals(FINE, values, least=0.1) == 40
    assert reversals(FINE, values, least=0.0) > 1000


def test_a_transient_is_measured_by_its_largest_error_wherever_it_comes():
    time, values = np.arange(5.0), np.array([0.0, 4.0, 0.0, 0.0, 0.0])
    assert transient_time(time, values, final=0.0, part=0.25) == 1.75
    assert transient_time(time, 0 * values, final=0.0, part=0.25) == 0.0
    assert transient_time(time, values[::-1] + time, final=0.0, part=0.25) == math.inf


def test_the_last_sample_has_no_duration_and_a_lone_one_decides_alone():
    time, values = np.array([0.0, 1.0, 3.0]), np.array([1.0, 0.0, 1.0])
    assert saturation_time(time, values, high=1.0) == 1.0
    assert time_undefined(time, values) == 1.0
    assert fraction_in_range(time, values, low=1.0) == pytest.approx(1 / 3)
    assert fraction_in_range(time[:1], values[:1], low=1.0) == 1.0
    assert energy(time, values, recovered=0.0) == 1.0
    assert peak_rate(time[:1], values[:1]) == 0.0


@st.composite
def signals(draw):
    size = draw(st.integers(1, 20))
    steps = draw(arrays(np.float64, size, elements=st.floats(0.01, 10.0)))
    return np.cumsum(steps) - steps[0], draw(arrays(np.float64, size, elements=st.integers(-3, 3)))


@given(signals(), st.integers(-2, 2))
def test_crossings_and_turns_are_those_of_the_mirrored_and_the_reversed_signal(signal, final):
    time, values = signal
    about = {"final": float(final), "least": 0.0}
    mirrored = {"final": -float(final), "least": 0.0}
    assert oscillation_amplitude(time, values, **about) == oscillation_amplitude(time, -values, **mirrored)
    assert reversals(time, values, least=1.0) <= reversals(time, values, least=0.0)
    assert reversals(time, values, least=0.0) == reversals(time, -values, least=0.0)
    assert reversals(time, values, least=0.0) == reversals(time, values[::-1], least=0.0)


@given(signals())
def test_the_turns_are_the_changes_of_sign_of_the_steps(signal):
    time, values = signal
    steps = np.diff(values)
    steps = steps[steps != 0]
    assert reversals(time, values, least=0.0) == np.count_nonzero(steps[1:] * steps[:-1] < 0)


@given(signals(), st.integers(-3, 3))
def test_inside_and_outside_make_the_whole(signal, level):
    time, values = signal
    inside = fraction_in_range(time, values, high=float(level))
    outside = fraction_in_range(time, values, low=math.nextafter(float(level), math.inf))
    assert inside + outside == pytest.approx(1.0)
    span = float(time[-1])
    assert saturation_time(time, values, low=float(level)) == pytest.approx(inside * span)


@given(signals(), st.floats(0.01, 1.0))
def test_a_transient_ends_where_a_band_of_that_part_is_settled(signal, part):
    time, values = signal
    band = part * float(np.max(np.abs(values)))
    assert transient_time(time, values, final=0.0, part=part) == settling_time(
        time, values, final=0.0, band=band
    )


@pytest.mark.parametrize("zero", [0.5, 1.0, 3.0])
def test_python_control_finds_the_same_undershoot(zero):
    system = control.tf([-zero, 1.0], [1.0, 2.0, 1.0])
    time = FINE[::100]
    _, values = control.step_response(system, time)
    theirs = control.step_info(values, T=time, yfinal=1.0)["Undershoot"]
    assert undershoot(time, values, final=1.0) == pytest.approx(theirs / 100, abs=1e-9)
