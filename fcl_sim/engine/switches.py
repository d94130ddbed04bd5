"""Parts that are switched off, and inputs kept in their range (ENABLED and LOCK, Open Level).

Both are said in other words of the model, so that the kernel knows nothing of them.
"""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

from fcl_sim.model import (
    And,
    Conclusion,
    FunctionBlock,
    Fuzzification,
    Hedge,
    Is,
    Point,
    Points,
    Rule,
    RuleBlock,
    Singletons,
    Term,
)

NEVER = Is("", "", hedges=(Hedge.NOT, Hedge.ANY))
"""A condition that never holds."""


def switched(block: FunctionBlock) -> FunctionBlock:
    """Return `block` with what is not enabled made 0, and terms of clamped inputs as beyond the range."""
    return replace(
        counted(block),
        fuzzifications=tuple(_fuzzification(each, limits_of(block, each)) for each in block.fuzzifications),
        rule_blocks=tuple(each if each.enabled else _silenced(each) for each in counted(block).rule_blocks),
    )


def counted(block: FunctionBlock) -> FunctionBlock:
    """Return `block` with conclusions on outputs that are not enabled weighted by 0."""
    off = {each.variable.casefold() for each in block.defuzzifications if not each.enabled}

    def conclusion(each: Conclusion) -> Conclusion:
        return replace(each, weight=0.0) if each.variable.casefold() in off else each

    def rule(each: Rule) -> Rule:
        return replace(each, conclusions=tuple(map(conclusion, each.conclusions)))

    if not off:
        return block
    rule_blocks = tuple(replace(each, rules=tuple(map(rule, each.rules))) for each in block.rule_blocks)
    return replace(block, rule_blocks=rule_blocks)


def _silenced(rule_block: RuleBlock) -> RuleBlock:
    rules = tuple(replace(each, condition=And((each.condition, NEVER))) for each in rule_block.rules)
    return replace(rule_block, rules=rules)


def limits_of(block: FunctionBlock, fuzzification: Fuzzification) -> tuple[float, float] | None:
    """Return the range that a variable is taken no further than, if there is one."""
    variable = fuzzification.variable.casefold()
    found = [each.range for each in block.inputs if each.name.casefold() == variable]
    return found[0] if found and fuzzification.clamped else None


def _fuzzification(fuzzification: Fuzzification, limits: tuple[float, float] | None) -> Fuzzification:
    terms = fuzzification.terms
    if not fuzzification.enabled:
        nothing = Points((Point(0.0, 0.0),))
        terms = tuple(replace(term, shape=nothing) for term in terms)
    elif limits is not None:
        terms = tuple(
            replace(term, shape=_clamped(term, limits)) if is_fixed(term) else term for term in terms
        )
    return replace(fuzzification, terms=terms)


def is_fixed(term: Term) -> bool:
    """Return whether a term has base points, or single values, that are constant."""
    shape = term.shape
    if not isinstance(shape, Points | Singletons):
        return False
    return not any(isinstance(each.x, str) for each in shape.points)


def _clamped(term: Term, limits: tuple[float, float]) -> Points:
    """Return base points with the degree of a limit beyond it, and all of the limit's own points kept."""
    shape = term.shape
    if isinstance(shape, Singletons):
        shape = spikes(shape)
    if not isinstance(shape, Points):
        raise TypeError(term)
    low, high = limits
    inside = [point for point in shape.points if low <= float(point.x) <= high]
    ends = [Point(x, float(degree_at(shape.points, Fraction(x)))) for x in limits]
    return Points((ends[0], *inside, ends[1]))


def degree_at(points: Sequence[Point], x: Fraction) -> Fraction:
    """Return the degree of constant base points at `x`: the largest where several lie there (S20, S21)."""
    base = [(Fraction(point.x), Fraction(point.degree)) for point in points]
    here = [degree for place, degree in base if place == x]
    if here:
        return max(here)
    for (left, low), (right, high) in pairwise(base):
        if left < x < right:
            return low + (high - low) * (x - left) / (right - left)
    return base[0][1] if x < base[0][0] else base[-1][1]


def spikes(shape: Singletons) -> Points:
    """Return single values as base points: at each, up from 0 and down again (S21)."""
    points = sorted(shape.points, key=lambda point: float(point.x)) if len(shape.points) > 1 else shape.points
    return Points(tuple(Point(point.x, degree) for point in points for degree in (0.0, point.degree, 0.0)))
