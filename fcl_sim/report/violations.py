"""Where a run violates what is required of it: all of it, as far as a figure can show it."""

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from fcl_sim.judge.corridor import edges
from fcl_sim.judge.verdict import Verdict
from fcl_sim.loop.trace import Trace
from fcl_sim.report.stretches import stretches

Interval = tuple[float, float]
"""Start and end in seconds."""


def violations(trace: Trace, verdict: Verdict, names: Sequence[str]) -> list[Interval]:
    """Return where a run violates a requirement in the signal called by any of `names`, in order of time.

    Of bounds and of a corridor that is every stretch outside; of a formula what
    is first violated, and only in signals that are to blame.
    """
    first = verdict.violation
    about = verdict.blamed or verdict.requirement.signals
    if first is None or set(names).isdisjoint(about):
        return []
    seen = _outside(trace, verdict)
    found = [] if seen is None else [_interval(trace, *each) for each in stretches(seen)]
    if not any(start <= first[0] and first[1] <= end for start, end in found):
        found.append(first)  # the band is that of another piece of a run that is cut at restarts
    return sorted(found)


def all_violations(trace: Trace, verdicts: Sequence[Verdict], names: Sequence[str]) -> list[Interval]:
    """Return where a run violates any requirement, seen in one signal: stretches that do not overlap."""
    return merged(each for verdict in verdicts for each in violations(trace, verdict, names))


def merged(intervals: Iterable[Interval]) -> list[Interval]:
    """Return stretches that do not overlap and cover what others do, in order of time."""
    found: list[Interval] = []
    for start, end in sorted(intervals):
        if found and start <= found[-1][1]:
            found[-1] = (found[-1][0], max(found[-1][1], end))
        else:
            found.append((start, end))
    return found


def _outside(trace: Trace, verdict: Verdict) -> NDArray[np.bool_] | None:
    """Return at which samples (n,) bounds or a corridor are not kept; None where there are none."""
    corridor, band = verdict.requirement.corridor, verdict.band
    if corridor is not None:
        inside = (trace.ticks >= corridor.ticks[0]) & (trace.ticks <= corridor.ticks[-1])
        low, high = edges(corridor, trace.ticks)
        values = trace[corridor.signal]
    elif band is not None:
        inside = (trace.time >= band.start) & (trace.time <= band.end)
        values = trace[band.signal]
        low = np.full(1, -np.inf if band.low is None else band.low)
        high = np.full(1, np.inf if band.high is None else band.high)
    else:
        return None
    found: NDArray[np.bool_] = inside & ((values < low) | (values > high))
    return found


def _interval(trace: Trace, first: int, behind: int) -> Interval:
    return float(trace.time[first]), float(trace.time[behind - 1])
