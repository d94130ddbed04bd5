"""Lags once more: by the solution of their differential equations, in complex numbers."""

from cmath import exp, sqrt
from itertools import pairwise

from tests.loop.block_bench import Case


def held_lag(lag, initial):
    def law(samples, times, cycle):
        a, y = exp(-cycle / lag).real, [initial]
        for u in samples["input"][:-1]:
            y.append(a * y[-1] + (1.0 - a) * u)
        return y

    return law


def varying_lag(samples, times, cycle):
    y = [0.0]
    for u, lag in zip(samples["input"], samples["time_constant"][1:], strict=False):
        a = exp(-cycle / lag).real if lag > 0 else 0.0
        y.append(a * y[-1] + (1.0 - a) * u)
    return y


def backward_lag(lag):
    def law(samples, times, cycle):
        y = [0.0]
        for u in samples["input"]:
            y.append((lag * y[-1] + cycle * u) / (lag + cycle))
        return y[1:]

    return law


def trapezoidal_lag(lag, initial):
    def law(samples, times, cycle):
        y = [initial]
        for before, now in pairwise([initial, *samples["input"]]):
            y.append(((2 * lag - cycle) * y[-1] + cycle * (now + before)) / (2 * lag + cycle))
        return y[1:]

    return law


def oscillator(frequency, damping, initial=0.0):
    """Superpose two modes; of a double root, of two that are all but one."""
    p = -damping * frequency + frequency * sqrt(damping**2 - 1 + (1e-10 if damping == 1 else 0))
    q = -2 * damping * frequency - p

    def law(samples, times, cycle):
        y, v, outputs = initial, 0.0, [initial]
        for u in samples["input"][:-1]:
            first = (v - q * (y - u)) / (p - q)
            second = (y - u) - first
            first, second = first * exp(p * cycle), second * exp(q * cycle)
            y, v = u + (first + second).real, (p * first + q * second).real
            outputs.append(y)
        return outputs

    return law


def lead_over_lag(lead, lag, initial):
    """Split into a gain and a lag of what remains."""

    def law(samples, times, cycle):
        lagged = held_lag(lag, initial)(samples, times, cycle)
        ratio = lead / lag
        return [ratio * u + (1.0 - ratio) * x for u, x in zip(samples["input"], lagged, strict=True)]

    return law


INPUT = {"input": "wave"}


def second_order(frequency, damping, tolerance=1e-12):
    return Case(
        block="second_order_lag",
        inputs=INPUT,
        parameters={"natural_frequency": f"{frequency} rad/s", "damping": damping, "initial": "50 cm"},
        law=oscillator(frequency, damping, 0.5),
        tolerance=tolerance,
    )


CASES = [
    Case(
        block="first_order_lag",
        inputs=INPUT,
        parameters={"time_constant": "300 ms", "initial": "50 cm"},
        law=held_lag(0.3, 0.5),
        tolerance=1e-13,
    ),
    Case(
        block="first_order_lag",
        inputs={"input": "-wave", "time_constant": "moment"},
        law=varying_lag,
        tolerance=1e-13,
    ),
    Case(
        block="first_order_lag",
        inputs=INPUT,
        parameters={"time_constant": "0 s", "initial": "1 m"},
        law=lambda samples, times, cycle: [1.0, *samples["input"][:-1]],
        tolerance=1e-15,
    ),
    Case(
        block="first_order_lag",
        inputs=INPUT,
        parameters={"time_constant": "300 ms", "method": "backward"},
        law=backward_lag(0.3),
        tolerance=1e-13,
    ),
    Case(
        block="first_order_lag",
        inputs={"input": "-wave"},
        parameters={"time_constant": "300 ms", "method": "trapezoidal", "initial": "1 m"},
        law=trapezoidal_lag(0.3, 1.0),
        tolerance=1e-13,
    ),
    second_order(4.0, 0.0),
    second_order(4.0, 0.2),
    second_order(300.0, 0.7),
    second_order(4.0, 1.0, tolerance=1e-4),
    second_order(4.0, 3.0),
    second_order(400.0, 60.0),
    Case(
        block="lead_lag",
        inputs=INPUT,
        parameters={"lead": "0.6 s", "lag": "200 ms", "initial": "50 cm"},
        law=lead_over_lag(0.6, 0.2, 0.5),
        tolerance=1e-13,
    ),
    Case(
        block="lead_lag",
        inputs={"input": "-wave"},
        parameters={"lead": "0 s", "lag": "200 ms"},
        law=lead_over_lag(0.0, 0.2, 0.0),
        tolerance=1e-13,
    ),
]
