"""Relays and proportional controllers on linear plants: limit cycles and ultimate gains in closed form."""

from math import atan, exp, log, pi, sqrt

import numpy as np
import pytest
from scipy.optimize import brentq

from fcl_sim.plant.linear import first_order, transfer_function
from tests.loop.block_loops import node
from tests.loop.diagrams import timing
from tests.loop.linear_loops import simulated

GAIN, TAU, DELAY = 2.0, 10.0, 3.0


def cycle(trace):
    """Period and amplitude of what is left of an oscillation in its second half."""
    time, y = trace.time, trace["plant.y"]
    part = time > time[-1] / 2
    time, y = time[part], y[part]
    up = np.flatnonzero((y[:-1] < 0.0) & (y[1:] >= 0.0))
    crossings = time[up] - y[up] * (time[up + 1] - time[up]) / (y[up + 1] - y[up])
    return np.diff(crossings).mean(), (y.max() - y.min()) / 2


def relay(width):
    """A relay between -1 and 1 against the output, with a hysteresis of this half width."""
    levels = {"lower": -width, "upper": width, "off": -1.0, "on": 1.0, "initial": True}
    return node("u", "hysteresis_relay", {"input": "-plant.y"}, **levels)


@pytest.mark.parametrize("width", [0.0, 0.1])
def test_a_relay_on_first_order_and_dead_time_swings_as_its_closed_form_says(width):
    fading = exp(-DELAY / TAU)
    amplitude = GAIN * (1 - fading) + width * fading
    period = 2 * (DELAY + TAU * log((GAIN + amplitude) / (GAIN - width)))
    trace = simulated(first_order(GAIN, TAU), timing(1.0, 100.0), relay(width), delay=DELAY)
    measured = cycle(trace)
    # A relay that is looked at every millisecond is late by half of one on the mean, twice in a period.
    assert measured[0] == pytest.approx(period, abs=0.004)
    assert measured[1] == pytest.approx(amplitude, abs=0.0003)


@pytest.mark.parametrize("width", [0.0, 0.1])
def test_a_relay_on_an_integrator_and_dead_time_swings_in_a_triangle(width):
    slope = 0.5
    period, amplitude = 4 * (DELAY + width / slope), slope * DELAY + width
    plant = transfer_function([slope], [1.0, 0.0])
    measured = cycle(simulated(plant, timing(1.0, 100.0), relay(width), delay=DELAY))
    assert measured[0] == pytest.approx(period, abs=0.006)
    assert measured[1] == pytest.approx(amplitude, abs=0.001)


def growth(plant, gain, delay, scan):
    """By what factor a swing under a proportional controller grows in a period, and the period."""
    kick = node("kick", "step", before=1.0, after=0.0, at="0.5 s")
    control = node("u", "sum", {"kick": "kick", "y": "plant.y"}, kick=1.0, y=-gain)
    trace = simulated(plant, timing(scan, 60.0), kick, control, delay=delay)
    y = trace["plant.y"]
    turns = np.flatnonzero((y[1:-1] > y[:-2]) & (y[1:-1] >= y[2:])) + 1
    last = turns[-4:]
    return (y[last[3]] / y[last[0]]) ** (1 / 3), (trace.time[last[3]] - trace.time[last[0]]) / 3


def of_first_order():
    """First order and dead time: ultimate gain where -180 degrees are reached, and the period there."""
    frequency = brentq(lambda w: w * DELAY + atan(w * TAU) - pi, 0.1, 1.0)
    return sqrt(1 + (frequency * TAU) ** 2) / GAIN, 2 * pi / frequency


def test_the_ultimate_gain_of_first_order_and_dead_time_is_the_published_one():
    gain, period = of_first_order()
    assert (gain, 2 * pi / period) == pytest.approx((2.94508, 0.58047), abs=1e-5)


CASES = {
    "first order and dead time": (first_order(GAIN, TAU), *of_first_order(), DELAY, 10.0),
    # Routh: s^3 + a s^2 + b s + c (1 + K) is at its limit where a b = c (1 + K), and swings at sqrt(b).
    "third order": (
        transfer_function([4.228], [1.0, 2.14, 9.276, 4.228]),
        2.14 * 9.276 / 4.228 - 1,
        2 * pi / sqrt(9.276),
        0.0,
        2.0,
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_a_swing_neither_grows_nor_fades_at_the_ultimate_gain(case):
    plant, gain, period, delay, scan = CASES[case]
    below, above = (growth(plant, part * gain, delay, scan) for part in (0.99, 1.01))
    assert below[0] < 1.0 < above[0]
    assert (below[1] + above[1]) / 2 == pytest.approx(period, rel=5e-3)
