"""Trace and corridor → finding: a signal stays between limits that change with time."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fcl_sim.judge import wording
from fcl_sim.judge.finding import Finding
from fcl_sim.judge.verdict import Corridor, Status
from fcl_sim.loop.trace import Trace, Values


@dataclass(frozen=True, slots=True, kw_only=True)
class Seen:
    """The samples (n,) of a signal from the first to the last row of a corridor, and their margins.

    `margins` are the distances to the nearer edge, negative outside.
    """

    ticks: NDArray[np.int64]
    values: Values
    margins: Values


def edges(corridor: Corridor, ticks: NDArray[np.int64]) -> tuple[Values, Values]:
    """Return lower and upper edge (n,) at ticks within the corridor; -inf and inf where there is none.

    They are linear between two rows that both have one.
    """
    rows = np.array(corridor.ticks, dtype=np.float64)
    at = ticks.astype(np.float64)
    low = np.interp(at, rows, np.array(corridor.low))
    high = np.interp(at, rows, np.array(corridor.high))
    return np.where(np.isnan(low), -np.inf, low), np.where(np.isnan(high), np.inf, high)


def consider(trace: Trace, corridor: Corridor) -> Finding:
    """Return what a run came to; its value is the smallest margin, in the unit of the signal."""
    first, last = corridor.ticks[0], corridor.ticks[-1]
    inside = (trace.ticks >= first) & (trace.ticks <= last)
    ticks, values = trace.ticks[inside], trace[corridor.signal][inside]
    end = int(trace.ticks[-1]) if trace.ticks.size else 0
    if not ticks.size:
        return _nothing_to_see(corridor, end)
    broken = np.flatnonzero(~np.isfinite(values))
    if broken.size:
        at = wording.seconds(int(ticks[broken[0]]) / 1e9)
        return Finding(status=Status.FAULT, reason=f"{corridor.signal} is not a finite number at {at}")
    low, high = edges(corridor, ticks)
    seen = Seen(ticks=ticks, values=values, margins=np.minimum(values - low, high - values))
    if (seen.margins < 0).any():
        return _left(trace, corridor, seen)
    if end < last:
        ends, wanted = wording.seconds(end / 1e9), wording.seconds(last / 1e9)
        reason = f"the trace ends at {ends}, and the corridor at {wanted}"
        return Finding(status=Status.INCONCLUSIVE, reason=reason)
    margin, at = _least(seen)
    if not np.isfinite(margin):
        return Finding(status=Status.UNTESTED, reason="the corridor has no edge at any scan")
    nearest = wording.number(margin, wording.apart(trace.units[corridor.signal]), 0.0)
    reason = f"{corridor.signal} stays in its corridor, {nearest} from its edge at {at}"
    return Finding(status=Status.PASS, reason=reason, value=margin)


def _nothing_to_see(corridor: Corridor, end: int) -> Finding:
    first, last = (wording.seconds(each / 1e9) for each in (corridor.ticks[0], corridor.ticks[-1]))
    if end < corridor.ticks[0]:
        reason = f"the trace ends at {wording.seconds(end / 1e9)}, before the corridor begins at {first}"
        return Finding(status=Status.INCONCLUSIVE, reason=reason)
    return Finding(status=Status.UNTESTED, reason=f"no scan falls into the corridor from {first} to {last}")


def _least(seen: Seen) -> tuple[float, str]:
    worst = int(np.argmin(seen.margins))
    return float(seen.margins[worst]), wording.seconds(int(seen.ticks[worst]) / 1e9)


def _left(trace: Trace, corridor: Corridor, seen: Seen) -> Finding:
    outside = seen.margins < 0
    first = int(np.argmax(outside))
    rest = outside[first:]
    last = first + (len(rest) if rest.all() else int(np.argmin(rest))) - 1
    violation = int(seen.ticks[first]) / 1e9, int(seen.ticks[last]) / 1e9
    margin, at = _least(seen)
    beyond = wording.number(-margin, wording.apart(trace.units[corridor.signal]), 0.0)
    start, stop = (wording.seconds(each) for each in violation)
    when = f"at {start}" if start == stop else f"from {start} to {stop}"
    reason = f"{corridor.signal} leaves its corridor, by {beyond} at {at}, first violated {when}"
    return Finding(status=Status.FAIL, reason=reason, value=margin, violation=violation)
