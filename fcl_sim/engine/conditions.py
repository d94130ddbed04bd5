"""Conditions as the kernel takes them: a list of slots, or postfix code.

A leaf is a term of an input, a variable brought in, what rules have concluded,
or the complement of one of these. `NOT x IS t` is a leaf of its own, fuzzified
from the complement of t's base points: near zero, 1 minus a rounded degree
would have lost its digits. For the same reason postfix code carries every
degree together with 1 minus it.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from fcl_sim.diagnostics import Span
from fcl_sim.engine import program as p
from fcl_sim.model import (
    Accumulation,
    And,
    AndOperator,
    Condition,
    Degree,
    Hedge,
    Is,
    Not,
    Or,
    OrOperator,
    RuleBlock,
)

Bounds = tuple[Fraction, Fraction]

AND_CODE = dict(
    zip(
        AndOperator,
        (p.AND_MIN, p.AND_PROD, p.AND_BDIF, p.AND_HPROD, p.AND_EPROD, p.AND_DPROD, p.AND_NMIN),
        strict=True,
    )
)
OR_CODE = dict(
    zip(
        OrOperator,
        (p.OR_MAX, p.OR_ASUM, p.OR_BSUM, p.OR_HSUM, p.OR_ESUM, p.OR_DSUM, p.OR_NMAX),
        strict=True,
    )
)
NORM_CODE = {
    Accumulation.ASUM: p.OR_ASUM,
    Accumulation.HSUM: p.OR_HSUM,
    Accumulation.ESUM: p.OR_ESUM,
    Accumulation.DSUM: p.OR_DSUM,
    Accumulation.NMAX: p.OR_NMAX,
}
"""Accumulations that are an OR, applied again and again."""
HEDGE_CODE = {
    Hedge.VERY: p.VERY,
    Hedge.EXTREMELY: p.EXTREMELY,
    Hedge.SOMEWHAT: p.SOMEWHAT,
    Hedge.SELDOM: p.SELDOM,
    Hedge.NOT: p.NOT,
    Hedge.ANY: p.ONE,
}


@dataclass(frozen=True, slots=True)
class Leaf:
    """A term of a variable, or with `term` None the variable itself; names case-folded."""

    variable: str
    term: str | None
    negated: bool = False
    span: Span | None = field(default=None, compare=False, repr=False)

    @property
    def complement(self) -> "Leaf":
        """The leaf whose degree is 1 minus this one's."""
        return Leaf(self.variable, self.term, not self.negated, self.span)


@dataclass(frozen=True, slots=True)
class Push:
    """In postfix code: the slots of a degree and of 1 minus it."""

    slot: int
    complement: int


@dataclass(frozen=True, slots=True)
class Look:
    """In postfix code: the degree that the rules before have accumulated for a term (S27a, S29)."""

    variable: str
    term: str | None


Token = Push | Look | int
"""A word of postfix code; an int is an operator, a hedge or ONE."""


def leaves(condition: Condition) -> Iterator[Leaf]:
    """Yield the leaves of a condition from left to right."""
    leaf = _leaf(condition)
    if leaf is not None:
        yield leaf
    elif isinstance(condition, Is):
        if Hedge.ANY not in condition.hedges:
            yield _bare(condition)
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


def has_complements(condition: Condition, operators: RuleBlock) -> bool:
    """Return whether the degree of a condition is calculated from 1 minus those of its leaves, too."""
    if _leaf(condition) is not None:
        return False
    if isinstance(condition, And | Or):
        own = operators.and_operator if isinstance(condition, And) else operators.or_operator
        needed = own not in {AndOperator.MIN, AndOperator.PROD, OrOperator.MAX, OrOperator.BSUM}
        return needed or any(has_complements(argument, operators) for argument in condition.arguments)
    return True


def postfix(
    condition: Condition, and_code: int, or_code: int, push: Callable[[Leaf], list[Token]]
) -> list[Token]:
    """Return a condition as postfix code; `push` gives that of a leaf."""
    leaf = _leaf(condition)
    if leaf is not None:
        return push(leaf)
    if isinstance(condition, Is):
        return _hedged(condition, push)
    if isinstance(condition, Not):
        return [*postfix(condition.argument, and_code, or_code, push), p.NOT]
    if not isinstance(condition, And | Or):
        raise TypeError(condition)
    operator = and_code if isinstance(condition, And) else or_code
    first, *others = (postfix(argument, and_code, or_code, push) for argument in condition.arguments)
    for other in others:
        first += [*other, operator]
    return first


