"""Integral criteria: the error of a whole response in one number.

All are exact for the line through the samples: the integrand is at most cubic
between two samples, and smooth once the zeros of the error are samples too.
"""

import numpy as np

from fcl_sim.judge.metric import Combined, Metric, UnitRule
from fcl_sim.judge.response import FINAL
from fcl_sim.loop.trace import Values


def iae(time: Values, values: Values, *, final: float) -> float:
    """Return the integral of |values - final|.

    >>> iae(np.array([0.0, 2.0]), np.array([1.0, -1.0]), final=0.0)
    1.0
    """
    at, error = _with_zeros(time, values - final)
    return float(np.trapezoid(np.abs(error), at))


def ise(time: Values, values: Values, *, final: float) -> float:
    """Return the integral of (values - final)².

    >>> ise(np.array([0.0, 3.0]), np.array([1.0, 0.0]), final=0.0)
    1.0
    """
    error = values - final
    squares = error[:-1] ** 2 + error[:-1] * error[1:] + error[1:] ** 2
    return float(np.sum(squares * np.diff(time)) / 3.0)


def itae(time: Values, values: Values, *, final: float) -> float:
    """Return the integral of time times |values - final|.

    >>> itae(np.array([0.0, 2.0]), np.array([1.0, 1.0]), final=0.0)
    2.0
    """
    at, error = _with_zeros(time, values - final)
    size = np.abs(error)
    middle = (at[:-1] + at[1:]) * (size[:-1] + size[1:])
    return float(np.sum((at[:-1] * size[:-1] + middle + at[1:] * size[1:]) * np.diff(at)) / 6.0)


def itse(time: Values, values: Values, *, final: float) -> float:
    """Return the integral of time times (values - final)².

    >>> itse(np.array([0.0, 2.0]), np.array([3.0, 3.0]), final=1.0)
    8.0
    """
    error = values - final
    middle = (time[:-1] + time[1:]) * (error[:-1] + error[1:]) ** 2 / 2.0
    ends = time[:-1] * error[:-1] ** 2 + time[1:] * error[1:] ** 2
    return float(np.sum((ends + middle) * np.diff(time)) / 6.0)


def _with_zeros(time: Values, error: Values) -> tuple[Values, Values]:
    before = np.flatnonzero(np.sign(error[:-1]) * np.sign(error[1:]) < 0)
    part = error[before] / (error[before] - error[before + 1])
    zeros = time[before] + part * (time[before + 1] - time[before])
    return np.insert(time, before + 1, zeros), np.insert(error, before + 1, 0.0)


INTEGRAL = (
    Metric(
        name="iae",
        take=iae,
        words="integral of the absolute error",
        definition="integral of |signal - final| over the window, exact for the line through the samples",
        unit=UnitRule(signal=1, time=1),
        arguments=(FINAL,),
        combined=Combined.SUM,
    ),
    Metric(
        name="ise",
        take=ise,
        words="integral of the squared error",
        definition="integral of (signal - final)² over the window, exact for the line through the samples",
        unit=UnitRule(signal=2, time=1),
        arguments=(FINAL,),
        combined=Combined.SUM,
    ),
    Metric(
        name="itae",
        take=itae,
        words="time-weighted integral of the absolute error",
        definition="integral of t |signal - final| over the window, t from its start, "
        "exact for the line through the samples",
        unit=UnitRule(signal=1, time=2),
        arguments=(FINAL,),
        combined=Combined.SUM,
    ),
    Metric(
        name="itse",
        take=itse,
        words="time-weighted integral of the squared error",
        definition="integral of t (signal - final)² over the window, t from its start, "
        "exact for the line through the samples",
        unit=UnitRule(signal=2, time=2),
        arguments=(FINAL,),
        combined=Combined.SUM,
    ),
)
