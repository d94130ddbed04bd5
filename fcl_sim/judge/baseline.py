"""What a run is held against besides its requirements: what it came to when somebody last accepted it."""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fcl_sim.judge.verdict import Status, Verdict
from fcl_sim.loop.trace import Values

DIGITS = 6
"""Significant digits of a reference figure; finer than their rounding it is not compared."""

NEVER = "never"
"""The figure of what is timed and does not happen."""


@dataclass(frozen=True, slots=True)
class Figure:
    """What a requirement measured: a number, or the `word` for why there is none: never, untested, ..."""

    value: float | None
    word: str = ""

    @classmethod
    def of(cls, verdict: Verdict) -> "Figure":
        """Return what a verdict measured."""
        if verdict.value is not None:
            return cls(verdict.value)
        timed = bool(verdict.requirement.metric) and verdict.measured in {Status.PASS, Status.FAIL}
        return cls(None, NEVER if timed else str(verdict.measured).lower())


@dataclass(frozen=True, slots=True, kw_only=True)
class MetricReference:
    """The figure of a requirement, in `unit`; `about` says of what, so that another under its id is told.

    `absolute`, in `unit`, and `relative`, a part of the figure, add up to what
    it may change by.
    """

    id: str
    about: str
    figure: Figure
    unit: str = ""
    absolute: float = 0.0
    relative: float = 0.0

    @property
    def allowed(self) -> float:
        """By how much the figure may change."""
        size = abs(self.figure.value or 0.0)
        rounding = 0.5 * 10.0 ** (1 - DIGITS)
        return self.absolute + (self.relative + rounding) * size


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SignalReference:
    """A signal as a line through a few of its samples: `ticks` (n,) in nanoseconds, rising; `values` (n,).

    Every sample that was left out is within `thinned` of the line. A run may
    differ from it by that, by `absolute`, all in `unit`, and by `relative`, a
    part of the value; and it may do what the reference does earlier by up to
    `leading` and later by up to `lagging`, in nanoseconds.
    """

    name: str
    unit: str
    ticks: NDArray[np.int64]
    values: Values
    thinned: float
    absolute: float
    relative: float = 0.0
    leading: int = 0
    lagging: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class RuleBaseReference:
    """The rule base of a fuzzy block in canonical FCL, and the arithmetic that it was computed in."""

    block: str
    arithmetic: str
    text: str = field(repr=False)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Baseline:
    """What one run came to when it was accepted: when, why, under which `setting`, a line for each fact.

    `left_out` says why no signals are kept, where none are. `file` is where it was read from.
    """

    scenario: str
    variant: str
    date: str
    reason: str
    setting: tuple[str, ...] = ()
    metrics: tuple[MetricReference, ...] = ()
    signals: tuple[SignalReference, ...] = ()
    left_out: str = ""
    rule_bases: tuple[RuleBaseReference, ...] = ()
    file: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class MetricChange:
    """A figure beside its reference; `status` is PASS, FAIL, or NO BASELINE where there is no reference.

    `old` is None where there is none, `new` where nothing asks for it any more.
    `allowed` is what it may change by, in `unit`.
    """

    id: str
    about: str
    unit: str
    status: Status
    old: Figure | None
    new: Figure | None
    allowed: float = 0.0

    @property
    def change(self) -> float | None:
        """The new figure less the old; None where one of them is no number."""
        old = None if self.old is None else self.old.value
        new = None if self.new is None else self.new.value
        return None if old is None or new is None else new - old


@dataclass(frozen=True, slots=True, kw_only=True)
class SignalChange:
    """A signal beside its reference; `status` as in `MetricChange`.

    Where it fails, `time` is the first scan, in seconds, at which it leaves
    `low` to `high`; `value` what it is there, `until` the last scan of that
    stretch. `farthest` is the largest distance from the allowed range in the
    run. `reason` says why nothing could be compared, where that is so.
    """

    name: str
    unit: str
    status: Status
    time: float = math.nan
    until: float = math.nan
    value: float = math.nan
    low: float = math.nan
    high: float = math.nan
    farthest: float = 0.0
    reason: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """A run beside its baseline; without one, `baseline` is None and the status NO BASELINE."""

    status: Status
    baseline: Baseline | None = None
    metrics: tuple[MetricChange, ...] = ()
    signals: tuple[SignalChange, ...] = ()
    remarks: tuple[str, ...] = ()

    @property
    def changed_metrics(self) -> tuple[MetricChange, ...]:
        """The figures that are beyond their tolerance or have no reference."""
        return tuple(each for each in self.metrics if each.status is not Status.PASS)

    @property
    def changed_signals(self) -> tuple[SignalChange, ...]:
        """The signals that are beyond their tolerance or have no reference, the first to leave it first."""
        changed = [each for each in self.signals if each.status is not Status.PASS]
        return tuple(sorted(changed, key=lambda each: (math.isnan(each.time), each.time)))


NO_BASELINE = Comparison(status=Status.NO_BASELINE)
"""What comes of a run that nobody has accepted yet."""
