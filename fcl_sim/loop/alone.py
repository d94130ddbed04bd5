"""A fuzzy block alone, in LREAL or REAL, called by the very function that a loop calls it with.

What a run has computed is computed again so, to the last bit, and nothing more
is compiled than what the run needed.
"""

from collections.abc import Sequence

import numpy as np

from fcl_sim.engine.program import Program
from fcl_sim.jit import F4, FF, F, I, entry, signature, u, void
from fcl_sim.loop.blocks.fuzzy import FUZZY_TYPE, Fuzzy, Singles, fuzzy_for
from fcl_sim.loop.layout import FIRST_INPUT
from fcl_sim.loop.trace import Values
from fcl_sim.loop.work import Floats, Ints

HEAD, RECORDED, IS_REAL = range(3)
"""Words of a layout: where the head begins, how many words it has, whether instances are in binary32."""


@entry(signature(void, FUZZY_TYPE, I, F, F, F4, F4, FF, FF, I, I, I, FF))
def evaluate_points(
    run: Fuzzy,
    ints: Ints,
    floats: Floats,
    memory: Floats,
    constants: Singles,
    singles: Singles,
    inputs: Values,
    previous: Values,
    kept: Ints,
    words: Ints,
    layout: Ints,
    found: Values,
) -> None:
    """Call the block of a row at every point: `inputs` (n, inputs) → `found` (n, recorded + words).

    Before each, the words `kept` (m,) are set to those of `previous` (n, m).
    """
    recorded, is_real = layout[RECORDED], layout[IS_REAL] != 0
    for row in range(inputs.shape[0]):
        for place in range(inputs.shape[1]):
            memory[u(place)] = inputs[u(row), u(place)]
        for place in range(kept.size):
            if is_real:
                singles[u(kept[u(place)])] = previous[u(row), u(place)]
            else:
                memory[u(kept[u(place)])] = previous[u(row), u(place)]
        run(ints, floats, memory, constants, singles, 0)
        for place in range(recorded):
            found[u(row), u(place)] = memory[u(layout[HEAD] + place)]
        for place in range(words.size):
            word = words[u(place)]
            found[u(row), u(recorded + place)] = singles[u(word)] if is_real else memory[u(word)]


class Alone:
    """One row of a tape, with its program and its memory, which begins at the initial state."""

    def __init__(self, program: Program) -> None:
        count = len(program.input_names)
        head = count + 1  # behind the inputs, and the slot that is not finite where one is beyond REAL
        signs = [1.0] * count
        at = FIRST_INPUT + count + 3
        real = program.arithmetic == "REAL"
        self._head, self._recorded, self._is_real = head, program.recorded, real
        constants = np.asarray(program.floats)
        self._floats = np.zeros(count + constants.size)
        self._floats[:count] = signs
        self._memory = np.zeros(head + program.recorded + program.size)
        self._memory[head : head + program.recorded] = program.initial[: program.recorded]
        if real:
            first, own = 2 * count, 2 * (head + program.recorded)
            self._floats.view(np.float32)[first : first + constants.size] = constants
            self._memory.view(np.float32)[own : own + program.size] = program.initial
            self._words_at = own
        else:
            first, own = count, -1
            self._floats[first:] = constants
            self._memory[head : head + program.size] = program.initial
            self._words_at = head
        row = [0, at, count, head, 0, count, *range(count), at, own, count]
        self._ints = np.array([*row, *program.placed(first)], np.int64)
        self._outputs = slice(program.outputs_at, program.active_at)
        long, short = fuzzy_for({(program.arithmetic, program.form)})
        self._run = (short if real else long).compile()
        self._views = (self._floats.view(np.float32), self._memory.view(np.float32))

    def evaluate(self, inputs: Values, previous: Values | None = None, words: Sequence[int] = ()) -> Values:
        """Return what a trace records of each of n points, (n, recorded + words).

        `inputs` (n, inputs) are finite. NC keeps `previous` (n, outputs), else
        what the point before has left, at first the initial values. `words` are
        further words (m) of the program to return. A point that REAL cannot
        hold gives NaN.
        """
        kept = self._words_at + np.arange(self._outputs.start, self._outputs.stop)
        found = np.empty((len(inputs), self._recorded + len(words)))
        evaluate_points(
            self._run,
            *(self._ints, self._floats, self._memory, *self._views),
            np.ascontiguousarray(inputs, np.float64),
            np.empty((0, 0)) if previous is None else np.ascontiguousarray(previous, np.float64),
            kept if previous is not None else np.empty(0, np.int64),
            self._words_at + np.array(words, np.int64),
            np.array([self._head, self._recorded, self._is_real], np.int64),
            found,
        )
        return found
