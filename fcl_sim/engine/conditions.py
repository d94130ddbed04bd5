"""Conditions as the kernel takes them: a list of slots, or postfix code.

A leaf is what has a slot in the instance memory: a term of an input, a
variable brought in, or the complement of either. `NOT x IS t` is a leaf of its
own, fuzzified from the complement of t's base points: near zero, 1 minus a
rounded degree would have lost its digits.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from fcl_sim.diagnostics import Span
from fcl_sim.engine import program as p
from fcl_sim.model import And, AndOperator, Condition, Degree, Is, Not, Or, OrOperator

Bounds = tuple[Fraction, Fraction]

AND_CODE = {AndOperator.MIN: p.AND_MIN, AndOperator.PROD: p.AND_PROD, AndOperator.BDIF: p.AND_BDIF}
OR_CODE = {OrOperator.MAX: p.OR_MAX, OrOperator.ASUM: p.OR_ASUM, OrOperator.BSUM: p.OR_BSUM}


@dataclass(frozen=True, slots=True)
class Leaf:
    """A term of a variable, or with `term` None a variable brought in; names case-folded."""

    variable: str
    term: str | None
    negated: bool = False
    span: Span | None = field(default=None, compare=False, repr=False)


def leaves(condition: Condition) -> Iterator[Leaf]:
    """Yield the leaves of a condition from left to right."""
    leaf = _leaf(condition)
    if leaf is not None:
        yield leaf
    elif isinstance(condition, Not):
        yield from leaves(condition.argument)
    elif isinstance(condition, And | Or):
        for argument in condition.arguments:
            yield from leaves(argument)


def conjunction(condition: Condition) -> tuple[Leaf, ...] | None:
    """Return the leaves of a condition that is nothing but AND over leaves, else None."""
    leaf = _leaf(condition)
    if leaf is not None:
        return (leaf,)
    if not isinstance(condition, And):
        return None
    parts = [conjunction(argument) for argument in condition.arguments]
    if any(part is None for part in parts):
        return None
    return tuple(leaf for part in parts if part for leaf in part)


def postfix(condition: Condition, and_code: int, or_code: int, slot_of: Callable[[Leaf], int]) -> list[int]:
    """Return a condition as postfix code: a slot is a push, a negative word an operator."""
    leaf = _leaf(condition)
    if leaf is not None:
        return [slot_of(leaf)]
    if isinstance(condition, Not):
        return [*postfix(condition.argument, and_code, or_code, slot_of), p.NOT]
    if not isinstance(condition, And | Or):
        raise TypeError(condition)
    operator = and_code if isinstance(condition, And) else or_code
    first, *others = (postfix(argument, and_code, or_code, slot_of) for argument in condition.arguments)
    for other in others:
        first += [*other, operator]
    return first


def depth(code: Sequence[int]) -> int:
    """Return how many words of stack a postfix code needs."""
    deepest = level = 0
    for word in code:
        level += 1 if word >= 0 else 0 if word == p.NOT else -1
        deepest = max(deepest, level)
    return deepest


def bounds(code: Sequence[int], bounds_of: Callable[[int], Bounds]) -> Bounds:
    """Return bounds of the degree of a postfix code, from bounds of its slots.

    Every operator of Table 3 rises with both arguments.
    """
    stack: list[Bounds] = []
    for word in code:
        if word >= 0:
            stack.append(bounds_of(word))
        elif word == p.NOT:
            low, high = stack.pop()
            stack.append((1 - high, 1 - low))
        else:
            b, a = stack.pop(), stack.pop()
            operator = OPERATORS[word]
            stack.append((operator(a[0], b[0]), operator(a[1], b[1])))
    return stack[-1]


OPERATORS: dict[int, Callable[[Fraction, Fraction], Fraction]] = {
    p.AND_MIN: min,
    p.AND_PROD: lambda a, b: a * b,
    p.AND_BDIF: lambda a, b: max(Fraction(0), a + b - 1),
    p.OR_MAX: max,
    p.OR_ASUM: lambda a, b: a + b - a * b,
    p.OR_BSUM: lambda a, b: min(Fraction(1), a + b),
}
"""The operators on exact bounds, by their code."""


def _leaf(condition: Condition) -> Leaf | None:
    """Return the leaf that a condition is, if it is one; NOT NOT x is x."""
    negated = False
    while isinstance(condition, Not):
        negated = not negated
        condition = condition.argument
    if isinstance(condition, Is):
        return Leaf(condition.variable.casefold(), condition.term.casefold(), negated, condition.span)
    if isinstance(condition, Degree):
        return Leaf(condition.variable.casefold(), None, negated, condition.span)
    return None
