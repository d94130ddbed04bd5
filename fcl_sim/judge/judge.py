"""Trace and requirements → verdicts."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.judge import wording
from fcl_sim.judge.metric import Bound, Limits, Metric, Window
from fcl_sim.judge.metrics import METRICS
from fcl_sim.judge.verdict import Band, Requirement, Status, Verdict
from fcl_sim.loop.trace import Trace, Values


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """What the run came to, before the expectation is looked at; `limits` in seconds of the trace."""

    status: Status
    reason: str
    value: float | None = None
    limits: Limits | None = None
    violation: tuple[float, float] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Cut:
    """The samples of a signal in the window of a requirement, (n,); `start` and `end` in nanoseconds."""

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


def judge(trace: Trace, requirements: Sequence[Requirement]) -> tuple[Verdict, ...]:
    """Return the verdict on each requirement, in their order.

    The metric and signal of every requirement must exist: a signal that the
    trace lacks is an InputFault that names the nearest.
    """
    missing = [each for each in requirements if each.signal not in trace]
    if missing:
        raise InputFault(_no_signal(trace, each) for each in missing)
    return tuple(_judge_one(trace, each) for each in requirements)


def _no_signal(trace: Trace, requirement: Requirement) -> Diagnostic:
    near = nearest(requirement.signal, trace.names)
    hint = f"did you mean `{near}`?" if near else f"it has {listed(trace.names)}"
    message = f"{requirement.id} asks for `{requirement.signal}`, which the trace does not have"
    places = (Place(span=requirement.span),) if requirement.span else ()
    return Diagnostic(code="JDG101", message=message, places=places, hint=hint)


def _judge_one(trace: Trace, requirement: Requirement) -> Verdict:
    metric = METRICS[requirement.metric]
    unit = trace.units[requirement.signal]
    found = _measure(trace, requirement, metric)
    status, reason = _after_expectation(found, requirement)
    return Verdict(
        requirement=requirement,
        status=status,
        measured=found.status,
        value=found.value,
        definition=wording.definition(metric, requirement, unit),
        reason=reason,
        band=_band(requirement, found.limits),
        violation=found.violation,
    )


def _after_expectation(found: Finding, requirement: Requirement) -> tuple[Status, str]:
    sentence = wording.as_sentence(found.reason, requirement)
    if not requirement.expect_fail:
        return found.status, sentence
    if found.status is Status.FAIL:
        return Status.PASS, f"{sentence} This miss is expected."
    if found.status is Status.PASS:
        return Status.FAIL, f"{sentence} A miss was expected: the expectation no longer holds."
    return found.status, f"{sentence} That is not the expected miss."


def _band(requirement: Requirement, limits: Limits | None) -> Band | None:
    if limits is None:
        return None
    return Band(
        signal=requirement.signal, low=limits.low, high=limits.high, start=limits.start, end=limits.end
    )


def _measure(trace: Trace, requirement: Requirement, metric: Metric) -> Finding:
    if trace.fault is not None:
        at = wording.seconds(trace.fault.tick / 1e9)
        return Finding(status=Status.FAULT, reason=f"the run ended at {at}: {trace.fault.reason}")
    cut = _cut(trace, requirement)
    if not cut.ticks.size:
        return _nothing_to_see(trace, cut)
    broken = np.flatnonzero(~np.isfinite(cut.values))
    if broken.size:
        at = wording.seconds(int(cut.ticks[broken[0]]) / 1e9)
        return Finding(status=Status.FAULT, reason=f"{requirement.signal} is not a finite number at {at}")
    return _compare(trace, requirement, metric, cut)


def _cut(trace: Trace, requirement: Requirement) -> Cut:
    start = round(requirement.arguments.get("from", 0.0) * 1e9)
    last = int(trace.ticks[-1]) if trace.ticks.size else 0
    to = requirement.arguments.get("to")
    end = last if to is None else round(to * 1e9)
    inside = (trace.ticks >= start) & (trace.ticks <= end)
    return Cut(ticks=trace.ticks[inside], values=trace[requirement.signal][inside], start=start, end=end)


def _nothing_to_see(trace: Trace, cut: Cut) -> Finding:
    last = int(trace.ticks[-1]) if trace.ticks.size else 0
    window = f"from {wording.seconds(cut.start / 1e9)} to {wording.seconds(max(cut.end, cut.start) / 1e9)}"
    if cut.start > last:
        reason = f"the trace ends at {wording.seconds(last / 1e9)}, before the window {window}"
        return Finding(status=Status.INCONCLUSIVE, reason=reason)
    return Finding(status=Status.UNTESTED, reason=f"no scan falls into the window {window}")


def _compare(trace: Trace, requirement: Requirement, metric: Metric, cut: Cut) -> Finding:
    value = metric.measure(cut.time, cut.values, requirement.arguments)
    if math.isnan(value):
        return Finding(status=Status.UNTESTED, reason=f"{requirement.signal} {metric.undefined}")
    bound = Bound(minimum=requirement.minimum, maximum=requirement.maximum)
    limits = metric.limits(bound, Window(float(cut.values[0]), cut.length), requirement.arguments)
    violation = None if limits is None else _first_outside(limits, cut)
    needed, last = _needed(bound, limits, value, cut), int(trace.ticks[-1])
    if needed > last and violation is None:
        status, reason = Status.INCONCLUSIVE, _ends_inside(requirement, last, needed)
    else:
        status = Status.PASS if needed <= last and bound.holds(value) else Status.FAIL
        reason = _words(trace, requirement, metric, cut, value)
        if violation is not None and violation[0] < violation[1]:
            first, until = (wording.seconds(each) for each in violation)
            reason += f", first violated from {first} to {until}"
    return Finding(
        status=status,
        reason=reason,
        value=None if math.isinf(value) else value,
        limits=_in_trace_time(limits, cut),
        violation=violation if status is Status.FAIL else None,
    )


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


def _first_outside(limits: Limits, cut: Cut) -> tuple[float, float] | None:
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
