"""Which rule is missing at a point, and which of those that are there are nearest to firing."""

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from fcl_sim.engine.smooth import degrees_at, turns
from fcl_sim.fcl.write_rules import condition_text
from fcl_sim.model import (
    And,
    Conclusion,
    Condition,
    Curve,
    Degree,
    FunctionBlock,
    Is,
    Not,
    Or,
    Points,
    Rule,
    Term,
)
from fcl_sim.model.labels import unique_labels
from fcl_sim.proof.axes import is_constant
from fcl_sim.proof.cubes import leaves
from fcl_sim.proof.points import Point, degree, strongest
from fcl_sim.proof.terms import barren

NEAREST = 3
"""Rules that are named."""


@dataclass(frozen=True, slots=True)
class Near:
    """A rule by its label, and the subconditions of it that do not hold, as FCL.

    `way` is how far the inputs are from where these hold most, as parts of what their terms reach over.
    """

    label: str
    lacking: tuple[str, ...]
    way: float = 0.0


@dataclass(frozen=True, slots=True)
class Missing:
    """`asks` are the subconditions of a rule that would fire there; `rules` those nearest to firing there.

    An input that has no term above 0 there is in `without`: no rule could ask for one.
    `silent` are the rules that fire there and conclude nothing, for their weight is 0,
    or their term has no area within RANGE; `off` the rule blocks that conclude on the
    output where all of these are switched off.
    """

    asks: tuple[str, ...]
    without: tuple[str, ...]
    rules: tuple[Near, ...]
    silent: tuple[str, ...] = ()
    off: tuple[str, ...] = ()


def missing_at(
    block: FunctionBlock, output: str, point: Point, sides: Collection[str], least: Fraction = Fraction(0)
) -> Missing:
    """Return what is missing for an output at a point where no rule fires, or none counts by `least`.

    `sides` are the inputs by which that is so, whatever the others are.
    """
    blocks = [each for each in block.rule_blocks if any(_concludes(rule, output) for rule in each.rules)]
    if blocks and not any(each.enabled for each in blocks):
        return Missing((), (), (), off=tuple(each.name for each in blocks))
    asked = set(_asked(block, output))
    without = [
        each.variable
        for each in block.fuzzifications
        if each.variable.casefold() in asked and strongest(each, _value(point, each.variable), point) is None
    ]
    bounding = {each.casefold() for each in sides} & asked
    asks = [text for each in point if each.casefold() in bounding for text in _ask(block, each, point)]
    degrees = _Degrees(block, point, least)
    labels = unique_labels(block)
    near, silent = [], []
    idle = barren(block)
    rules = [rule for each in block.rule_blocks for rule in each.rules]
    for label, rule in zip(labels, rules, strict=True):
        own = [each for each in rule.conclusions if each.variable.casefold() == output.casefold()]
        if own:
            lacking = degrees.lacking(rule.condition, wanted=True)
            if not lacking and all(_is_silent(each, idle) for each in own):
                silent.append(label)
            elif lacking:
                texts = tuple(condition_text(each) for each in lacking)
                near.append(Near(label, texts, sum(map(degrees.way, lacking))))
    nearest = sorted(near, key=lambda each: (len(each.lacking), each.way))
    fewest = [each for each in nearest if len(each.lacking) == len(nearest[0].lacking)]
    return Missing(tuple(asks), tuple(without), tuple(fewest[:NEAREST]), tuple(silent))


def _ask(block: FunctionBlock, variable: str, point: Point) -> Iterator[str]:
    """Yield what a rule could ask of an input at a point: its strongest term, or its degree."""
    own = [each for each in block.fuzzifications if each.variable.casefold() == variable.casefold()]
    term = strongest(own[0], point[variable], point) if own else None
    if term is not None:
        yield f"{variable} IS {term.name}"
    elif not own:
        yield variable if point[variable] > 0 else f"NOT {variable}"


