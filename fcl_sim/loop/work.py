"""The buffers in which an integration works, and the words in them.

`ints` and `floats` are the tape (`loop.layout`), x (states,) the state, `held`
the plant's inputs as written, p its parameters. Arrays for the plant's
functions to fill: `dx` and `trial` (states,), `g0` and `g1` (events,), the
events' functions at the beginning and at the end of a step. They are handed on
one by one: taken out of a tuple, each would be counted in and out at every call.
"""

import numpy as np
from numpy.typing import NDArray

from fcl_sim.jit import inlined

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]

MODE, ARMED, STATUS, INDEX, HAPPENED, PROGRESS = range(6)
"""Words of `progress`, and their number.

Mode; a bit per event, set while it is armed; how the integration ended and of
what; events since the last write.
"""

GUESS, ROWS_AT = 0, 4
"""Words of `work`: the step to try next in seconds; from ROWS_AT on rows of `states` numbers."""
BASE = 0
"""The row in which a point is made ready but for its newest derivative; row 1 + j is derivative j."""


@inlined
def row_of(derivative: int, states: int) -> int:
    """Return where in `work` a derivative begins."""
    return ROWS_AT + (1 + derivative) * states


@inlined
def work_size(stages: int, states: int) -> int:
    """Return the number of words of `work`."""
    return ROWS_AT + (2 + stages) * states
