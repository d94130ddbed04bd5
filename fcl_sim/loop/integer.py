"""A fuzzy block in INT: called in Python, between two calls of `simulate`.

All that it keeps from scan to scan, its outputs, stands in the memory of the
run, where a fuzzy block in LREAL has them; its instance is one for all runs.
"""

from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass
from math import nan

from fcl_sim.arithmetic.integer import FULL
from fcl_sim.concept.function_block import IntegerInstance
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.loop.work import Floats


@dataclass(frozen=True, slots=True)
class IntegerBlock:
    """A fuzzy block in INT: where its row begins, where memory has its head, and its check.

    The head is what a trace records (`engine.program`); the check is the slot
    that is not finite where a call failed. `instance` stays as it is before a run.
    """

    row: int
    node: FuzzyNode
    head: int
    check: int
    instance: IntegerInstance

    @property
    def ports(self) -> tuple[str, ...]:
        """Names of its inputs, in the order of its row."""
        return self.node.program.input_names

    def evaluate(self, inputs: Mapping[str, float], memory: Floats) -> tuple[str, str] | None:
        """Call the block; return the port that INT cannot hold, or none, and the error where it fails."""
        own, program = copy(self.instance), self.node.program
        previous = memory[self.head + program.outputs_at : self.head + program.active_at].tolist()
        try:
            own.resume(**dict(zip(program.output_names, previous, strict=True)))
            own(**inputs)
        except (ValueError, OverflowError) as error:
            memory[self.check] = nan
            return own.beyond(**inputs), str(error)
        self.record(own, memory)
        return None

    def record(self, instance: IntegerInstance, memory: Floats) -> None:
        """Write what a trace records of an instance, rule degrees 0 to 1."""
        program = self.node.program
        words = [instance.inputs[name] for name in program.input_names]
        words += [instance.outputs[name] for name in program.output_names]
        words += [float(instance.active[name]) for name in program.output_names]
        words += [degree / FULL for degree in instance.degrees.values()]
        memory[self.head : self.head + program.recorded] = words
