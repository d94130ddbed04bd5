"""Masks: which rules can fire in which cell of a fuzzified input.

A rule set is a whole number whose bit r stands for rule r.
"""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import cast

from fcl_sim.engine.conditions import Push, Token, bounds
from fcl_sim.engine.grid import Bounds, Cell
from fcl_sim.engine.program import MASK_BITS

WORD = (1 << MASK_BITS) - 1
UNKNOWN = (Fraction(0), Fraction(1))
NEARLY_UNKNOWN = cast("Bounds", (0.0, 1.0))
SURE = 1e-9
"""A bound above it, computed in floats, is above 0; below it, fractions have to tell, which take longer."""
FEW_WORDS = 8
"""Up to this many words of a mask are all looked at: a summary would cost more."""


@dataclass(frozen=True, slots=True)
class Code:
    """A rule's condition: AND by MIN or PROD over slots, or postfix code."""

    kind: int
    slots: tuple[int, ...] = ()
    tokens: tuple[Token, ...] = ()


def every(codes: Sequence[Code]) -> int:
    """Return the set of all rules."""
    return (1 << len(codes)) - 1


def words_of(rules: int, count: int) -> list[int]:
    """Return a rule set as `count` words, behind their summary where there are many (program.py)."""
    words = [rules >> (MASK_BITS * word) & WORD for word in range(count)]
    used = sum(1 << number for number, word in enumerate(words) if word)
    return [*(used >> (MASK_BITS * word) & WORD for word in range(summary_words(count))), *words]


def summary_words(count: int) -> int:
    """Return how many words the summary of a mask of `count` words has."""
    return 0 if count <= FEW_WORDS else -(-count // MASK_BITS)


def fireable(codes: Sequence[Code], slots: Sequence[int], cells: Sequence[Cell]) -> list[int]:
    """Return for each cell the rules whose degree can be above 0 there.

    `slots` are those of the cells' functions. Nothing is assumed of the other
    inputs. A conjunction cannot fire where one of its degrees is 0; of other
    conditions, bounds are taken.
    """
    own = set(slots)
    needing = _needing(codes, own)
    loose = [
        (rule, code.tokens)
        for rule, code in enumerate(codes)
        if any(isinstance(token, Push) and token.slot in own for token in code.tokens)
    ]
    everything = every(codes)
    sets = []
    for cell in cells:
        excluded = 0
        for slot, (_, high) in zip(slots, cell.bounds, strict=True):
            if high == 0:
                excluded |= needing.get(slot, 0)
        known = dict(zip(slots, cell.bounds, strict=True))
        nearly = {slot: cast("Bounds", (float(low), float(high))) for slot, (low, high) in known.items()}
        for rule, tokens in loose:
            if _highest(tokens, nearly, NEARLY_UNKNOWN) < SURE and _highest(tokens, known, UNKNOWN) == 0:
                excluded |= 1 << rule
        sets.append(everything & ~excluded)
    return sets


def _needing(codes: Sequence[Code], slots: set[int]) -> Mapping[int, int]:
    """Return for each slot the conjunctions that contain it."""
    needing: dict[int, int] = defaultdict(int)
    for rule, code in enumerate(codes):
        for slot in slots.intersection(code.slots):
            needing[slot] |= 1 << rule
    return needing


def _highest(tokens: Sequence[Token], known: Mapping[int, Bounds], unknown: Bounds) -> Fraction:
    """Return the upper bound of a condition's degree."""

    def bounds_of(token: Token) -> Bounds:
        return known.get(token.slot, unknown) if isinstance(token, Push) else unknown

    return bounds(tokens, bounds_of)[1]
