"""The nouns of a plant file: what the plant has, each with unit, meaning and source."""

from dataclasses import dataclass
from enum import IntEnum

START = -1
"""The event number with which `transition` is called once, before a run, to choose the first mode."""


class Direction(IntEnum):
    """Which way an event's function crosses zero when the event occurs."""

    RISING = 1
    FALLING = -1


@dataclass(frozen=True, slots=True)
class State:
    """A state variable: x[i], i its place in the declaration.

    `start` is its value before a run. `scale` is a magnitude below which it
    counts as small: the integrator's error is bounded by rtol * (|x| + scale).
    """

    name: str
    unit: str
    start: float
    meaning: str
    scale: float = 1.0


@dataclass(frozen=True, slots=True)
class Input:
    """A manipulated or disturbing value: u[i], held between writes; `start` until the first.

    An `optional` one, such as the wind, may be left unconnected: it stays at
    `start`, and the loop has no signal of its name.
    """

    name: str
    unit: str
    meaning: str
    start: float = 0.0
    optional: bool = False


@dataclass(frozen=True, slots=True)
class Output:
    """What can be measured: y[i]."""

    name: str
    unit: str
    meaning: str


@dataclass(frozen=True, slots=True)
class Parameter:
    """A constant of a run: p[i]; `source` says where the default comes from, [A] if assumed.

    Values outside `minimum` to `maximum` are refused.
    """

    name: str
    unit: str
    default: float
    meaning: str
    source: str
    minimum: float | None = None
    maximum: float | None = None


@dataclass(frozen=True, slots=True)
class Mode:
    """A regime of the dynamics; its number is its place in the declaration."""

    name: str
    meaning: str


@dataclass(frozen=True, slots=True)
class Event:
    """A discontinuity: it occurs when g[i] leaves zero in its direction."""

    name: str
    direction: Direction
    meaning: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Plant:
    """Everything about a plant but its functions."""

    name: str
    title: str
    states: tuple[State, ...]
    inputs: tuple[Input, ...]
    outputs: tuple[Output, ...]
    parameters: tuple[Parameter, ...] = ()
    modes: tuple[Mode, ...] = (Mode("only", "the dynamics have one regime"),)
    events: tuple[Event, ...] = ()
