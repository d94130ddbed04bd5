"""A fuzzy block alone, in LREAL or REAL, called by the very function that a loop calls it with.

What a run has computed is computed again so, to the last bit, and nothing more
is compiled than what the run needed.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fcl_sim.engine.program import Program
from fcl_sim.loop.blocks.fuzzy import fuzzy_for
from fcl_sim.loop.layout import FIRST_INPUT
from fcl_sim.loop.trace import Values


class Alone:
    """One row of a tape, with its program and its memory, which begins at the initial state."""

    def __init__(self, program: Program) -> None:
        count = len(program.input_names)
        head = count + 1  # behind the inputs, and the slot that is not finite where one is beyond REAL
        signs = [1.0] * count
        at = FIRST_INPUT + count + 3
        real = program.arithmetic == "REAL"
        self._head = slice(head, head + program.recorded)
        constants = np.asarray(program.floats)
        self._floats = np.zeros(count + constants.size)
        self._floats[:count] = signs
        self._memory = np.zeros(head + program.recorded + program.size)
        self._memory[self._head] = program.initial[: program.recorded]
        if real:
            first, own = 2 * count, 2 * (head + program.recorded)
            self._floats.view(np.float32)[first : first + constants.size] = constants
            self._words: NDArray[Any] = self._memory.view(np.float32)[own : own + program.size]
        else:
            first, own = count, -1
            self._floats[first:] = constants
            self._words = self._memory[head : head + program.size]
        self._words[:] = program.initial
        row = [0, at, count, head, 0, count, *range(count), at, own, count]
        self._ints = np.array([*row, *program.placed(first)], np.int64)
        self._inputs = self._memory[:count]
        self._outputs = self._words[program.outputs_at : program.active_at]
        long, short = fuzzy_for({(program.arithmetic, program.curved)})
        self._run = (short if real else long).compile()
        self._views = (self._floats.view(np.float32), self._memory.view(np.float32))

    def evaluate(self, inputs: Values, previous: Values | None = None, words: Sequence[int] = ()) -> Values:
        """Return what a trace records of each of n points, (n, recorded + words).

        `inputs` (n, inputs) are finite. NC keeps `previous` (n, outputs), else
        what the point before has left, at first the initial values. `words` are
        further words (m) of the program to return. A point that REAL cannot
        hold gives NaN.
        """
        head, own = self._memory[self._head], list(words)
        found = np.empty((len(inputs), head.size + len(own)))
        run, buffers = self._run, (self._ints, self._floats, self._memory, *self._views, 0)
        for row, point in enumerate(inputs):
            self._inputs[:] = point
            if previous is not None:
                self._outputs[:] = previous[row]
            run(*buffers)
            found[row, : head.size] = head
            if own:
                found[row, head.size :] = self._words[own]
        return found
