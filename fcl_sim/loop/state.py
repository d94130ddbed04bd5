"""The state of a run between two scans: what must be saved so that it goes on as if nothing had been."""

from copy import deepcopy
from dataclasses import dataclass
from typing import Any

import numpy as np

from fcl_sim.loop.exact import exact_words
from fcl_sim.loop.layout import FINISHED, STAGES, STATES
from fcl_sim.loop.tape import Tape
from fcl_sim.loop.work import PROGRESS, SCAN, STATUS, Floats, Ints, rows_size


@dataclass(frozen=True, eq=False)
class RunState:
    """A run as it stands; a run changes it in place.

    `memory` and `x` are the tape's, `progress` and `rows` the integration's
    (`loop.work`): mode, armed events, next scan, next step. `own` is what each block
    in Python keeps, by the block's name.
    """

    memory: Floats
    x: Floats
    progress: Ints
    rows: Floats
    own: dict[str, dict[str, Any]]

    @property
    def scan(self) -> int:
        """Number of the next scan."""
        return int(self.progress[SCAN])

    @property
    def over(self) -> bool:
        """Whether the run ended early."""
        return bool(self.progress[STATUS] != FINISHED)

    def copy(self) -> "RunState":
        """Return a state that a run from this one leaves alone."""
        return RunState(
            self.memory.copy(), self.x.copy(), self.progress.copy(), self.rows.copy(), deepcopy(self.own)
        )


def initial_state(tape: Tape) -> RunState:
    """Return the state in which a run of a tape begins."""
    size = rows_size(int(tape.ints[STAGES]), int(tape.ints[STATES]))
    words, numbers = exact_words(tape.ints)
    return RunState(
        memory=tape.memory.copy(),
        x=tape.x.copy(),
        progress=np.zeros(PROGRESS + words, dtype=np.int64),
        rows=np.zeros(size + numbers),
        own={name: {} for name in tape.outside},
    )
