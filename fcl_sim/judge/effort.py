"""Metrics of effort: what a manipulated value costs the drive that follows it.

A manipulated value is held from one scan to the next, so its samples hold
until the next one here, too; the last one has no duration.
"""

import math

import numpy as np
from numpy.typing import NDArray

from fcl_sim.judge.extent import HIGH, LOW
from fcl_sim.judge.metric import Argument, Combined, Kind, Metric, Reads, UnitRule
from fcl_sim.loop.trace import Values


def total_variation(_time: Values, values: Values) -> float:
    """Return the sum of the magnitudes of all steps from one sample to the next.

    >>> total_variation(np.arange(4.0), np.array([0.0, 2.0, -1.0, -1.0]))
    5.0
    """
    return float(np.sum(np.abs(np.diff(values))))


def peak_rate(time: Values, values: Values) -> float:
    """Return the largest magnitude of a step from one sample to the next, over the time between them.

    >>> peak_rate(np.array([0.0, 0.5, 1.0]), np.array([0.0, 1.0, -2.0]))
    6.0
    """
    return float(np.max(np.abs(np.diff(values)) / np.diff(time), initial=0.0))


def saturation_time(time: Values, values: Values, *, low: float = -math.inf, high: float = math.inf) -> float:
    """Return the time spent at a limit or beyond.

    >>> saturation_time(np.arange(4.0), np.array([27.0, 27.0, 3.0, -27.0]), low=-27.0, high=27.0)
    2.0
    """
    return _duration(time, (values <= low) | (values >= high))


def time_undefined(time: Values, values: Values) -> float:
    """Return the time over which no rule was active; `values` are 1 there, else 0.

    >>> time_undefined(np.arange(4.0), np.array([0.0, 1.0, 1.0, 0.0]))
    2.0
    """
    return _duration(time, values > 0.5)


def _duration(time: Values, where: NDArray[np.bool_]) -> float:
    return float(np.sum(np.diff(time)[where[:-1]]))


def reversals(_time: Values, values: Values, *, least: float) -> float:
    """Return how often the signal turns round; swings of `least` or less are no turns.

    >>> reversals(np.arange(6.0), np.array([0.0, 2.0, 1.9, 3.0, 0.0, 1.0]), least=0.5)
    2.0
    """
    turns, direction, extreme = 0, 0.0, float(values[0])
    low = high = extreme
    for value in values.tolist():
        low, high = min(low, value), max(high, value)
        if direction == 0.0:
            if high - low > least:
                direction, extreme = math.copysign(1.0, value - (low + high) / 2.0), value
        elif (value - extreme) * direction >= 0.0:
            extreme = value
        elif abs(value - extreme) > least:
            turns, direction, extreme = turns + 1, -direction, value
    return float(turns)


def energy(time: Values, values: Values, *, recovered: float) -> float:
    """Return the integral of a power: all that is drawn, less the part `recovered` of what is fed back.

    >>> energy(np.arange(4.0), np.array([5.0, 2.0, -4.0, 0.0]), recovered=0.5)
    5.0
    """
    drawn = np.where(values > 0.0, values, recovered * values)
    return float(np.sum(drawn[:-1] * np.diff(time)))


EFFORT = (
    Metric(
        name="total_variation",
        take=total_variation,
        words="total variation",
        definition="sum of |signal - signal at the scan before| over the scans of the window",
        unit=UnitRule(signal=1, apart=True),
        combined=Combined.SUM,
    ),
    Metric(
        name="peak_rate",
        take=peak_rate,
        words="peak rate",
        definition="largest |signal - signal at the scan before| / time between the two scans, in the window",
        unit=UnitRule(signal=1, time=-1),
    ),
    Metric(
        name="saturation_time",
        take=saturation_time,
        words="saturation time",
        definition="time of the window over which signal <= low or signal >= high; "
        "a sample holds until the next",
        unit=UnitRule(time=1),
        arguments=(LOW, HIGH),
        combined=Combined.SUM,
        any_of=("low", "high"),
    ),
    Metric(
        name="time_undefined",
        take=time_undefined,
        words="time without an active rule",
        definition="time of the window over which no rule was active for this output; "
        "a scan counts until the next",
        unit=UnitRule(time=1),
        reads=Reads.UNDEFINED,
        combined=Combined.SUM,
    ),
    Metric(
        name="reversals",
        take=reversals,
        words="number of reversals",
        definition="how often the signal changes its direction in the window, "
        "once it has gone back by more than least",
        unit=UnitRule(),
        arguments=(Argument("least", Kind.DIFFERENCE, "largest swing that does not count", default=0.0),),
        combined=Combined.SUM,
    ),
    Metric(
        name="energy",
        take=energy,
        words="energy",
        definition="integral over the window of the signal, a power, where it is positive, "
        "and of the part recovered of it where it is negative; a sample holds until the next",
        unit=UnitRule(signal=1, time=1),
        arguments=(
            Argument("recovered", Kind.NUMBER, "part of what is fed back that is not lost", default=0.0),
        ),
        combined=Combined.SUM,
    ),
)
