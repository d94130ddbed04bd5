"""What is asked of a run, and what came of it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from fractions import Fraction
from math import ceil

from fcl_sim.diagnostics import Span
from fcl_sim.judge.temporal.formula import Formula


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


class Form(StrEnum):
    """How a figure is compared with that of another run."""

    RATIO = "ratio"
    DIFFERENCE = "difference"


class Over(StrEnum):
    """What a requirement is held to: the run itself, every point of its envelope, or both."""

    BOTH = "both"
    NOMINAL = "nominal"
    POINTS = "points"
    MEAN = "mean"
    """The mean of the figure over the points, instead of each."""


@dataclass(frozen=True, slots=True)
class AtLeast:
    """At how many points of an envelope a requirement must hold: a `count`, or a `share` from 0 to 1."""

    count: int | None = None
    share: Fraction = Fraction(1)

    def of(self, points: int) -> int:
        """Return how many of so many points that is, all of them at most."""
        return ceil(self.share * points) if self.count is None else min(self.count, points)


@dataclass(frozen=True, slots=True)
class Relative:
    """A bound is on the ratio to, or the difference from, the figure of the run `variant`."""

    variant: str
    form: Form


@dataclass(frozen=True, slots=True, kw_only=True)
class Corridor:
    """Limits of a signal over time, of the table called `name`.

    `ticks` rise, in nanoseconds; `low` and `high`, one for each, are in the unit
    of the signal, NaN where there is no edge.
    """

    name: str
    signal: str
    ticks: tuple[int, ...]
    low: tuple[float, ...]
    high: tuple[float, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Requirement:
    """A bound on a metric of the trace, a formula that holds, or a corridor that is kept.

    `metric` names a row of `judge.metrics.METRICS`, `signal` the signal it is
    taken of, `arguments` its further arguments as numbers in the unit of the
    signal, or seconds; `restart_at` the times, in seconds, at which it is taken
    anew. `minimum` and `maximum` are in `unit`, the metric's, or of what
    `relative_to` makes of it. With a `formula` or a `corridor` these are empty,
    and `unit` is that of its margin.
    `expect_fail` says that the run is meant to miss it; the text says why.
    `over` and `at_least` say how it is held to an envelope.
    `span` is where its id stands, `asked` where its bounds, formula or corridor do.
    """

    id: str
    text: str
    metric: str = ""
    signal: str = ""
    formula: Formula | None = None
    corridor: Corridor | None = None
    arguments: Mapping[str, float] = field(default_factory=dict)
    restart_at: tuple[float, ...] = ()
    relative_to: Relative | None = None
    minimum: float | None = None
    maximum: float | None = None
    unit: str = ""
    expect_fail: bool = False
    over: Over = Over.BOTH
    at_least: AtLeast = AtLeast()
    span: Span | None = field(default=None, compare=False, repr=False)
    asked: tuple[Span, ...] = field(default=(), compare=False, repr=False)

    @property
    def signals(self) -> tuple[str, ...]:
        """The signals that it is about, each once."""
        if self.corridor is not None:
            return (self.corridor.signal,)
        return (self.signal,) if self.formula is None else self.formula.signals


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
    requirement's unit, None where it could not be taken; of a formula it is the
    robustness. `definition` is the metric in words, or the formula, `reason`
    one sentence for a reader.
    `violation` is what is first violated, from when to when in seconds; `blamed`
    are, of a formula, the signals that violate it there.
    """

    requirement: Requirement
    status: Status
    measured: Status
    value: float | None
    definition: str
    reason: str
    band: Band | None = None
    violation: tuple[float, float] | None = None
    blamed: tuple[str, ...] = ()
