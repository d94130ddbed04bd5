"""Findings at the points of an envelope → one verdict on each requirement: n of N, worst where."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from fcl_sim.judge import wording
from fcl_sim.judge.judge import after_expectation
from fcl_sim.judge.metric import Better, Bound
from fcl_sim.judge.metrics import METRICS
from fcl_sim.judge.verdict import Over, Requirement, Status, Verdict
from fcl_sim.loop.trace import Values

ORDER = list(Status)


@dataclass(frozen=True, slots=True)
class AtPoint:
    """What is kept of a requirement's Verdict at one point; `value` NaN where there is none."""

    status: Status
    measured: Status
    value: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EnvelopeVerdict:
    """A requirement, judged over the N points of an envelope.

    At `passed` of them it came out as it should, `expect` included; `needed` must.
    Of a mean they count the points that have a figure.
    `values` (N,) are the figures in the requirement's unit, NaN where there is
    none, `statuses` the N verdicts, in the order of the points. `worst` is the
    point with the gravest verdict, among those of one verdict that with the
    least margin; None where no figure tells. `value` is the figure there, or
    that of the mean; `definition` and `reason` are as in a Verdict.
    """

    requirement: Requirement
    status: Status
    measured: Status
    passed: int
    needed: int
    worst: int | None
    value: float | None
    values: Values
    statuses: tuple[Status, ...]
    definition: str
    reason: str

    @property
    def points(self) -> int:
        """How many points there are: N."""
        return len(self.statuses)


def at_points(requirement: Requirement) -> Requirement:
    """Return what is asked at each point: of a mean, the figure alone."""
    if requirement.over is not Over.MEAN:
        return requirement
    return replace(requirement, minimum=None, maximum=None, expect_fail=False)


def kept(verdict: Verdict) -> AtPoint:
    """Return what is kept of a verdict at a point."""
    return AtPoint(verdict.status, verdict.measured, math.nan if verdict.value is None else verdict.value)


def judge_envelope(
    requirement: Requirement, found: Sequence[AtPoint], definition: str, told: Callable[[int], str]
) -> EnvelopeVerdict:
    """Return what a requirement came to over one point or more; `told` says where a point lies."""
    values = np.array([each.value for each in found])
    statuses = tuple(each.status for each in found)
    if requirement.over is Over.MEAN:
        return _mean(requirement, found, values, definition, told)
    passed, needed = statuses.count(Status.PASS), requirement.at_least.of(len(found))
    best_first = sorted(statuses, key=ORDER.index, reverse=True)
    status = best_first[needed - 1]
    worst = _worst(requirement, found)
    return EnvelopeVerdict(
        requirement=requirement,
        status=status,
        measured=status,
        passed=passed,
        needed=needed,
        worst=worst,
        value=None if worst is None or math.isnan(values[worst]) else float(values[worst]),
        values=values,
        statuses=statuses,
        definition=definition,
        reason=_reason(requirement, passed, len(found), needed) + _where(requirement, found, worst, told),
    )


def _worst(requirement: Requirement, found: Sequence[AtPoint]) -> int | None:
    ranks = [(ORDER.index(each.status), margin(requirement, each)) for each in found]
    index = min(range(len(found)), key=ranks.__getitem__)
    plain = found[index].status is Status.PASS and math.isinf(ranks[index][1])
    return None if plain and all(math.isnan(each.value) for each in found) else index


def margin(requirement: Requirement, at: AtPoint) -> float:
    """Return how far a figure is from where the requirement would come out otherwise than it should.

    Negative where it already does. Of what never happens it is infinite.
    """
    if math.isnan(at.value):
        within = math.inf if at.measured is Status.PASS else -math.inf
    elif requirement.formula is not None or requirement.corridor is not None:
        within = at.value
    else:
        within = Bound(minimum=requirement.minimum, maximum=requirement.maximum).margin(at.value)
    return -within if requirement.expect_fail else within


def _reason(requirement: Requirement, passed: int, points: int, needed: int) -> str:
    missed = "miss it, as expected" if requirement.expect_fail else "meet it"
    least = "" if needed == points else f"; at least {needed} must"
    return f"{passed} of {points} points {missed}{least}"


def _where(
    requirement: Requirement, found: Sequence[AtPoint], worst: int | None, told: Callable[[int], str]
) -> str:
    if worst is None:
        return "."
    at, where = found[worst], f"worst at {told(worst)}"
    if math.isnan(at.value):
        return f"; {where}: {without_figure(requirement, at.status)}."
    return f"; {where}: {shown(requirement, at.value)}."


def without_figure(requirement: Requirement, status: Status) -> str:
    """Return what came of a requirement at a point that has no figure."""
    metric = METRICS.get(requirement.metric)
    if metric is not None and metric.never and status in {Status.PASS, Status.FAIL}:
        return f"does not {metric.never}"
    if status not in {Status.PASS, Status.FAIL}:
        return str(status)
    return "met" if (status is Status.PASS) != requirement.expect_fail else "missed"


def shown(requirement: Requirement, value: float) -> str:
    """Return a figure to as many digits as tell it from its bound."""
    bounds = [each for each in (requirement.minimum, requirement.maximum) if each is not None]
    near = min(bounds, key=lambda each: abs(each - value), default=None)
    return wording.number(value, requirement.unit, near)


def _mean(
    requirement: Requirement,
    found: Sequence[AtPoint],
    values: Values,
    definition: str,
    told: Callable[[int], str],
) -> EnvelopeVerdict:
    """Return the verdict on a mean; where one point has no figure there is none."""
    gravest = min(range(len(found)), key=lambda index: ORDER.index(found[index].status))
    worst, value = gravest, None
    measured, sentence = (
        found[gravest].status,
        f"there is no mean: {found[gravest].status} at {told(gravest)}",
    )
    if measured is Status.PASS and np.isnan(values).any():
        worst = int(np.argmax(np.isnan(values)))
        measured = Status.UNTESTED if requirement.maximum is None else Status.FAIL
        never = METRICS[requirement.metric].never
        sentence = f"there is no mean: {requirement.signal} does not {never} at {told(worst)}"
    elif measured is Status.PASS:
        value, worst = float(values.mean()), _extreme(requirement, values)
        bound = Bound(minimum=requirement.minimum, maximum=requirement.maximum)
        measured = Status.PASS if bound.holds(value) else Status.FAIL
        sentence = (
            f"the mean over {len(found)} points is {shown(requirement, value)}; {wording.bound(requirement)}"
        )
    status, reason = after_expectation(measured, sentence, requirement)
    return EnvelopeVerdict(
        requirement=requirement,
        status=status,
        measured=measured,
        passed=int(np.isfinite(values).sum()),
        needed=len(found),
        worst=worst,
        value=value,
        values=values,
        statuses=tuple(each.status for each in found),
        definition=f"mean over the points of: {definition}",
        reason=reason,
    )


def _extreme(requirement: Requirement, values: Values) -> int:
    """Return the point whose figure takes the mean furthest towards its bound."""
    upwards = requirement.maximum is not None or METRICS[requirement.metric].better is Better.LOWER
    return int(np.argmax(values) if upwards else np.argmin(values))
