"""Metrics of a response: how fast a signal gets where it should, and how far beyond."""

import math
from collections.abc import Mapping

import numpy as np

from fcl_sim.judge.metric import Argument, Bound, Kind, Limits, Metric, UnitRule, Window
from fcl_sim.loop.trace import Values

FINAL = Argument("final", Kind.SIGNAL, "value that the signal should reach")
INITIAL = Argument(
    "initial", Kind.SIGNAL, "value that the signal starts from; else its first sample", optional=True
)


def crossing(time: Values, values: Values, level: float, before: int) -> float:
    """Return when the line from sample `before` to the next one passes `level`."""
    ahead = (level - values[before]) / (values[before + 1] - values[before])
    return float(time[before] + ahead * (time[before + 1] - time[before]))


def settling_time(
    time: Values,
    values: Values,
    *,
    final: float,
    band: float = math.inf,
    part: float = math.inf,
    initial: float | None = None,
) -> float:
    """Return when |values - final| <= band begins to hold for good; inf where the last sample is outside.

    `part` is a band, too, as part of the way from `initial` to `final`; of both the
    narrower one counts. NaN where there is only a part, and no way to go.

    >>> settling_time(np.arange(4.0), np.array([4.0, 2.0, 0.0, 0.0]), final=0.0, band=0.5)
    1.75
    >>> settling_time(np.arange(4.0), np.array([4.0, 2.0, 0.0, 0.0]), final=0.0, part=0.125)
    1.75
    """
    way = abs(final - (float(values[0]) if initial is None else initial))
    if math.isfinite(part):
        if way == 0.0 and math.isinf(band):
            return math.nan
        band = min(band, part * way) if way else band
    return _settled_in(time, values, final, band)


def _settled_in(time: Values, values: Values, final: float, band: float) -> float:
    outside = np.flatnonzero(np.abs(values - final) > band)
    if outside.size == 0:
        return 0.0
    last = int(outside[-1])
    if last == len(values) - 1:
        return math.inf
    edge = final + math.copysign(band, values[last] - final)
    return crossing(time, values, edge, last)


def rise_time(
    time: Values, values: Values, *, final: float, initial: float | None = None, low: float, high: float
) -> float:
    """Return the time between the first passages of two levels on the way from `initial` to `final`.

    The levels are the parts `low` and `high` of that way. NaN where there is no
    way to go, inf where a level is not reached.

    >>> rise_time(np.arange(3.0), np.array([4.0, 2.0, 0.0]), final=0.0, low=0.25, high=0.75)
    1.0
    """
    start = float(values[0]) if initial is None else initial
    if start == final:
        return math.nan
    part = (values - start) / (final - start)
    risen = _first_passage(time, part, high)
    return risen if math.isinf(risen) else risen - _first_passage(time, part, low)


def _first_passage(time: Values, part: Values, level: float) -> float:
    reached = np.flatnonzero(part >= level)
    if reached.size == 0:
        return math.inf
    first = int(reached[0])
    return float(time[0]) if first == 0 else crossing(time, part, level, first - 1)


def overshoot(_time: Values, values: Values, *, final: float, initial: float | None = None) -> float:
    """Return how far the signal goes beyond `final` in the direction of motion; NaN where there is none.

    >>> overshoot(np.arange(4.0), np.array([25.0, 3.0, -2.0, 0.0]), final=0.0)
    2.0
    """
    start = float(values[0]) if initial is None else initial
    if start == final:
        return math.nan
    return max(0.0, float(np.max((values - final) * math.copysign(1.0, final - start))))


def relative_overshoot(time: Values, values: Values, *, final: float, initial: float | None = None) -> float:
    """Return the overshoot as a part of the way from `initial` to `final`; NaN where there is none.

    >>> relative_overshoot(np.arange(4.0), np.array([25.0, 3.0, -2.0, 0.0]), final=0.0)
    0.08
    """
    start = float(values[0]) if initial is None else initial
    beyond = overshoot(time, values, final=final, initial=start)
    return beyond if math.isnan(beyond) else beyond / abs(final - start)


def undershoot(_time: Values, values: Values, *, final: float, initial: float | None = None) -> float:
    """Return how far the signal goes back behind `initial`; NaN where there is no motion to go against.

    >>> undershoot(np.arange(4.0), np.array([0.0, -0.5, 3.0, 4.0]), final=4.0)
    0.5
    """
    start = float(values[0]) if initial is None else initial
    if start == final:
        return math.nan
    return max(0.0, float(np.max((start - values) * math.copysign(1.0, final - start))))


