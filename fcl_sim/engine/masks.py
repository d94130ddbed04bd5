"""Masks: which rules can fire in which cell of a fuzzified input.

A rule set is a whole number whose bit r stands for rule r.
"""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from fractions import Fraction

from fcl_sim.engine.conditions import bounds
from fcl_sim.engine.grid import Cell
from fcl_sim.engine.program import ALL_MIN, ALL_PROD, MASK_BITS

WORD = (1 << MASK_BITS) - 1
Code = tuple[int, Sequence[int]]
"""A rule's condition: its kind, and slots or postfix code."""


def every(codes: Sequence[Code]) -> int:
    """Return the set of all rules."""
    return (1 << len(codes)) - 1


def words_of(rules: int, count: int) -> list[int]:
    """Return a rule set as `count` words."""
    return [rules >> (MASK_BITS * word) & WORD for word in range(count)]


def fireable(codes: Sequence[Code], slots: Sequence[int], cells: Sequence[Cell]) -> list[int]:
    """Return for each cell the rules whose degree can be above 0 there.

    `slots` are those of the cells' functions. Nothing is assumed of the other
    inputs. A conjunction cannot fire where one of its degrees is 0; of other
    conditions, bounds are taken.
    """
    needing = _needing(codes, set(slots))
    loose = [(rule, code) for rule, (kind, code) in enumerate(codes) if kind not in {ALL_MIN, ALL_PROD}]
    sets = []
    for cell in cells:
        rules = every(codes)
        for slot, (_, high) in zip(slots, cell.bounds, strict=True):
            if high == 0:
                rules &= ~needing.get(slot, 0)
        known = dict(zip(slots, cell.bounds, strict=True))
        for rule, code in loose:
            if not known.keys().isdisjoint(code) and _never(code, known):
                rules &= ~(1 << rule)
        sets.append(rules)
    return sets


def _needing(codes: Sequence[Code], slots: set[int]) -> Mapping[int, int]:
    """Return for each slot the conjunctions that contain it."""
    needing: dict[int, int] = defaultdict(int)
    for rule, (kind, code) in enumerate(codes):
        if kind in {ALL_MIN, ALL_PROD}:
            for slot in slots.intersection(code):
                needing[slot] |= 1 << rule
    return needing


def _never(code: Sequence[int], known: Mapping[int, tuple[Fraction, Fraction]]) -> bool:
    unknown = (Fraction(0), Fraction(1))
    return bounds(code, lambda slot: known.get(slot, unknown))[1] == 0