def _is_silent(conclusion: Conclusion, barren_terms: Collection[tuple[str, str]]) -> bool:
    key = (conclusion.variable.casefold(), (conclusion.term or "").casefold())
    return conclusion.weight == 0.0 or key in barren_terms


def _concludes(rule: Rule, output: str) -> bool:
    return any(each.variable.casefold() == output.casefold() for each in rule.conclusions)


def _value(point: Point, variable: str) -> Fraction:
    return next(value for name, value in point.items() if name.casefold() == variable.casefold())


def _asked(block: FunctionBlock, output: str) -> Iterator[str]:
    """Yield the inputs that conditions of rules on an output ask for."""
    for rule_block in block.rule_blocks:
        for rule in rule_block.rules:
            if _concludes(rule, output):
                yield from (each.variable.casefold() for each in leaves(rule.condition))


class _Degrees:
    """The degrees of subconditions at a point."""

    def __init__(self, block: FunctionBlock, point: Point, least: Fraction) -> None:
        self._point = {name.casefold(): value for name, value in point.items()}
        self._least = least
        self._terms = {
            (each.variable.casefold(), term.name.casefold()): (each, term)
            for each in block.fuzzifications
            for term in each.terms
        }

    def lacking(self, condition: Condition, *, wanted: bool) -> list[Condition]:
        """Return the fewest subconditions that keep a condition, or its opposite, from being above 0."""
        match condition:
            case Not(argument=Is() | Degree()) | Is() | Degree():
                return [] if self._holds(condition) == wanted else [condition]
            case Not(argument):
                return self.lacking(argument, wanted=not wanted)
            case And(arguments) | Or(arguments):
                parts = [self.lacking(each, wanted=wanted) for each in arguments]
                if isinstance(condition, And) == wanted:
                    return [leaf for each in parts for leaf in each]
                return min(parts, key=len)

    def way(self, condition: Condition) -> float:
        """Return how far an input is from where a term that it lacks is highest; 0 for other conditions."""
        if not isinstance(condition, Is):
            return 0.0
        found = self._terms.get((condition.variable.casefold(), condition.term.casefold()))
        peaks = _peaks(found[1]) if found else ()
        if found is None or not peaks:
            return 0.0
        own = [place for each in found[0].terms for place in _peaks(each)]
        reach = max(own) - min(own) or 1.0
        x = float(self._point[condition.variable.casefold()])
        return min(abs(x - each) for each in peaks) / reach

    def _holds(self, condition: Condition) -> bool:
        match condition:
            case Not(argument):
                own = self._degree(argument)
                return own is None or 1 - own > self._least
            case _:
                own = self._degree(condition)
                return own is None or own > self._bar(condition)

    def _bar(self, condition: Condition) -> Fraction:
        """Return the degree that a term needs: a part of the strongest one's."""
        if not isinstance(condition, Is) or not self._least:
            return self._least
        found = self._terms.get((condition.variable.casefold(), condition.term.casefold()))
        if found is None:
            return self._least
        x = self._point[condition.variable.casefold()]
        return self._least * max(degree(each, x, self._point) or Fraction(0) for each in found[0].terms)

    def _degree(self, condition: Condition) -> Fraction | None:
        """Return a degree; None where it cannot be told of the point alone."""
        match condition:
            case Degree(variable):
                return self._point.get(variable.casefold())
            case Is(variable, term):
                found = self._terms.get((variable.casefold(), term.casefold()))
                return (
                    None
                    if found is None or condition.hedges
                    else degree(found[1], self._point[variable.casefold()], self._point)
                )
        return None


def _peaks(term: Term) -> list[float]:
    """Return the places at which a term is highest, of those that its shape names; none of a moved one."""
    if not is_constant(term):
        return []
    match term.shape:
        case Points(points):
            places = [(float(each.x), each.degree) for each in points]
        case Curve() as curve:
            turning = turns(curve)
            places = list(zip(turning, degrees_at(curve, np.array(turning)).tolist(), strict=True))
        case _:
            return []
    top = max(degree for _, degree in places)
    return [place for place, degree in places if degree == top]
