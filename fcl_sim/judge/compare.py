"""Trace, verdicts and baseline → comparison: which figure and which signal left its tolerance, and where."""

from collections.abc import Iterator, Sequence

import numpy as np

from fcl_sim.judge.baseline import (
    NO_BASELINE,
    Baseline,
    Comparison,
    Figure,
    MetricChange,
    MetricReference,
    SignalChange,
    SignalReference,
)
from fcl_sim.judge.tube import tube
from fcl_sim.judge.verdict import Requirement, Status, Verdict, worst
from fcl_sim.loop.trace import Trace
from fcl_sim.units import Quantity, parse_unit

ROUNDING = 1e-12
"""What computing the edge of a tolerance may be off by, as a part of the numbers in it."""


def compare(
    trace: Trace, verdicts: Sequence[Verdict], baseline: Baseline | None, asked: Sequence[str] = ()
) -> Comparison:
    """Return how a run differs from its baseline.

    `asked` are the signals that a baseline of the run is told to keep: one that
    it lacks is NO BASELINE. A run that broke down is a FAULT, whatever it was.
    """
    if baseline is None:
        return NO_BASELINE
    metrics = tuple(_metrics(verdicts, baseline.metrics))
    signals = tuple(_signals(trace, baseline, asked))
    statuses = [each.status for each in metrics] + [each.status for each in signals]
    if trace.fault is not None:
        statuses.append(Status.FAULT)
    return Comparison(
        status=worst([*statuses, Status.PASS]), baseline=baseline, metrics=metrics, signals=signals
    )


def about(requirement: Requirement) -> str:
    """Return what a requirement measures, in one line that a baseline keeps."""
    if requirement.formula is not None:
        return f"robustness of {requirement.formula}"
    if requirement.corridor is not None:
        return f"margin of {requirement.corridor.signal} in {requirement.corridor.name}"
    if requirement.relative_to is None:
        return f"{requirement.metric} of {requirement.signal}"
    beside = requirement.relative_to
    return f"{requirement.metric} of {requirement.signal}, {beside.form} to {beside.variant}"


def _metrics(verdicts: Sequence[Verdict], references: Sequence[MetricReference]) -> Iterator[MetricChange]:
    known = {each.id: each for each in references}
    for verdict in verdicts:
        asked = verdict.requirement
        yield _metric(asked, Figure.of(verdict), known.pop(asked.id, None))
    for each in known.values():
        yield MetricChange(
            id=each.id, about=each.about, unit=each.unit, status=Status.FAIL, old=each.figure, new=None
        )


def _metric(asked: Requirement, new: Figure, reference: MetricReference | None) -> MetricChange:
    if reference is None or reference.about != about(asked):
        return MetricChange(
            id=asked.id, about=about(asked), unit=asked.unit, status=Status.NO_BASELINE, old=None, new=new
        )
    old, allowed = _in_unit(reference, asked.unit)
    if old is None:
        return MetricChange(
            id=asked.id, about=about(asked), unit=asked.unit, status=Status.NO_BASELINE, old=None, new=new
        )
    return MetricChange(
        id=asked.id,
        about=reference.about,
        unit=asked.unit,
        status=Status.PASS if _within(old, new, allowed) else Status.FAIL,
        old=old,
        new=new,
        allowed=allowed,
    )


def _in_unit(reference: MetricReference, unit: str) -> tuple[Figure | None, float]:
    """Return a reference figure and what it may change by in another unit; None where it does not convert."""
    old = reference.figure
    if old.value is None:
        return old, 0.0
    mine, theirs = parse_unit(unit), parse_unit(reference.unit)
    if unit != reference.unit and mine.same_as(theirs.difference):
        theirs = mine  # a margin that was kept in degC
    if not mine.commensurate(theirs):
        return None, 0.0
    return Figure(Quantity(old.value, theirs).to(mine)), Quantity(reference.allowed, theirs).to(mine)


def _within(old: Figure, new: Figure, allowed: float) -> bool:
    if old.value is None or new.value is None:
        return old == new
    edge = allowed + ROUNDING * (abs(old.value) + abs(new.value))
    return abs(new.value - old.value) <= edge


def _signals(trace: Trace, baseline: Baseline, asked: Sequence[str]) -> Iterator[SignalChange]:
    for reference in baseline.signals:
        yield _signal(trace, reference)
    kept = {each.name for each in baseline.signals}
    for name in asked:
        if name not in kept:
            yield SignalChange(
                name=name,
                unit=trace.units[name],
                status=Status.NO_BASELINE,
                reason="the baseline does not have it",
            )


def _signal(trace: Trace, reference: SignalReference) -> SignalChange:
    name = reference.name
    if name not in trace:
        return _not_compared(reference, reference.unit, "the run does not have it")
    mine, theirs = parse_unit(trace.units[name]), parse_unit(reference.unit)
    if not mine.commensurate(theirs):
        return _not_compared(reference, trace.units[name], f"the reference is in {theirs}, the run in {mine}")
    if not trace.ticks.size or not reference.ticks.size:
        return _not_compared(reference, trace.units[name], "there are no samples to compare")
    scale = Quantity(1.0, mine).to(theirs)
    inside = trace.ticks <= reference.ticks[-1]
    ticks, values = trace.ticks[inside], trace[name][inside] * scale
    low, high = tube(reference, ticks)
    edge = ROUNDING * (np.abs(low) + np.abs(high))
    outside = ~((values >= low - edge) & (values <= high + edge))  # NaN is outside
    if not outside.any():
        return _ends(trace, reference)
    first = int(np.argmax(outside))
    stretch = outside[first:]
    last = first + (len(stretch) if stretch.all() else int(np.argmin(stretch))) - 1
    beyond = np.fmax(low - values, values - high)
    return SignalChange(
        name=name,
        unit=trace.units[name],
        status=Status.FAIL,
        time=float(ticks[first]) / 1e9,
        until=float(ticks[last]) / 1e9,
        value=float(values[first]) / scale,
        low=float(low[first]) / scale,
        high=float(high[first]) / scale,
        farthest=float(np.fmax.reduce(beyond, initial=0.0)) / scale,
    )


def _ends(trace: Trace, reference: SignalReference) -> SignalChange:
    """Return PASS where the run covers the reference and no more, else what is not compared."""
    unit, name = trace.units[reference.name], reference.name
    mine, theirs = int(trace.ticks[-1]), int(reference.ticks[-1])
    if mine == theirs:
        return SignalChange(name=name, unit=unit, status=Status.PASS)
    if mine < theirs:
        return _not_compared(
            reference, unit, f"the run ends at {mine / 1e9:g} s, its reference at {theirs / 1e9:g} s"
        )
    return SignalChange(
        name=name, unit=unit, status=Status.NO_BASELINE, reason=f"the reference ends at {theirs / 1e9:g} s"
    )


def _not_compared(reference: SignalReference, unit: str, reason: str) -> SignalChange:
    return SignalChange(name=reference.name, unit=unit, status=Status.FAIL, reason=reason)
