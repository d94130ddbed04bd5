"""A rule base as it was used: the block, the arithmetic it computed in, and many evaluations of it."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from fcl_sim.block import Block
from fcl_sim.concept.function_block import IntegerInstance
from fcl_sim.engine.program import Program
from fcl_sim.loop.alone import Alone
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.loop.trace import Values
from fcl_sim.model import FunctionBlock


@dataclass(frozen=True, slots=True, kw_only=True)
class Subject:
    """A block in LREAL, REAL or INT; in INT with what a count is, and the rounding of quotients."""

    block: Block
    arithmetic: str = "LREAL"
    scale: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    rounding: str = "truncate"

    @property
    def program(self) -> Program:
        """The program in its arithmetic; in INT that of LREAL, which has the same names."""
        return self.block.program_in("LREAL" if self.arithmetic == "INT" else self.arithmetic)

    @property
    def initial(self) -> Values:
        """The outputs (outputs,) before the first evaluation."""
        program = self.program
        if self.arithmetic == "INT":
            return np.array([*self._integer(self.block.function_block).outputs.values()])
        return np.asarray(program.initial[program.outputs_at : program.active_at], np.float64)

    def outputs(self, inputs: Values, previous: Values, without: int | None = None) -> Values:
        """Return the outputs (n, outputs) at n points, where NC keeps `previous` (n, outputs).

        `without` is a rule that concludes nothing, by its place in the text.
        In INT, NaN at every point where a result leaves its width.
        """
        if self.arithmetic == "INT":
            return self._in_int(inputs, previous, without)
        program = self.program if without is None else self.program.without(without)
        return Alone(program).evaluate(inputs, previous)[:, program.outputs_at : program.active_at]

    def _integer(self, block: FunctionBlock) -> IntegerInstance:
        return IntegerInstance(block, self.scale, self.rounding)

    def _in_int(self, inputs: Values, previous: Values, without: int | None) -> Values:
        block = self.block.function_block
        instance = self._integer(block if without is None else less_a_rule(block, without))
        names = self.program.output_names
        points, back = np.unique(inputs, axis=0, return_inverse=True)  # a device gives few values
        kept = []
        for counts in (0, 1):  # what an output keeps of one and of the other is what NC gave it
            marks = {name: _value(counts, self.scale.get(name, (1.0, 0.0))) for name in names}
            instance.resume(**marks)
            kept.append((_evaluated(instance, self.program.input_names, points), [*marks.values()]))
        (first, low), (second, high) = kept
        held = (first == low) & (second == high)
        return np.where(held[back], previous, first[back])


def of_node(node: FuzzyNode) -> Subject:
    """Return what a fuzzy block of a loop is."""
    return Subject(block=node.block, arithmetic=node.arithmetic, scale=node.scale, rounding=node.rounding)


def less_a_rule(block: FunctionBlock, rule: int) -> FunctionBlock:
    """Return a block less one of its rules, by its place in the text."""
    rule_blocks, first = [], 0
    for each in block.rule_blocks:
        own = tuple(one for place, one in enumerate(each.rules, first) if place != rule)
        rule_blocks.append(replace(each, rules=own))
        first += len(each.rules)
    return replace(block, rule_blocks=tuple(rule_blocks))


def _value(counts: int, scale: tuple[float, float]) -> float:
    factor, offset = scale
    return counts * factor + offset


def _evaluated(instance: IntegerInstance, names: tuple[str, ...], inputs: Values) -> Values:
    try:
        found = instance.evaluate(dict(zip(names, inputs.T, strict=True)))
    except OverflowError:
        if len(inputs) == 1:
            return np.full((1, len(instance.outputs)), np.nan)
        return np.vstack([_evaluated(instance, names, inputs[i : i + 1]) for i in range(len(inputs))])
    return np.column_stack([np.broadcast_to(each, len(inputs)) for each in found.values()])
