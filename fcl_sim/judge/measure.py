"""Trace and a bound on a metric → finding: the metric in its window, or in every piece of it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fcl_sim.judge import wording
from fcl_sim.judge.finding import Finding
from fcl_sim.judge.metric import Better, Bound, Combined, Limits, Metric, Reads, Window
from fcl_sim.judge.verdict import Requirement, Status
from fcl_sim.loop.trace import Trace, Values

Interval = tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Cut:
    """The samples of a signal in a window, (n,); `start` and `end` in nanoseconds."""

    ticks: NDArray[np.int64]
    values: Values
    start: int
    end: int

    @property
    def time(self) -> Values:
        """Seconds from the start of the window, (n,)."""
        return (self.ticks - self.start) / 1e9

    @property
    def length(self) -> float:
        """Length of the window in seconds."""
        return (self.end - self.start) / 1e9


@dataclass(frozen=True, slots=True, kw_only=True)
class Taken:
    """A metric, taken in a piece."""

    cut: Cut
    value: float
    limits: Limits | None
    violation: Interval | None
    needed: int


def measure(trace: Trace, requirement: Requirement, metric: Metric) -> Finding:
    """Return what a run without a fault came to."""
    values = _values(trace, requirement.signal, metric.reads)
    if values is None:
        reason = f"the trace does not tell when a rule was active for {requirement.signal}"
        return Finding(status=Status.UNTESTED, reason=reason)
    cuts = _cuts(trace, values, requirement)
    for cut in cuts:
        if not cut.ticks.size:
            return _nothing_to_see(trace, cut)
        broken = np.flatnonzero(~np.isfinite(cut.values))
        if broken.size:
            at = wording.seconds(int(cut.ticks[broken[0]]) / 1e9)
            reason = f"{requirement.signal} is not a finite number at {at}"
            return Finding(status=Status.FAULT, reason=reason)
    return _judged(trace, requirement, metric, [_taken(requirement, metric, cut) for cut in cuts])


def _values(trace: Trace, signal: str, reads: Reads) -> Values | None:
    """Return the samples (n,) that a metric is taken of; None where the trace does not have them."""
    if reads is Reads.SIGNAL:
        return trace[signal]
    for path, record in trace.fuzzy.items():
        for column, output in enumerate(record.output_names):
            if signal in {f"{path}.{output}", path}:
                return (~record.active[:, column]).astype(np.float64)
    return None


def _cuts(trace: Trace, values: Values, requirement: Requirement) -> list[Cut]:
    start = round(requirement.arguments.get("from", 0.0) * 1e9)
    last = int(trace.ticks[-1]) if trace.ticks.size else 0
    to = requirement.arguments.get("to")
    end = last if to is None else round(to * 1e9)
    edges = [start, *(round(each * 1e9) for each in requirement.restart_at), end]
    whole = Cut(ticks=trace.ticks, values=values, start=start, end=end)
    pieces = [_piece(whole, begin, stop) for begin, stop in pairwise(edges[:-1])]
    return [*pieces, _within(whole, edges[-2], end)]


def _within(whole: Cut, start: int, end: int) -> Cut:
    inside = (whole.ticks >= start) & (whole.ticks <= end)
    return Cut(ticks=whole.ticks[inside], values=whole.values[inside], start=start, end=end)


def _piece(whole: Cut, start: int, restart: int) -> Cut:
    """Return what lies before a restart, its last sample held until there."""
    cut = _within(whole, start, restart - 1)
    if not cut.ticks.size or not whole.ticks.size or whole.ticks[-1] < restart:
        return Cut(ticks=cut.ticks, values=cut.values, start=start, end=restart)
    ticks, values = np.append(cut.ticks, restart), np.append(cut.values, cut.values[-1])
    return Cut(ticks=ticks, values=values, start=start, end=restart)


def _nothing_to_see(trace: Trace, cut: Cut) -> Finding:
    last = int(trace.ticks[-1]) if trace.ticks.size else 0
    window = f"from {wording.seconds(cut.start / 1e9)} to {wording.seconds(max(cut.end, cut.start) / 1e9)}"
    if cut.start > last:
        begins = wording.seconds(cut.start / 1e9)
        reason = f"the trace ends at {wording.seconds(last / 1e9)}, before the window begins at {begins}"
        return Finding(status=Status.INCONCLUSIVE, reason=reason)
    return Finding(status=Status.UNTESTED, reason=f"no scan falls into the window {window}")


def _taken(requirement: Requirement, metric: Metric, cut: Cut) -> Taken:
    value = metric.measure(cut.time, cut.values, requirement.arguments)
    bound = _bound(requirement)
    limits = metric.limits(bound, Window(float(cut.values[0]), cut.length), requirement.arguments)
    return Taken(
        cut=cut,
        value=value,
        limits=limits,
        violation=None if limits is None else _first_outside(limits, cut),
        needed=_needed(bound, limits, value, cut),
    )


def _bound(requirement: Requirement) -> Bound:
    return Bound(minimum=requirement.minimum, maximum=requirement.maximum)


def _judged(trace: Trace, requirement: Requirement, metric: Metric, taken: Sequence[Taken]) -> Finding:
    undefined = next((each for each in taken if math.isnan(each.value)), None)
    if undefined is not None:
        reason = f"{requirement.signal} {metric.undefined}{_where(undefined, taken)}"
        return Finding(status=Status.UNTESTED, reason=reason)
    bound = _bound(requirement)
    value, decisive = _combined(metric, bound, taken)
    violation = next((each.violation for each in taken if each.violation is not None), None)
    needed, last = max(each.needed for each in taken), int(trace.ticks[-1])
    if needed > last and violation is None:
        status, reason = Status.INCONCLUSIVE, _ends_inside(requirement, last, needed)
    else:
        status = Status.PASS if needed <= last and bound.holds(value) else Status.FAIL
        reason = _words(trace, requirement, metric, decisive.cut, value)
        reason += _how(metric, decisive, taken)
        if violation is not None and violation[0] < violation[1]:
            first, until = (wording.seconds(each) for each in violation)
            reason += f", first violated from {first} to {until}"
    return Finding(
        status=status,
        reason=reason,
        value=None if math.isinf(value) else value,
        limits=_in_trace_time(decisive.limits, decisive.cut),
        violation=violation if status is Status.FAIL else None,
    )


def _combined(metric: Metric, bound: Bound, taken: Sequence[Taken]) -> tuple[float, Taken]:
    """Return the figure over all pieces, and the piece that it is told of."""
    way = 1.0 if metric.better is Better.HIGHER else -1.0
    worst = min(taken, key=lambda each: (bound.margin(each.value), way * each.value))
    if metric.combined is Combined.SUM:
        return sum(each.value for each in taken), worst
    return worst.value, worst


def _where(piece: Taken, taken: Sequence[Taken]) -> str:
    if len(taken) == 1:
        return ""
    start, end = (wording.seconds(each / 1e9) for each in (piece.cut.start, piece.cut.end))
    return f" from {start} to {end}"


def _how(metric: Metric, decisive: Taken, taken: Sequence[Taken]) -> str:
    if len(taken) == 1:
        return ""
    if metric.combined is Combined.SUM:
        return f"; it is the sum over {len(taken)} pieces"
    return f"; it is the worst of {len(taken)} pieces, that{_where(decisive, taken)}"


def _needed(bound: Bound, limits: Limits | None, value: float, cut: Cut) -> int:
    """Return up to which tick a trace must reach for the verdict to be final."""
    needed = cut.end
    if limits is not None:
        needed = max(needed, cut.start + round(limits.start * 1e9))
    if math.isinf(value) and bound.maximum is not None:
        needed = max(needed, cut.start + round(bound.maximum * 1e9))
    return needed


def _ends_inside(requirement: Requirement, last: int, needed: int) -> str:
    ends, wanted = wording.seconds(last / 1e9), wording.seconds(needed / 1e9)
    return f"the trace ends at {ends}, and {wanted} are needed to tell; {wording.bound(requirement)}"


def _words(trace: Trace, requirement: Requirement, metric: Metric, cut: Cut, value: float) -> str:
    if not math.isinf(value):
        return wording.finding(metric, requirement, value)
    last = wording.number(float(cut.values[-1]), trace.units[requirement.signal])
    return wording.never(metric, requirement, int(cut.ticks[-1]) / 1e9, last)


def _first_outside(limits: Limits, cut: Cut) -> Interval | None:
    """Return the first and last sample, in seconds of the trace, of the first stretch outside the limits."""
    start, end = (cut.start + round(each * 1e9) for each in (limits.start, limits.end))
    low = -math.inf if limits.low is None else limits.low
    high = math.inf if limits.high is None else limits.high
    held = (cut.ticks >= start) & (cut.ticks <= end)
    outside = held & ((cut.values < low) | (cut.values > high))
    if not outside.any():
        return None
    first = int(np.argmax(outside))
    stretch = outside[first:]
    last = first + (len(stretch) if stretch.all() else int(np.argmin(stretch))) - 1
    return int(cut.ticks[first]) / 1e9, int(cut.ticks[last]) / 1e9


def _in_trace_time(limits: Limits | None, cut: Cut) -> Limits | None:
    if limits is None:
        return None
    start = cut.start / 1e9
    return Limits(low=limits.low, high=limits.high, start=start + limits.start, end=start + limits.end)
