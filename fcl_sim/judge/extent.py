"""Metrics of extent: how large a signal is, and how far from where it should be."""

from collections.abc import Mapping

import numpy as np

from fcl_sim.judge.metric import Better, Bound, Limits, Metric, UnitRule, Window
from fcl_sim.judge.response import FINAL
from fcl_sim.loop.trace import Values


def peak(_time: Values, values: Values) -> float:
    """Return the largest magnitude."""
    return float(np.max(np.abs(values)))


def maximum(_time: Values, values: Values) -> float:
    """Return the largest value."""
    return float(np.max(values))


def minimum(_time: Values, values: Values) -> float:
    """Return the smallest value."""
    return float(np.min(values))


def mean(time: Values, values: Values) -> float:
    """Return the mean over time of the line through the samples."""
    span = float(time[-1] - time[0])
    return float(np.trapezoid(values, time)) / span if span > 0 else float(values[0])


def final_value(_time: Values, values: Values) -> float:
    """Return the last value."""
    return float(values[-1])


def final_error(_time: Values, values: Values, *, final: float) -> float:
    """Return how far the last value is from `final`."""
    return abs(float(values[-1]) - final)


def largest_error(_time: Values, values: Values, *, final: float) -> float:
    """Return how far the signal gets from `final`."""
    return float(np.max(np.abs(values - final)))


def steady_state_error(time: Values, values: Values, *, final: float) -> float:
    """Return how far the mean over time is from `final`."""
    return abs(mean(time, values) - final)


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
        unit=UnitRule(signal=1),
        arguments=(FINAL,),
        limits=_around_at_end,
    ),
    Metric(
        name="largest_error",
        take=largest_error,
        words="largest error",
        definition="largest |signal - final| in the window",
        unit=UnitRule(signal=1),
        arguments=(FINAL,),
        limits=_around,
    ),
    Metric(
        name="steady_state_error",
        take=steady_state_error,
        words="steady-state error",
        definition="|mean - final|, with the mean over the time of the window",
        unit=UnitRule(signal=1),
        arguments=(FINAL,),
    ),
)