def depth(code: Sequence[Token]) -> int:
    """Return how many degrees the stack must hold for a postfix code."""
    deepest = level = 0
    for token in code:
        level += 1 if not isinstance(token, int) or token == p.ONE else 0 if token in UNARY else -1
        deepest = max(deepest, level)
    return deepest


def bounds(code: Sequence[Token], bounds_of: Callable[[Token], Bounds]) -> Bounds:
    """Return bounds of the degree of a postfix code, from bounds of what it pushes.

    Every operator rises with both arguments, and every hedge but NOT with its one.
    """
    stack: list[Bounds] = []
    for token in code:
        if not isinstance(token, int):
            stack.append(bounds_of(token))
        elif token == p.ONE:
            stack.append((Fraction(1), Fraction(1)))
        elif token in UNARY:
            stack.append(UNARY[token](*stack.pop()))
        else:
            b, a = stack.pop(), stack.pop()
            operator = OPERATORS[token]
            stack.append((operator(a[0], b[0]), operator(a[1], b[1])))
    return stack[-1]


Norm = Callable[[Fraction, Fraction], Fraction]


def _dual(norm: Norm) -> Norm:
    """Return the S-norm of a T-norm by de Morgan's law."""
    return lambda a, b: 1 - norm(1 - a, 1 - b)


T_NORMS: dict[int, Norm] = {
    p.AND_HPROD: lambda a, b: a * b / (a + b - a * b) if a + b else 0 * a,
    p.AND_EPROD: lambda a, b: a * b / (2 - a - b + a * b),
    p.AND_DPROD: lambda a, b: min(a, b) if max(a, b) == 1 else 0 * a,
    p.AND_NMIN: lambda a, b: min(a, b) if a + b > 1 else 0 * a,
}
"""Those of the Open Level."""

OPERATORS: dict[int, Callable[[Fraction, Fraction], Fraction]] = {
    p.AND_MIN: min,
    p.AND_PROD: lambda a, b: a * b,
    p.AND_BDIF: lambda a, b: max(0 * a, a + b - 1),
    p.OR_MAX: max,
    p.OR_ASUM: lambda a, b: a + b - a * b,
    p.OR_BSUM: lambda a, b: min(1 + 0 * a, a + b),
    **T_NORMS,
    **{p.OR_MAX - p.AND_MIN + code: _dual(norm) for code, norm in T_NORMS.items()},
}
"""The operators on bounds, by their code; of fractions they give fractions, of floats floats."""


def _positive(low: Fraction, high: Fraction) -> Bounds:
    """Return bounds after a hedge that leaves 0 and 1, and nothing else, where they are."""
    return 0 * low + int(low == 1), 0 * high + int(high > 0)


UNARY: dict[int, Callable[[Fraction, Fraction], Bounds]] = {
    p.NOT: lambda low, high: (1 - high, 1 - low),
    p.VERY: _positive,
    p.EXTREMELY: _positive,
    p.SOMEWHAT: _positive,
    p.SELDOM: _positive,
}
"""NOT and the hedges on bounds, which need no more than tell whether a degree can leave 0 or 1."""


def _leaf(condition: Condition) -> Leaf | None:
    """Return the leaf that a condition is, if it is one; NOT NOT x is x."""
    negated = False
    while isinstance(condition, Not):
        negated = not negated
        condition = condition.argument
    if isinstance(condition, Is) and not condition.hedges:
        return Leaf(condition.variable.casefold(), condition.term.casefold(), negated, condition.span)
    if isinstance(condition, Degree):
        return Leaf(condition.variable.casefold(), None, negated, condition.span)
    return None


def _bare(condition: Is) -> Leaf:
    """Return the leaf that hedges stand before."""
    return Leaf(condition.variable.casefold(), condition.term.casefold(), span=condition.span)


def _hedged(condition: Is, push: Callable[[Leaf], list[Token]]) -> list[Token]:
    """Return a subcondition with hedges, the last one first; before ANY, nothing counts."""
    hedges = condition.hedges
    if Hedge.ANY in hedges:
        hedges = hedges[: hedges.index(Hedge.ANY) + 1]
        return [HEDGE_CODE[hedge] for hedge in reversed(hedges)]
    return [*push(_bare(condition)), *(HEDGE_CODE[hedge] for hedge in reversed(hedges))]
