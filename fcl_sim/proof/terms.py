"""What is to be said about variables and terms: unused, out of reach, gaps between, sums that miss 1."""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from fcl_sim.model import (
    Curve,
    Defuzzification,
    Formula,
    FunctionBlock,
    Fuzzification,
    Number,
    Operation,
    Points,
    Singleton,
    Singletons,
    Term,
    Variable,
)
from fcl_sim.model.expressions import Call, Expression, Reference
from fcl_sim.proof.axes import ZERO, Axis, Cell, is_straight
from fcl_sim.proof.clauses import asks_of
from fcl_sim.proof.space import Side, brought
from fcl_sim.proof.universe import Universe

NEARLY = Fraction(1, 10)
"""How far a sum of degrees may be from 1 to be taken for a slip."""
ROUNDED = Fraction(1, 10**9)
"""How far it may be by rounding."""


@dataclass(frozen=True, slots=True)
class OffOne:
    """Where the sum of an input's degrees is farthest from 1, and what it is there."""

    at: Fraction
    total: Fraction


def unasked(block: FunctionBlock, fuzzification: Fuzzification) -> tuple[Term, ...]:
    """Return the terms of an input that no condition asks for."""
    asked = {
        each.term
        for rule_block in block.rule_blocks
        for rule in rule_block.rules
        for each in asks_of(rule.condition)
        if each.variable == fuzzification.variable.casefold()
    }
    return tuple(each for each in fuzzification.terms if each.name.casefold() not in asked)


def unconcluded(block: FunctionBlock, output: Defuzzification) -> tuple[Term, ...]:
    """Return the terms of an output that no rule concludes."""
    concluded = {
        (each.term or "").casefold()
        for rule_block in block.rule_blocks
        for rule in rule_block.rules
        for each in rule.conclusions
        if each.variable.casefold() == output.variable.casefold()
    }
    return tuple(each for each in output.terms if each.name.casefold() not in concluded)


def without_effect(block: FunctionBlock) -> tuple[Variable, ...]:
    """Return the inputs that stand in no condition and no weight, and move nothing."""
    used = set(brought(block)) | set(_moving(block))
    for rule_block in block.rule_blocks:
        for rule in rule_block.rules:
            used |= {each.variable for each in asks_of(rule.condition)}
    return tuple(each for each in block.inputs if each.name.casefold() not in used)


def _moving(block: FunctionBlock) -> Iterator[str]:
    """Yield the variables that move points or parameters of terms, or stand in a formula, in lower case."""
    sections = [each.terms for each in block.fuzzifications] + [each.terms for each in block.defuzzifications]
    for terms in sections:
        for term in terms:
            match term.shape:
                case Points(points) | Singletons(points):
                    yield from (each.x.casefold() for each in points if isinstance(each.x, str))
                case Curve(_, parameters):
                    yield from (each.casefold() for each in parameters if isinstance(each, str))
                case Singleton(str() as value):
                    yield value.casefold()
                case Formula(expression):
                    yield from _references(expression)


def _references(expression: Expression) -> Iterator[str]:
    match expression:
        case Reference(variable):
            yield variable.casefold()
        case Operation(_, arguments) | Call(_, arguments):
            for each in arguments:
                yield from _references(each)
        case Number():
            return


def beyond(axis: Axis, fuzzification: Fuzzification, universe: Universe) -> tuple[Term, ...]:
    """Return the terms of an input that are 0 wherever it goes."""
    if universe.of(axis.variable) is None:
        return ()
    return tuple(
        each
        for each in fuzzification.terms
        if is_straight(each) and not any(high > 0 for high in axis.highs[each.name.casefold()])
    )


def beyond_range(output: Defuzzification) -> tuple[Term, ...]:
    """Return the terms of an output of which nothing lies within its RANGE."""
    if output.range is None:
        return ()
    low, high = output.range
    found = []
    for each in output.terms:
        places = _reach(each)
        if places and (max(places) < low or min(places) > high):
            found.append(each)
    return tuple(found)


def _reach(term: Term) -> list[float]:
    """Return the ends of where a constant term of an output is above 0; nothing where it has no end."""
    match term.shape:
        case Singleton(float() as value):
            return [value]
        case Points(points) if is_straight(term):
            if points[0].degree > 0.0 or points[-1].degree > 0.0:
                return []
            inside = [
                place
                for place, each in enumerate(points)
                if any(own.degree > 0.0 for own in points[max(place - 1, 0) : place + 2])
            ]
            return [float(points[place].x) for place in inside]
    return []


def gaps_between(axis: Axis, fuzzification: Fuzzification) -> tuple[Side, ...]:
    """Return where no term of an input is above 0 though some are on both sides."""
    if not all(each.name.casefold() in axis.highs for each in fuzzification.terms):
        return ()
    tops = [max(each) for each in zip(*axis.highs.values(), strict=True)]
    covered = [place for place, top in enumerate(tops) if top > 0]
    if not covered:
        return ()
    found: list[list[Cell]] = []
    for place in range(covered[0], covered[-1]):
        if tops[place] == ZERO:
            if place > 0 and tops[place - 1] == ZERO and found:
                found[-1].append(axis.cells[place])
            else:
                found.append([axis.cells[place]])
    return tuple(Side(each[0].low, each[-1].high, each[0].is_point, each[-1].is_point) for each in found)


def off_one(axis: Axis, fuzzification: Fuzzification) -> OffOne | None:
    """Return where the sum of all degrees misses 1, if it is nearly 1 at all of the terms' points."""
    if len(fuzzification.terms) < 2 or not all(map(is_straight, fuzzification.terms)):
        return None
    sums = []
    for place, cell in enumerate(axis.cells):
        if cell.is_point and cell.low is not None:
            total = sum((each[place] for each in axis.highs.values()), ZERO)
            sums.append(OffOne(cell.low, total))
    worst = max(sums, key=lambda each: abs(each.total - 1), default=None)
    if worst is None or not ROUNDED < abs(worst.total - 1) <= NEARLY:
        return None
    return worst
