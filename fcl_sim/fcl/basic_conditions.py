"""Conditions → what the Basic Level says with several rules: AND alone (5.2.4)."""

from collections.abc import Callable, Iterator
from collections.abc import Set as AbstractSet
from itertools import count, product
from math import prod
from string import ascii_lowercase

from fcl_sim.diagnostics import Span
from fcl_sim.model import And, Condition, Degree, Is, Not, Or, Rule

MOST_ALTERNATIVES = 500
"""Rules that one rule may become."""


Refuse = Callable[[str, Span | None], None]
"""Takes what the Basic Level cannot say, and where."""


def alternatives(rule: Rule, inputs: AbstractSet[str], refuse: Refuse) -> list[Condition]:
    """Return conditions without OR of which any is to hold; parentheses are multiplied out.

    MIN and MAX distribute over each other, degree for degree, so that nothing is
    rounded.
    """
    before = _Counted(refuse)
    _check(rule.condition, rule, inputs, before)
    if before.refused:
        return [rule.condition]
    number = _number(rule.condition)
    if number > MOST_ALTERNATIVES:
        refuse(f"this rule would become more than {MOST_ALTERNATIVES} rules", rule.span)
        return [rule.condition]
    return [each[0] if len(each) == 1 else And(each) for each in _multiplied(rule.condition)]


def uses(condition: Condition, kind: type[And] | type[Or]) -> bool:
    """Return whether AND, or OR, stands anywhere in a condition."""
    match condition:
        case Not():
            return uses(condition.argument, kind)
        case And() | Or():
            return isinstance(condition, kind) or any(uses(each, kind) for each in condition.arguments)
    return False


def letters(label: str, taken: AbstractSet[str]) -> Iterator[str]:
    """Yield what is added to a label for each rule that its rule becomes: a to z, then aa, ab and so on."""
    for length in count(1):
        for each in product(ascii_lowercase, repeat=length):
            added = "".join(each)
            if f"{label}{added}".upper() not in taken:
                yield added


class _Counted:
    """Hands refusals on, and knows whether there was one."""

    def __init__(self, refuse: Refuse) -> None:
        self._refuse = refuse
        self.refused = False

    def add(self, message: str, span: Span | None) -> None:
        self.refused = True
        self._refuse(message, span)


def _check(condition: Condition, rule: Rule, inputs: AbstractSet[str], refusals: _Counted) -> None:
    match condition:
        case Is():
            if condition.hedges:
                refusals.add("the Basic Level has no hedges", condition.span or rule.span)
            elif condition.variable not in inputs:
                message = "a condition of the Basic Level is about inputs alone"
                refusals.add(message, condition.span or rule.span)
        case Degree():
            message = "the Basic Level has no degrees brought in from outside: they belong to Table 9"
            refusals.add(message, condition.span or rule.span)
        case Not():
            message = "the Basic Level has no NOT: it belongs to Table 9"
            refusals.add(message, _place(condition.argument) or rule.span)
        case And() | Or():
            for each in condition.arguments:
                _check(each, rule, inputs, refusals)


def _place(condition: Condition) -> Span | None:
    return condition.span if isinstance(condition, Is | Degree) else None


def _number(condition: Condition) -> int:
    match condition:
        case And():
            return prod(_number(each) for each in condition.arguments)
        case Or():
            return sum(_number(each) for each in condition.arguments)
    return 1


def _multiplied(condition: Condition) -> list[tuple[Condition, ...]]:
    """Return, for each alternative, what AND joins in it."""
    match condition:
        case And():
            factors = product(*(_multiplied(each) for each in condition.arguments))
            return [tuple(leaf for part in parts for leaf in part) for parts in factors]
        case Or():
            return [part for each in condition.arguments for part in _multiplied(each)]
    return [(condition,)]
