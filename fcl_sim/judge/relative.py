"""Two traces and a bound on a metric of one beside the other → finding."""

import math
from dataclasses import replace

from fcl_sim.judge import wording
from fcl_sim.judge.finding import Finding
from fcl_sim.judge.measure import measure
from fcl_sim.judge.metric import Bound, Metric
from fcl_sim.judge.verdict import Form, Relative, Requirement, Status
from fcl_sim.loop.trace import Trace
from fcl_sim.units import parse_unit


def compare(
    trace: Trace, other: Trace | None, requirement: Requirement, metric: Metric, relative: Relative
) -> Finding:
    """Return what a run came to beside the run `relative.variant`, whose trace is `other`.

    What cannot be measured there leaves the requirement UNTESTED.
    """
    run = f"the run `{relative.variant}`"
    if other is None:
        return Finding(status=Status.UNTESTED, reason=f"there is no trace of {run} to compare with")
    unit = metric.unit.unit(parse_unit(trace.units[requirement.signal])).symbol
    alone = replace(requirement, minimum=None, maximum=None, relative_to=None, unit=unit)
    here, there = (_figure(each, alone, metric) for each in (trace, other))
    if isinstance(here, Finding):
        return here
    if isinstance(there, Finding):
        status = Status.FAULT if there.status is Status.FAULT else Status.UNTESTED
        return Finding(status=status, reason=f"{run} gives nothing to compare with: {there.reason}")
    value = _related(here, there, relative.form)
    if math.isnan(value):
        told = "it is 0 there" if there == 0.0 else f"{requirement.signal} does not {metric.never} there"
        return Finding(status=Status.UNTESTED, reason=f"{run} gives nothing to compare with: {told}")
    holds = Bound(minimum=requirement.minimum, maximum=requirement.maximum).holds(value)
    return Finding(
        status=Status.PASS if holds else Status.FAIL,
        reason=_words(requirement, metric, relative, (here, there, value), unit),
        value=value if math.isfinite(value) else None,
    )


def _figure(trace: Trace, requirement: Requirement, metric: Metric) -> float | Finding:
    """Return the metric of a trace, inf where what is timed never happens; a Finding where there is none."""
    if trace.fault is not None:
        at = wording.seconds(trace.fault.tick / 1e9)
        return Finding(status=Status.FAULT, reason=f"it ended at {at}: {trace.fault.reason}")
    found = measure(trace, requirement, metric)
    if found.status is not Status.PASS:
        return found
    return math.inf if found.value is None else found.value


def _related(here: float, there: float, form: Form) -> float:
    if math.isinf(there):
        return math.nan
    if form is Form.DIFFERENCE:
        return here - there
    return here / there if there != 0.0 else math.nan


def _words(
    requirement: Requirement,
    metric: Metric,
    relative: Relative,
    figures: tuple[float, float, float],
    unit: str,
) -> str:
    here, there, value = figures
    beside = f"{wording.number(there, unit)} in the run `{relative.variant}`; {wording.bound(requirement)}"
    if math.isinf(here):
        return f"{requirement.signal} does not {metric.never}, and the {metric.words} is {beside}"
    limits = [each for each in (requirement.minimum, requirement.maximum) if each is not None]
    near = min(limits, key=lambda each: abs(each - value), default=None)
    shown = wording.number(value, requirement.unit, near)
    mine = f"the {metric.words} of {requirement.signal} is {wording.number(here, unit)}"
    if relative.form is Form.RATIO:
        return f"{mine}, {shown} times the {beside}"
    return f"{mine}, {shown} from the {beside}"
