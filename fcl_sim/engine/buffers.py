"""The two buffers of a program while they grow."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from fcl_sim.engine import program as p
from fcl_sim.engine.conditions import Leaf
from fcl_sim.engine.plan import Plan
from fcl_sim.model import Point


@dataclass(frozen=True, slots=True)
class Buffers:
    """Integers and floats; offsets as in program.py."""

    ints: list[int] = field(default_factory=lambda: [0] * p.HEADER_SIZE)
    floats: list[float] = field(default_factory=lambda: [0.0] * p.BOUNDS)

    def put(self, words: Iterable[int]) -> int:
        """Append integers; return where they begin."""
        at = len(self.ints)
        self.ints.extend(words)
        return at

    def put_floats(self, numbers: Iterable[float]) -> int:
        """Append floats; return where they begin."""
        at = len(self.floats)
        self.floats.extend(numbers)
        return at

    def source(self, plan: Plan, value: float | str) -> int:
        """Return the source of a number or of an input variable."""
        return word_source(plan.inputs[value.casefold()]) if isinstance(value, str) else self.constant(value)

    def weight(self, plan: Plan, weight: float | str) -> int:
        """Return the source of a weight; of a variable, taken into [0, 1] (S27)."""
        if isinstance(weight, str):
            return word_source(plan.slots[Leaf(weight.casefold(), None)])
        return self.constant(weight)

    def constant(self, value: float) -> int:
        """Return the source of a number."""
        return 0 if value == 1.0 else self.put_floats([value])

    def spots(self, plan: Plan, points: Sequence[Point]) -> list[int]:
        """Return points, moved ones among them, as two words each: a source and where the degree is."""
        return [
            word for point in points for word in (self.source(plan, point.x), self.put_floats([point.degree]))
        ]


def word_source(word: int) -> int:
    """Return the source of a word of the memory."""
    return -1 - word