def transient_time(time: Values, values: Values, *, final: float, part: float) -> float:
    """Return when |values - final| begins to stay within `part` of its largest value; inf where it does not.

    >>> transient_time(np.arange(4.0), np.array([-1.0, 4.0, 0.0, 0.0]), final=0.0, part=0.25)
    1.75
    """
    return _settled_in(time, values, final, part * float(np.max(np.abs(values - final))))


def _settled(bound: Bound, window: Window, arguments: Mapping[str, float]) -> Limits | None:
    if bound.maximum is None:
        return None
    final, band = arguments["final"], arguments.get("band", math.inf)
    way = abs(final - arguments.get("initial", window.first))
    if "part" in arguments and way:
        band = min(band, arguments["part"] * way)
    return Limits(low=final - band, high=final + band, start=bound.maximum, end=window.length)


def _not_beyond(bound: Bound, window: Window, arguments: Mapping[str, float]) -> Limits | None:
    start, final = arguments.get("initial", window.first), arguments["final"]
    if bound.maximum is None or start == final:
        return None
    if final > start:
        return Limits(high=final + bound.maximum, start=0.0, end=window.length)
    return Limits(low=final - bound.maximum, start=0.0, end=window.length)


def _not_beyond_part(bound: Bound, window: Window, arguments: Mapping[str, float]) -> Limits | None:
    if bound.maximum is None:
        return None
    way = abs(arguments["final"] - arguments.get("initial", window.first))
    return _not_beyond(Bound(maximum=bound.maximum * way), window, arguments)


def _not_behind(bound: Bound, window: Window, arguments: Mapping[str, float]) -> Limits | None:
    start, final = arguments.get("initial", window.first), arguments["final"]
    if bound.maximum is None or start == final:
        return None
    if final > start:
        return Limits(low=start - bound.maximum, start=0.0, end=window.length)
    return Limits(high=start + bound.maximum, start=0.0, end=window.length)


NO_MOTION = "starts at its final value, so there is no motion towards it to measure"

RESPONSE = (
    Metric(
        name="settling_time",
        take=settling_time,
        words="settling time",
        definition="time from the start of the window until the signal stays within final ± band "
        "to the end of the window; the crossing is interpolated linearly between two scans",
        unit=UnitRule(time=1),
        arguments=(
            FINAL,
            Argument("band", Kind.DIFFERENCE, "largest distance from the final value", optional=True),
            Argument("part", Kind.NUMBER, "the band as part of the way from initial to final", optional=True),
            INITIAL,
        ),
        never="settle",
        undefined=NO_MOTION,
        limits=_settled,
        any_of=("band", "part"),
    ),
    Metric(
        name="rise_time",
        take=rise_time,
        words="rise time",
        definition="time between the first passages of the parts low and high of the way from the initial "
        "to the final value; the crossings are interpolated linearly between two scans",
        unit=UnitRule(time=1),
        arguments=(
            FINAL,
            INITIAL,
            Argument("low", Kind.NUMBER, "part of the way at which the time begins", default=0.1),
            Argument("high", Kind.NUMBER, "part of the way at which the time ends", default=0.9),
        ),
        never="rise",
        undefined=NO_MOTION,
    ),
    Metric(
        name="overshoot",
        take=overshoot,
        words="overshoot",
        definition="largest distance of the signal beyond its final value in the direction from the initial "
        "to the final value, in the unit of the signal; 0 where it does not go beyond",
        unit=UnitRule(signal=1, apart=True),
        arguments=(FINAL, INITIAL),
        undefined=NO_MOTION,
        limits=_not_beyond,
    ),
    Metric(
        name="relative_overshoot",
        take=relative_overshoot,
        words="relative overshoot",
        definition="largest distance of the signal beyond its final value in the direction from the initial "
        "to the final value, as a part of the distance between these two; 0 where it does not go beyond",
        unit=UnitRule(),
        arguments=(FINAL, INITIAL),
        undefined=NO_MOTION,
        limits=_not_beyond_part,
    ),
    Metric(
        name="undershoot",
        take=undershoot,
        words="undershoot",
        definition="largest distance of the signal behind its initial value, against the direction from the "
        "initial to the final value, in the unit of the signal; 0 where it does not go behind",
        unit=UnitRule(signal=1, apart=True),
        arguments=(FINAL, INITIAL),
        undefined=NO_MOTION,
        limits=_not_behind,
    ),
    Metric(
        name="transient_time",
        take=transient_time,
        words="transient time",
        definition="time from the start of the window until |signal - final| stays within a part of its "
        "largest value in the window, to the end of it; the crossing is interpolated linearly "
        "between two scans",
        unit=UnitRule(time=1),
        arguments=(
            FINAL,
            Argument("part", Kind.NUMBER, "part of the largest error that is left", default=0.02),
        ),
        never="settle",
    ),
)
