"""What is to be said about variables and terms: unused, out of reach, gaps between, sums that miss 1."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from math import inf

from fcl_sim.engine.smooth import turns
from fcl_sim.model import (
    Curve,
    CurveKind,
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
from fcl_sim.proof.axes import ZERO, Axis, Cell, is_constant, is_straight
from fcl_sim.proof.clauses import asks_of
from fcl_sim.proof.space import Side, brought
from fcl_sim.proof.universe import Universe

ENDS = {
    CurveKind.COSINE: (True, True),
    CurveKind.PI_SHAPE: (True, True),
    CurveKind.Z_SHAPE: (False, True),
    CurveKind.S_SHAPE: (True, False),
}
"""Curves that end, and whether they do so at their first and at their last turn."""


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
    used = set(brought(block)) | set(moving(block))
    for rule_block in block.rule_blocks:
        for rule in rule_block.rules:
            used |= {each.variable for each in asks_of(rule.condition)}
    return tuple(each for each in block.inputs if each.name.casefold() not in used)


def moving(block: FunctionBlock) -> Iterator[str]:
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


def out_of_reach(
    block: FunctionBlock, axes: Sequence[Axis], universe: Universe
) -> frozenset[tuple[str, str]]:
    """Return the terms that are 0 wherever their input goes, as input and name, both in lower case."""
    own = {each.variable.casefold(): each for each in axes}
    return frozenset(
        (name, term.name.casefold())
        for each in block.fuzzifications
        if (name := each.variable.casefold()) in own and each.enabled
        for term in beyond(own[name], each, universe)
    )


def beyond_range(output: Defuzzification) -> tuple[Term, ...]:
    """Return the terms of an output of which nothing lies within its RANGE."""
    if output.range is None:
        return ()
    low, high = output.range
    found = []
    for each in output.terms:
        places = _reach(each)
        if places and (max(places) < low or min(places) > high or _has_no_area(each, output.range)):
            found.append(each)
    return tuple(found)


def barren(block: FunctionBlock) -> frozenset[tuple[str, str]]:
    """Return the terms of outputs that have no area within RANGE, by output and name in lower case (S31)."""
    return frozenset(
        (output.variable.casefold(), each.name.casefold())
        for output in block.defuzzifications
        for each in output.terms
        if _has_no_area(each, output.range)
    )


def _has_no_area(term: Term, limits: tuple[float, float] | None) -> bool:
    """Return whether a constant term is 0 within limits, but for single points."""
    low, high = limits or (-inf, inf)
    match term.shape:
        case Points(points) if is_straight(term):
            places = [-inf, *(float(each.x) for each in points), inf]
            degrees = [points[0].degree, *(each.degree for each in points), points[-1].degree]
            pieces = zip(pairwise(places), pairwise(degrees), strict=True)
            return not any(
                max(one, low) < min(other, high) and max(tops) > 0.0 for (one, other), tops in pieces
            )
        case Curve(kind) as curve if kind in ENDS and is_constant(term):
            below, above = ENDS[kind]
            first = min(turns(curve)) if below else -inf
            last = max(turns(curve)) if above else inf
            return max(first, low) >= min(last, high)
    return False


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


def stretches_without_terms(block: FunctionBlock, axes: Sequence[Axis]) -> Mapping[str, tuple[Side, ...]]:
    """Return the gaps between the terms of each input that has some, by its declared name."""
    own = {each.variable.casefold(): each for each in axes}
    found = {}
    for each in block.fuzzifications:
        axis = own.get(each.variable.casefold())
        gaps = gaps_between(axis, each) if axis is not None and each.enabled else ()
        if axis is not None and gaps:
            found[axis.variable] = gaps
    return found
