"""Blocks of the library wired together, in INT: what is run, and in what order.

A network is one integer buffer of steps and one of memory. A step runs one
block: its opcode (`concept.execute.TABLE`), where its inputs begin in memory,
how many of them carry the stem, where its outputs begin, the number of its
wires; then the wires, each as the word that it reads and the word it writes.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from fcl_sim.arithmetic.integer import fits_int
from fcl_sim.concept.declaration import Ints
from fcl_sim.concept.events import NOTHING, OVERFLOWN
from fcl_sim.concept.execute import run_int
from fcl_sim.jit import I, entry, i8, kernel, signature, u

OPCODE, INPUTS, COUNT, OUTPUTS, WIRES, HEAD = range(6)


@dataclass(frozen=True, kw_only=True, eq=False)
class Network:
    """Wired blocks. `memory` is what they begin with; `names` say what each step does.

    `inputs`, `outputs` and `degrees` say in which word a variable, or the
    degree of a rule, is; `shares` in which words the accumulated degrees of an
    output's terms are; letter case as declared.
    """

    steps: Ints
    memory: Ints
    names: tuple[str, ...]
    inputs: Mapping[str, int]
    outputs: Mapping[str, int]
    degrees: Mapping[str, int]
    shares: Mapping[str, Sequence[int]]


@kernel
def run_steps(steps: Ints, memory: Ints, rounding: int) -> int:
    """Run all steps; return 0, or for the first that reports an error 8 times its number plus the event."""
    at = number = 0
    while at < steps.size:
        wire = at + HEAD
        for _ in range(steps[u(at + WIRES)]):
            memory[u(steps[u(wire + 1)])] = memory[u(steps[u(wire)])]
            wire += 2
        outputs = memory[steps[u(at + OUTPUTS)] :]
        event = run_int(
            steps[u(at + OPCODE)], memory[steps[u(at + INPUTS)] :], steps[u(at + COUNT)], outputs, rounding
        )
        if event == NOTHING and not fits_int(outputs[u(0)]):
            event = OVERFLOWN
        if event > NOTHING:
            return 8 * number + event
        at = wire
        number += 1
    return NOTHING


@entry(signature(i8, I, I, i8))
def run_once(steps: Ints, memory: Ints, rounding: int) -> int:
    """Run all steps as `run_steps`."""
    return run_steps(steps, memory, rounding)


@entry(signature(i8, I, I, I, I, I, I, i8))
def run_many(
    steps: Ints, memory: Ints, given: Ints, taken: Ints, points: Ints, results: Ints, rounding: int
) -> int:
    """Run at many points, each from `memory`, as `run_steps`.

    `points` holds the inputs one after the other, all values of the first, all
    of the second and so on, for the words `given`; `results` takes the words
    `taken` likewise. It stops at the first error.
    """
    own = memory.copy()
    size = results.size // max(1, taken.size)
    for point in range(size):
        own[:] = memory
        for i in range(given.size):
            own[u(given[u(i)])] = points[u(i * size + point)]
        event = run_steps(steps, own, rounding)
        if event != NOTHING:
            return event
        for i in range(taken.size):
            results[u(i * size + point)] = own[u(taken[u(i)])]
    return NOTHING


class Wiring:
    """A network under construction."""

    def __init__(self) -> None:
        self._steps: list[int] = []
        self._memory: list[int] = []
        self._names: list[str] = []

    def words(self, values: list[int]) -> int:
        """Put words into memory; return where they begin."""
        at = len(self._memory)
        self._memory += values
        return at

    def step(self, name: str, opcode: int, inputs: list[int], stretched: int, outputs: list[int]) -> int:
        """Add a block whose `inputs` read words of memory; return where its outputs begin, now `outputs`."""
        at, result = self.words([0] * len(inputs)), self.words(outputs)
        wires = [(source, at + place) for place, source in enumerate(inputs)]
        self._steps += [opcode, at, stretched, result, len(wires), *(word for wire in wires for word in wire)]
        self._names.append(name)
        return result

    def constant(self, value: int) -> int:
        """Return a word that holds a number."""
        return self.words([value])

    def network(
        self,
        inputs: Mapping[str, int],
        outputs: Mapping[str, int],
        degrees: Mapping[str, int],
        shares: Mapping[str, Sequence[int]],
    ) -> Network:
        """Return what was wired."""
        return Network(
            steps=np.array(self._steps, np.int64),
            memory=np.array(self._memory, np.int64),
            names=tuple(self._names),
            inputs=inputs,
            outputs=outputs,
            degrees=degrees,
            shares=shares,
        )
