"""Conditions as clauses: the alternatives of a rule, each a set of subconditions that must all hold.

They say what a rule asks for, whatever the order and spelling it is written in.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

from fcl_sim.model import And, Condition, Degree, Hedge, Is, Not, Or

MOST = 256
"""Alternatives of a rule that are compared; a rule with more is taken to be like no other."""


@dataclass(frozen=True, slots=True, order=True)
class Ask:
    """A subcondition: a variable, its term (empty where that is a degree), hedges, and whether it is NOT."""

    variable: str
    term: str
    hedges: tuple[str, ...]
    negated: bool


Clause = frozenset[Ask]


def clauses_of(condition: Condition) -> frozenset[Clause] | None:
    """Return the alternatives of a condition, none within another; None where there are too many."""
    found = _alternatives(condition, negated=False)
    if found is None:
        return None
    return frozenset(each for each in found if not any(other < each for other in found))


def _alternatives(condition: Condition, *, negated: bool) -> set[Clause] | None:
    match condition:
        case Not(argument):
            return _alternatives(argument, negated=not negated)
        case And(arguments) | Or(arguments):
            parts = [_alternatives(each, negated=negated) for each in arguments]
            known = [each for each in parts if each is not None]
            if len(known) < len(parts):
                return None
            return _together(known) if isinstance(condition, And) != negated else set().union(*known)
    return {frozenset((_ask(condition, negated=negated),))}


def _together(parts: list[set[Clause]]) -> set[Clause] | None:
    size = 1
    for each in parts:
        size *= len(each)
    if size > MOST:
        return None
    return {frozenset().union(*each) for each in product(*parts)}


def _ask(condition: Condition, *, negated: bool) -> Ask:
    match condition:
        case Degree(variable):
            return Ask(variable.casefold(), "", (), negated)
        case Is(variable, term):
            hedges = list(condition.hedges)
            while hedges and hedges[0] is Hedge.NOT:
                negated = not negated
                hedges.pop(0)
            return Ask(variable.casefold(), term.casefold(), tuple(map(str, hedges)), negated)
    raise TypeError(condition)


def asks_of(condition: Condition) -> Iterator[Ask]:
    """Yield every subcondition, those within NOT as they stand there."""
    match condition:
        case Not(argument):
            yield from asks_of(argument)
        case And(arguments) | Or(arguments):
            for each in arguments:
                yield from asks_of(each)
        case _:
            yield _ask(condition, negated=False)
