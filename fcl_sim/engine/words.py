"""Conditions in words, and as the formula that their operators make."""

from collections.abc import Callable, Iterator
from dataclasses import replace

from fcl_sim.model import And, Condition, Degree, Hedge, Is, Not, Or, RuleBlock

OR_LEVEL, AND_LEVEL, NOT_LEVEL = range(3)
"""Table 6: how tightly an operator binds."""


def number(value: float) -> str:
    """Return a number as people read it: four significant digits."""
    return f"{value + 0.0:.4g}"


def condition_text(condition: Condition, level: int = OR_LEVEL) -> str:
    """Return a condition in FCL, with parentheses only where Table 6 needs them."""
    if isinstance(condition, Is):
        return f"{condition.variable} IS {_predicate(condition)}"
    if isinstance(condition, Degree):
        return condition.variable
    if isinstance(condition, Not):
        argument = condition.argument
        if isinstance(argument, Is):
            return f"{argument.variable} IS NOT {_predicate(argument)}"
        return f"NOT {condition_text(argument, NOT_LEVEL)}"
    own, word = (AND_LEVEL, " AND ") if isinstance(condition, And) else (OR_LEVEL, " OR ")
    text = word.join(condition_text(argument, own + 1) for argument in condition.arguments)
    return f"({text})" if own < level else text


def condition_formula(
    condition: Condition, operators: RuleBlock, degree_of: Callable[[Condition], float]
) -> str:
    """Return a condition as the formula of its degrees, such as `MIN(0.8333, 0.8)`."""
    if isinstance(condition, And | Or):
        operator = operators.and_operator if isinstance(condition, And) else operators.or_operator
        inner = ", ".join(condition_formula(each, operators, degree_of) for each in condition.arguments)
        return f"{operator}({inner})"
    if isinstance(condition, Is) and condition.hedges:
        return _hedged(condition, degree_of)
    if isinstance(condition, Not) and not _is_leaf(condition.argument):
        return f"1 - {condition_formula(condition.argument, operators, degree_of)}"
    return number(degree_of(condition))


def subconditions(condition: Condition) -> Iterator[Condition]:
    """Yield what `condition_formula` takes degrees of: subconditions without hedges, or NOT one."""
    if isinstance(condition, And | Or):
        for each in condition.arguments:
            yield from subconditions(each)
    elif isinstance(condition, Is) and condition.hedges:
        if Hedge.ANY not in condition.hedges:
            yield replace(condition, hedges=())
    elif isinstance(condition, Not) and not _is_leaf(condition.argument):
        yield from subconditions(condition.argument)
    else:
        yield condition


def _predicate(condition: Is) -> str:
    """Return what stands behind IS: hedges and the term; ANY may stand alone."""
    return " ".join((*condition.hedges, *filter(None, (condition.term,))))


def _is_leaf(condition: Condition) -> bool:
    return isinstance(condition, Degree) or (isinstance(condition, Is) and not condition.hedges)


def _hedged(condition: Is, degree_of: Callable[[Condition], float]) -> str:
    """Return hedges as functions of one another, the last one innermost; `any` is 1 before all terms."""
    bare = Hedge.ANY in condition.hedges
    text = "1" if bare else number(degree_of(replace(condition, hedges=())))
    outer = condition.hedges[: condition.hedges.index(Hedge.ANY)] if bare else condition.hedges
    for hedge in reversed(outer):
        text = f"{hedge}({text})"
    return text
