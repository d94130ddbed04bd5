"""What a metric is: a pure function of a signal, with its definition in words."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from fcl_sim.loop.trace import Values
from fcl_sim.units import Unit, parse_unit


class Kind(StrEnum):
    """What an argument is: a value of the signal, a difference of two, seconds, a list of them, a number."""

    SIGNAL = "signal"
    DIFFERENCE = "difference"
    TIME = "time"
    TIMES = "times"
    NUMBER = "number"


class Reads(StrEnum):
    """What a metric is taken of."""

    SIGNAL = "signal"
    UNDEFINED = "undefined"
    """1 where no rule was active for an output of a rule base, else 0."""


class Combined(StrEnum):
    """What becomes of a metric that is taken anew from each restart on."""

    WORST = "worst"
    SUM = "sum"


class Better(StrEnum):
    """Which way a metric improves."""

    LOWER = "lower"
    HIGHER = "higher"
    NEITHER = "neither"


@dataclass(frozen=True, slots=True)
class Argument:
    """An argument of a metric; without a `default` it must be given, unless it is `optional`.

    What an optional argument means when it is not given stands in its `meaning`.
    """

    name: str
    kind: Kind
    meaning: str
    default: float | None = None
    optional: bool = False

    @property
    def required(self) -> bool:
        """Whether a requirement must give it."""
        return self.default is None and not self.optional


WINDOW = (
    Argument("from", Kind.TIME, "start of the window, included", default=0.0),
    Argument("to", Kind.TIME, "end of the window, included; else the end of the trace", optional=True),
)
"""Every metric takes these."""

RESTART_AT = Argument(
    "restart_at", Kind.TIMES, "times at which it is taken anew; the worst counts, or the sum", optional=True
)
"""Every metric takes this, too: a list of times within the window, rising.

A piece ends just before the next restart: its last sample is held until there.
"""


@dataclass(frozen=True, slots=True)
class UnitRule:
    """A metric's unit, as powers of the signal's unit and of the second.

    With `apart` it is a difference of two values of the signal.
    """

    signal: int = 0
    time: int = 0
    apart: bool = False

    def unit(self, signal: Unit) -> Unit:
        """Return the unit of the metric for a signal in `signal`."""
        of = signal.difference if self.apart else signal
        return of**self.signal * parse_unit("s") ** self.time


@dataclass(frozen=True, slots=True, kw_only=True)
class Bound:
    """A bound on a metric, in its unit, either side None where it is free."""

    minimum: float | None = None
    maximum: float | None = None

    def holds(self, value: float) -> bool:
        """Return whether `value` lies within; NaN never does."""
        above = self.minimum is None or value >= self.minimum
        below = self.maximum is None or value <= self.maximum
        return above and below and value == value  # noqa: PLR0124  NaN differs from itself

    def margin(self, value: float) -> float:
        """Return how far `value` lies within, negative where it does not; inf where nothing is bound."""
        above = math.inf if self.minimum is None else value - self.minimum
        below = math.inf if self.maximum is None else self.maximum - value
        return min(above, below)


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """What a bound on a metric allows the signal, sample by sample.

    `low` and `high` in the unit of the signal, None where it is free, over
    `start` to `end`, both included, in seconds from the start of the window.
    """

    low: float | None = None
    high: float | None = None
    start: float
    end: float


@dataclass(frozen=True, slots=True)
class Window:
    """What `Metric.limits` is asked about: the signal's first value in the window, the window's length."""

    first: float
    length: float


Take = Callable[..., float]
"""`take(time, values, **arguments)`: `time` (n,) seconds from the start of the
window, rising; `values` (n,) the signal, finite; n ≥ 1. `inf`: what is timed
does not happen in the window. NaN: there is nothing to measure (`Metric.undefined`).
"""
LimitsOf = Callable[[Bound, Window, Mapping[str, float]], Limits | None]


def no_limits(_bound: Bound, _window: Window, _arguments: Mapping[str, float]) -> Limits | None:
    """Return None: a bound on this metric says nothing of a single sample."""
    return None


@dataclass(frozen=True, slots=True, kw_only=True)
class Metric:
    """A row of `METRICS`.

    `words` name it in a sentence; `definition` says exactly what is computed.
    `never` completes "SIGNAL does not …" where the number is infinite,
    `undefined` is the sentence after "SIGNAL" where it is NaN. `limits` gives
    what a bound means sample by sample, where it means that. Of the arguments
    `any_of` one at least must be given.
    """

    name: str
    take: Take
    words: str
    definition: str
    unit: UnitRule
    arguments: tuple[Argument, ...] = field(default=())
    better: Better = Better.LOWER
    never: str = ""
    undefined: str = ""
    limits: LimitsOf = no_limits
    reads: Reads = Reads.SIGNAL
    combined: Combined = Combined.WORST
    any_of: tuple[str, ...] = ()

    def measure(self, time: Values, values: Values, given: Mapping[str, float]) -> float:
        """Take the metric with the given arguments, the others at their defaults."""
        defaults = {each.name: each.default for each in self.arguments if each.default is not None}
        own = {each.name: given[each.name] for each in self.arguments if each.name in given}
        return float(self.take(time, values, **{**defaults, **own}))
