"""Which rule is missing at a point, and which of those that are there are nearest to firing."""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from fcl_sim.fcl.write_rules import condition_text
from fcl_sim.model import And, Condition, Degree, FunctionBlock, Is, Not, Or
from fcl_sim.model.labels import unique_labels
from fcl_sim.proof.cubes import leaves
from fcl_sim.proof.points import Point, degree, strongest

NEAREST = 3
"""Rules that are named."""


@dataclass(frozen=True, slots=True)
class Near:
    """A rule by its label, and the subconditions of it that do not hold, as FCL."""

    label: str
    lacking: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Missing:
    """`terms` are the strongest of each input at a point, by variable; `rules` those nearest to firing there.

    An input that has no term above 0 there is in `without`: no rule could ask for one.
    """

    terms: tuple[tuple[str, str], ...]
    without: tuple[str, ...]
    rules: tuple[Near, ...]


def missing_at(block: FunctionBlock, output: str, point: Point, least: Fraction = Fraction(0)) -> Missing:
    """Return what is missing for an output at a point where no rule fires, or none counts by `least`."""
    terms, without = [], []
    asked = set(_asked(block, output))
    for each in block.fuzzifications:
        if each.variable.casefold() in asked:
            found = strongest(each, _value(point, each.variable))
            if found is None:
                without.append(each.variable)
            else:
                terms.append((each.variable, found.name))
    degrees = _Degrees(block, point, least)
    labels = unique_labels(block)
    near = []
    rules = [rule for each in block.rule_blocks for rule in each.rules]
    for label, rule in zip(labels, rules, strict=True):
        if any(each.variable.casefold() == output.casefold() for each in rule.conclusions):
            lacking = degrees.lacking(rule.condition, wanted=True)
            if lacking:
                near.append(Near(label, tuple(lacking)))
    fewest = min((len(each.lacking) for each in near), default=0)
    nearest = tuple(each for each in near if len(each.lacking) == fewest)
    return Missing(tuple(terms), tuple(without), nearest[:NEAREST])


def _value(point: Point, variable: str) -> Fraction:
    return next(value for name, value in point.items() if name.casefold() == variable.casefold())


def _asked(block: FunctionBlock, output: str) -> Iterator[str]:
    """Yield the inputs that conditions of rules on an output ask for."""
    for rule_block in block.rule_blocks:
        for rule in rule_block.rules:
            if any(each.variable.casefold() == output.casefold() for each in rule.conclusions):
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

    def lacking(self, condition: Condition, *, wanted: bool) -> list[str]:
        """Return the fewest subconditions that keep a condition, or its opposite, from being above 0."""
        match condition:
            case Not(argument=Is() | Degree()) | Is() | Degree():
                return [] if self._holds(condition) == wanted else [condition_text(condition)]
            case Not(argument):
                return self.lacking(argument, wanted=not wanted)
            case And(arguments) | Or(arguments):
                parts = [self.lacking(each, wanted=wanted) for each in arguments]
                if isinstance(condition, And) == wanted:
                    return [text for each in parts for text in each]
                return min(parts, key=len)

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
        return self._least * max(degree(each, x) or Fraction(0) for each in found[0].terms)

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
                    else degree(found[1], self._point[variable.casefold()])
                )
        return None
