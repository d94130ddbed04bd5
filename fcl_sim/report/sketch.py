"""What a plant is sketched with: pieces in metres, some of which a plant's signals move, fill or colour.

A sketch is data, so that paper and page draw the same: a piece is placed by the
motions of the groups around it, and coloured by its tint or its paint.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from fcl_sim.loop.trace import Trace, Values

Point = tuple[float, float]

Role = Literal["ground", "body", "load", "line", "fluid", "mark"]
"""What a piece is: what stands still, what moves, what is carried, a rope or a pipe, a liquid, a mark."""


@dataclass(frozen=True, slots=True)
class Motion:
    """A signal of the plant by its whole name, times `factor`."""

    signal: str
    factor: float = 1.0

    @property
    def signals(self) -> tuple[str, ...]:
        """The signals that it is made of."""
        return (self.signal,)

    def at(self, trace: Trace, sample: int) -> float:
        """Return its value at a sample of a trace."""
        return self.factor * float(trace[self.signal][sample])


@dataclass(frozen=True, slots=True)
class Delayed:
    """What a signal was when `amount` less of `flow`, an amount per second, had gone by: a plug flow."""

    signal: str
    flow: str
    amount: float

    @property
    def signals(self) -> tuple[str, ...]:
        """The signals that it is made of."""
        return (self.signal, self.flow)

    def at(self, trace: Trace, sample: int) -> float:
        """Return its value at a sample of a trace; the signal's first one where that had not begun."""
        gone = _sum(trace.time, trace[self.flow])
        return float(np.interp(gone[sample] - self.amount, gone, trace[self.signal]))


def _sum(time: Values, flow: Values) -> Values:
    """Return what has gone by (n,) at every sample."""
    return np.concatenate([[0.0], np.cumsum(np.diff(time) * 0.5 * (flow[1:] + flow[:-1]))])


Amount = Motion | Delayed


@dataclass(frozen=True, slots=True)
class Tint:
    """A colour that goes from cold to hot as a value goes from `low` to `high`."""

    value: Amount
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Paint:
    """A colour of sRGB whose parts, 0 to 255, are signals of the plant."""

    red: Motion
    green: Motion
    blue: Motion

    @property
    def parts(self) -> tuple[Motion, ...]:
        """Red, green and blue."""
        return (self.red, self.green, self.blue)


@dataclass(frozen=True, slots=True)
class Piece:
    """A line through points, in metres, y upwards; closed, it is filled."""

    points: tuple[Point, ...]
    role: Role
    closed: bool = True
    colour: Tint | Paint | None = None


@dataclass(frozen=True, slots=True)
class Reading:
    """The value of a signal, behind a word, as a text about a point; `on` a colour it stays dark."""

    at: Point
    signal: str
    word: str = ""
    on: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Group:
    """Parts that move together: raised (grown upwards alone), grown, turned, moved across and to a place.

    All but the last are about the group's own origin, which comes to stand `at`
    the place. Angles are in degrees, anticlockwise.
    """

    parts: tuple["Piece | Group", ...]
    across: Motion | None = None
    turn: Motion | None = None
    grow: Motion | None = None
    rise: Motion | None = None
    at: Point = (0.0, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Sketch:
    """A plant: its pieces, the corners of what is shown, in metres, and in words what is drawn.

    `readings` stand over the pieces. Where lengths are not those of the plant,
    `has_scale` is false.
    """

    group: Group
    low: Point
    high: Point
    about: str
    readings: tuple[Reading, ...] = ()
    has_scale: bool = True
