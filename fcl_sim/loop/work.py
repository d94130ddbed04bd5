"""What the kernels of an integration hand to each other."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fcl_sim.jit import inlined
from fcl_sim.plant.functions import PlantFunction

Called = Callable[..., None]
"""A function of a plant that is called by an address (`loop.called`)."""

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]


class Plant(NamedTuple):
    """The plant's functions that an integration calls."""

    step: Called
    look: Called
    transition: PlantFunction


class Work(NamedTuple):
    """The tape, the state of an integration, and the arrays it works in.

    `ints` and `floats` are the tape (`loop.layout`). State: `x` (states,),
    `held` the plant's inputs as written, `p` its parameters, `progress` the
    words below, `rows` the step to try next and a table of derivatives. Arrays
    for the plant's functions to fill: `dx`, `trial` and `middle` (states,), `g0`,
    `g1` and `gm` (events,), the events' functions at the beginning, at the end
    and in the middle of a step. `at` is the address of `places`, where all
    that is for those that are called by an address.
    """

    ints: Ints
    floats: Floats
    x: Floats
    held: Floats
    p: Floats
    progress: Ints
    rows: Floats
    dx: Floats
    trial: Floats
    middle: Floats
    g0: Floats
    g1: Floats
    gm: Floats
    places: Ints
    at: int


MODE, ARMED, STATUS, INDEX, HAPPENED, SCAN, ROW, SAMPLES, STEPS, PROGRESS = range(10)
"""Words of `progress`, and their number.

Mode; a bit per event, set while it is armed; how the integration ended and of
what; events at one time, so far; the next scan; the row at which it goes on,
0 where it has not begun; samples recorded; steps of the integration. A linear
plant has further words behind them (`loop.exact`).
"""

GUESS, LAST_EVENT, BASE_AT = 0, 1, 4
"""Words of `rows`: the step to try next, and the time of the last event, in seconds; from BASE_AT on
rows of `states` numbers.

The first is the base, a point made ready but for its newest derivative; the
others are the derivatives of a step.
"""


@inlined
def row_of(derivative: int, states: int) -> int:
    """Return where in `rows` a derivative begins."""
    return BASE_AT + (1 + derivative) * states


@inlined
def errors_at(scheme: int, stages: int) -> int:
    """Return where in `floats` the weights of the error estimate begin, of the scheme that stands there."""
    return scheme + (stages + 1) + stages * (stages + 1) // 2


@inlined
def rows_size(stages: int, states: int) -> int:
    """Return the number of words of `rows`."""
    return row_of(stages + 1, states)


AT_INTS, AT_FLOATS, AT_ROWS, AT_HELD, AT_P, P_SIZE, AT_Y, AT_X, AT_G, PLACES = 0, 1, 2, 3, 4, 5, 6, 7, 10, 13
"""Words of `places`, and their number.

Addresses of the tape, of `rows`, of what the plant is given; the number of its
parameters; the address of its outputs; those of `x`, `trial`, `middle`; of
`g0`, `g1`, `gm`.
"""
