"""Metrics of extent: how large a signal is, and how far from where it should be."""

import math
from collections.abc import Mapping

import numpy as np

from fcl_sim.judge.metric import Argument, Better, Bound, Kind, Limits, Metric, UnitRule, Window
from fcl_sim.judge.response import FINAL
from fcl_sim.loop.trace import Values


def peak(_time: Values, values: Values) -> float:
    """Return the largest magnitude.

    >>> peak(np.arange(3.0), np.array([1.0, -3.0, 2.0]))
    3.0
    """
    return float(np.max(np.abs(values)))


def maximum(_time: Values, values: Values) -> float:
    """Return the largest value.

    >>> maximum(np.arange(3.0), np.array([1.0, -3.0, 2.0]))
    2.0
    """
    return float(np.max(values))


def minimum(_time: Values, values: Values) -> float:
    """Return the smallest value.

    >>> minimum(np.arange(3.0), np.array([1.0, -3.0, 2.0]))
    -3.0
    """
    return float(np.min(values))


def mean(time: Values, values: Values) -> float:
    """Return the mean over time of the line through the samples.

    >>> mean(np.arange(3.0), np.array([0.0, 2.0, 2.0]))
    1.5
    """
    span = float(time[-1] - time[0])
    return float(np.trapezoid(values, time)) / span if span > 0 else float(values[0])


def final_value(_time: Values, values: Values) -> float:
    """Return the last value.

    >>> final_value(np.arange(3.0), np.array([1.0, -3.0, 2.0]))
    2.0
    """
    return float(values[-1])


def final_error(_time: Values, values: Values, *, final: float) -> float:
    """Return how far the last value is from `final`.

    >>> final_error(np.arange(3.0), np.array([1.0, -3.0, 2.0]), final=2.5)
    0.5
    """
    return abs(float(values[-1]) - final)


def largest_error(_time: Values, values: Values, *, final: float) -> float:
    """Return how far the signal gets from `final`.

    >>> largest_error(np.arange(3.0), np.array([1.0, -3.0, 2.0]), final=1.0)
    4.0
    """
    return float(np.max(np.abs(values - final)))


def steady_state_error(time: Values, values: Values, *, final: float) -> float:
    """Return how far the mean over time is from `final`.

    >>> steady_state_error(np.arange(3.0), np.array([0.0, 2.0, 2.0]), final=2.0)
    0.5
    """
    return abs(mean(time, values) - final)


def fraction_in_range(
    time: Values, values: Values, *, low: float = -math.inf, high: float = math.inf
) -> float:
    """Return the share of the time over which low <= values <= high; a sample holds until the next.

    >>> fraction_in_range(np.arange(5.0), np.array([3.0, 1.0, 0.0, 1.0, 1.0]), high=1.0)
    0.75
    """
    inside = (values >= low) & (values <= high)
    span = float(time[-1] - time[0])
    return float(np.sum(np.diff(time)[inside[:-1]])) / span if span > 0 else float(inside[0])


def _magnitude(bound: Bound, window: Window, _arguments: Mapping[str, float]) -> Limits | None:
    if bound.maximum is None:
        return None
    return Limits(low=-bound.maximum, high=bound.maximum, start=0.0, end=window.length)


def _upper(bound: Bound, window: Window, _arguments: Mapping[str, float]) -> Limits | None:
    return None if bound.maximum is None else Limits(high=bound.maximum, start=0.0, end=window.length)


def _lower(bound: Bound, window: Window, _arguments: Mapping[str, float]) -> Limits | None:
    return None if bound.minimum is None else Limits(low=bound.minimum, start=0.0, end=window.length)


def _around(bound: Bound, window: Window, arguments: Mapping[str, float]) -> Limits | None:
    if bound.maximum is None:
        return None
    final = arguments["final"]
    return Limits(low=final - bound.maximum, high=final + bound.maximum, start=0.0, end=window.length)


def _around_at_end(bound: Bound, window: Window, arguments: Mapping[str, float]) -> Limits | None:
    if bound.maximum is None:
        return None
    final = arguments["final"]
    return Limits(
        low=final - bound.maximum, high=final + bound.maximum, start=window.length, end=window.length
    )


def _at_end(bound: Bound, window: Window, _arguments: Mapping[str, float]) -> Limits | None:
    return Limits(low=bound.minimum, high=bound.maximum, start=window.length, end=window.length)


LOW = Argument("low", Kind.SIGNAL, "lower limit, included; else there is none", optional=True)
HIGH = Argument("high", Kind.SIGNAL, "upper limit, included; else there is none", optional=True)

EXTENT = (
    Metric(
        name="peak",
        take=peak,
        words="largest magnitude",
        definition="largest |signal| in the window",
        unit=UnitRule(signal=1),
        limits=_magnitude,
    ),
    Metric(
        name="maximum",
        take=maximum,
        words="maximum",
        definition="largest value of the signal in the window",
        unit=UnitRule(signal=1),
        better=Better.NEITHER,
        limits=_upper,
    ),
    Metric(
        name="minimum",
        take=minimum,
        words="minimum",
        definition="smallest value of the signal in the window",
        unit=UnitRule(signal=1),
        better=Better.NEITHER,
        limits=_lower,
    ),
    Metric(
        name="mean",
        take=mean,
        words="mean",
        definition="mean over the time of the window of the line through the samples",
        unit=UnitRule(signal=1),
        better=Better.NEITHER,
    ),
    Metric(
        name="final_value",
        take=final_value,
        words="final value",
        definition="value of the signal at the last scan of the window",
        unit=UnitRule(signal=1),
        better=Better.NEITHER,
        limits=_at_end,
    ),
    Metric(
        name="final_error",
        take=final_error,
        words="final error",
        definition="|signal - final| at the last scan of the window",
        unit=UnitRule(signal=1, apart=True),
        arguments=(FINAL,),
        limits=_around_at_end,
    ),
    Metric(
        name="largest_error",
        take=largest_error,
        words="largest error",
        definition="largest |signal - final| in the window",
        unit=UnitRule(signal=1, apart=True),
        arguments=(FINAL,),
        limits=_around,
    ),
    Metric(
        name="steady_state_error",
        take=steady_state_error,
        words="steady-state error",
        definition="|mean - final|, with the mean over the time of the window",
        unit=UnitRule(signal=1, apart=True),
        arguments=(FINAL,),
    ),
    Metric(
        name="fraction_in_range",
        take=fraction_in_range,
        words="fraction in range",
        definition="share of the time of the window over which low <= signal <= high; "
        "a sample holds until the next",
        unit=UnitRule(),
        arguments=(LOW, HIGH),
        better=Better.HIGHER,
        any_of=("low", "high"),
    ),
)
