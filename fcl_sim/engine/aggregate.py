"""Aggregation: the degree of a rule's condition (Table 3)."""

from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.arithmetic.hedges import hedged
from fcl_sim.arithmetic.operators import minimum
from fcl_sim.arithmetic.pairs import conjunction
from fcl_sim.engine.program import (
    ALL_MIN,
    ALL_PROD,
    AND_MIN,
    GROUP_MAX,
    GROUP_NSUM,
    LOOK,
    LOOK_DEGREES,
    LOOK_GROUPS,
    LOOK_KINDS,
    LOOK_TERM,
    LOOK_TERMS,
    NOT,
    ONE,
    OR_MAX,
    RULE_BODY,
    RULE_KIND,
    RULE_LENGTH,
    STACK,
)
from fcl_sim.jit import flat, inlined, u

Ints = NDArray[int64]
Floats = NDArray[float64]


@inlined
def aggregate(ints: Ints, at: int, rule: int, memory: Floats, base: int) -> float:
    """Return the degree of firing of the rule whose record is at `rule`."""
    kind = ints[u(rule + RULE_KIND)]
    body = rule + RULE_BODY
    length = ints[u(rule + RULE_LENGTH)]
    if kind == ALL_MIN:
        degree: float = minimum(memory[u(base + ints[u(body)])], memory[u(base + ints[u(body + 1)])])
        for place in range(body + 2, body + length):
            degree = minimum(degree, memory[u(base + ints[u(place)])])
        return degree
    if kind == ALL_PROD:
        degree = memory[u(base + ints[u(body)])] * memory[u(base + ints[u(body + 1)])]
        for place in range(body + 2, body + length):
            degree *= memory[u(base + ints[u(place)])]
        return degree
    return calculate(ints, at, body, body + length, memory, base)


@flat
def calculate(ints: Ints, at: int, code: int, end: int, memory: Floats, base: int) -> float:
    """Return the degree of a condition in postfix code from `code` to `end`.

    The stack holds every degree together with 1 minus it, each near to its own
    digits: what NOT and BDIF need.
    """
    first = base + ints[u(at + STACK)]
    top = first - 2
    place = code
    while place < end:
        word = ints[u(place)]
        place += 1
        if word >= 0 or word <= LOOK:
            top += 2
            if word >= 0:
                memory[u(top)] = memory[u(base + word)]
                memory[u(top + 1)] = memory[u(base + ints[u(place)])]
                place += 1
            else:
                degree = accumulated(ints, at, at + LOOK - word, memory, base)
                memory[u(top)] = degree
                memory[u(top + 1)] = 1.0 - degree
        elif word == NOT:
            degree = memory[u(top)]
            memory[u(top)] = memory[u(top + 1)]
            memory[u(top + 1)] = degree
        elif word == ONE:
            top += 2
            memory[u(top)] = 1.0
            memory[u(top + 1)] = 0.0
        elif word < ONE:
            degree, complement = hedged(word, memory[u(top)], memory[u(top + 1)])
            memory[u(top)] = degree
            memory[u(top + 1)] = complement
        else:
            top -= 2
            swapped = int(word <= OR_MAX)  # OR is AND of the complements, by de Morgan's law
            degree, complement = conjunction(
                word + (AND_MIN - OR_MAX) * swapped,
                memory[u(top + swapped)],
                memory[u(top + 1 - swapped)],
                memory[u(top + 2 + swapped)],
                memory[u(top + 3 - swapped)],
            )
            memory[u(top + swapped)] = degree
            memory[u(top + 1 - swapped)] = complement
    result: float = memory[u(first)]
    return result


@flat
def accumulated(ints: Ints, at: int, look: int, memory: Floats, base: int) -> float:
    """Return the degree accumulated so far for what the look record at `look` means (S27a, S29)."""
    terms = ints[u(look + LOOK_TERMS)]
    degrees = base + ints[u(look + LOOK_DEGREES)]
    kinds = at + ints[u(look + LOOK_KINDS)]
    largest: float = memory[u(degrees + ints[u(look + LOOK_TERM)])]
    if ints[u(look + LOOK_GROUPS)] == 0:
        return largest
    largest = 0.0
    for group in range(ints[u(look + LOOK_GROUPS)]):
        own = degrees + group * terms
        degree = memory[u(own + ints[u(look + LOOK_TERM)])]
        bound = 1.0
        if ints[u(kinds + group)] == GROUP_NSUM:
            for term in range(terms):
                bound = max(bound, memory[u(own + term)])
            degree /= bound
        elif ints[u(kinds + group)] != GROUP_MAX:
            degree = minimum(1.0, degree)
        largest = max(largest, degree)
    return largest
