"""Metrics of oscillation: how far, how fast and how lastingly a signal swings about a value.

A half-wave goes from one crossing of that value to the next. What comes before
the first crossing and behind the last is none, so a start far off does not count.
"""

import math

import numpy as np

from fcl_sim.judge.metric import Argument, Better, Kind, Metric, UnitRule
from fcl_sim.judge.response import crossing
from fcl_sim.loop.trace import Values

ABOUT = Argument("final", Kind.SIGNAL, "value that the signal swings about")
LEAST = Argument(
    "least", Kind.DIFFERENCE, "distance from it up to which the signal crosses nothing", default=0.0
)


def oscillation_amplitude(time: Values, values: Values, *, final: float, least: float) -> float:
    """Return the largest distance from `final` in a half-wave; 0 where there is none.

    >>> oscillation_amplitude(np.arange(5.0), np.array([9.0, -2.0, 3.0, -1.0, -1.0]), final=0.0, least=0.0)
    3.0
    """
    _, extremes = half_waves(time, values, final, least)
    return float(np.max(extremes, initial=0.0))


def oscillation_period(time: Values, values: Values, *, final: float, least: float) -> float:
    """Return twice the mean length of the half-waves; NaN where there are less than two.

    >>> oscillation_period(np.arange(4.0), np.array([1.0, -1.0, 1.0, -1.0]), final=0.0, least=0.0)
    2.0
    """
    crossings, _ = half_waves(time, values, final, least)
    if len(crossings) < 3:
        return math.nan
    return 2.0 * float(crossings[-1] - crossings[0]) / (len(crossings) - 1)


def oscillation_decay(time: Values, values: Values, *, final: float, least: float) -> float:
    """Return how much is left of a swing one period later, on the mean; NaN with less than two half-waves.

    >>> oscillation_decay(np.arange(5.0), np.array([9.0, -4.0, 2.0, -1.0, 1.0]), final=0.0, least=0.0)
    0.25
    """
    _, extremes = half_waves(time, values, final, least)
    if len(extremes) < 2:
        return math.nan
    return float((extremes[-1] / extremes[0]) ** (2.0 / (len(extremes) - 1)))


def residual_sway(_time: Values, values: Values) -> float:
    """Return half the distance from the smallest to the largest value.

    >>> residual_sway(np.arange(3.0), np.array([0.5, -0.25, 0.25]))
    0.375
    """
    return float(np.max(values) - np.min(values)) / 2.0


def half_waves(time: Values, values: Values, about: float, least: float) -> tuple[Values, Values]:
    """Return when the line through the samples crosses `about` (m + 1,), and how far it goes between (m,).

    The signal has crossed once it is further than `least` on the other side.
    """
    error = values - about
    far = np.flatnonzero(np.abs(error) > least)
    change = np.flatnonzero(np.diff(np.sign(error[far])) != 0)
    times, first = [], far[change + 1]
    for before, after in zip(far[change].tolist(), first.tolist(), strict=True):
        stretch = np.sign(error[before + 1 : after + 1]) != np.sign(error[before])
        times.append(crossing(time, error, 0.0, before + int(np.argmax(stretch))))
    if not times:
        return np.zeros(0), np.zeros(0)
    peaks = np.maximum.reduceat(np.abs(error), first)[:-1] if len(first) > 1 else np.zeros(0)
    return np.array(times), peaks


NO_PERIOD = "does not swing through one whole period about its final value"

OSCILLATION = (
    Metric(
        name="oscillation_amplitude",
        take=oscillation_amplitude,
        words="amplitude of oscillation",
        definition="largest |signal - final| between two crossings of final in the window; "
        "0 where it is crossed less than twice",
        unit=UnitRule(signal=1, apart=True),
        arguments=(ABOUT, LEAST),
    ),
    Metric(
        name="oscillation_period",
        take=oscillation_period,
        words="period of oscillation",
        definition="twice the mean time between two crossings of final in the window; "
        "the crossings are interpolated linearly between two scans",
        unit=UnitRule(time=1),
        arguments=(ABOUT, LEAST),
        better=Better.NEITHER,
        undefined=NO_PERIOD,
    ),
    Metric(
        name="oscillation_decay",
        take=oscillation_decay,
        words="decay ratio",
        definition="ratio of two extremes of signal - final that are a period apart: geometric mean over the "
        "window; above 1 the oscillation grows",
        unit=UnitRule(),
        arguments=(ABOUT, LEAST),
        undefined=NO_PERIOD,
    ),
    Metric(
        name="residual_sway",
        take=residual_sway,
        words="residual sway",
        definition="half the distance from the smallest to the largest value of the signal in the window, "
        "which begins with `from` when the motion is over",
        unit=UnitRule(signal=1, apart=True),
    ),
)
