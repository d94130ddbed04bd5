"""What is asked of a run, and what came of it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from fcl_sim.diagnostics import Span


class Status(StrEnum):
    """Verdicts in order of gravity; only PASS is green."""

    FAULT = "FAULT"
    FAIL = "FAIL"
    INCONCLUSIVE = "INCONCLUSIVE"
    UNTESTED = "UNTESTED"
    NO_BASELINE = "NO BASELINE"
    PASS = "PASS"  # noqa: S105  a verdict, not a secret


def worst(statuses: list[Status]) -> Status:
    """Return the gravest of the statuses; UNTESTED where there is none."""
    order = list(Status)
    return min(statuses, key=order.index) if statuses else Status.UNTESTED


@dataclass(frozen=True, slots=True, kw_only=True)
class Requirement:
    """A bound on a metric of the trace.

    `metric` names a row of `judge.metrics.METRICS`, `signal` the signal it is
    taken of, `arguments` its further arguments as numbers in the unit of the
    signal, or seconds. `minimum` and `maximum` are in `unit`, the metric's.
    `expect_fail` says that the run is meant to miss it; the text says why.
    """

    id: str
    text: str
    metric: str
    signal: str
    arguments: Mapping[str, float] = field(default_factory=dict)
    minimum: float | None = None
    maximum: float | None = None
    unit: str = ""
    expect_fail: bool = False
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Band:
    """What a time plot draws for a requirement: limits of a signal over an interval, in seconds."""

    signal: str
    low: float | None
    high: float | None
    start: float
    end: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Verdict:
    """A requirement, judged.

    `measured` is what the run came to, `status` the verdict after `expect_fail`:
    an expected FAIL is a PASS, an unexpected PASS a FAIL. `value` is in the
    requirement's unit, None where it could not be taken. `definition` is the
    metric in words, `reason` one sentence for a reader.
    """

    requirement: Requirement
    status: Status
    measured: Status
    value: float | None
    definition: str
    reason: str
    band: Band | None = None
    violation: tuple[float, float] | None = None
