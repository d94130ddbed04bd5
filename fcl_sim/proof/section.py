"""The law of an output along one input, the others held: exact, in pieces that are linear-fractional.

Along one input every degree is straight between knots as long as no two degrees that
change are multiplied. So are the shares of the output's terms then, and the output is
a quotient of two straight lines: it rises or falls from the one end of a piece to the
other, and does not change where it is the same at both.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, pairwise
from math import isnan

from fcl_sim.engine.plan_areas import algorithms, grouped
from fcl_sim.engine.straighten import straightened
from fcl_sim.engine.switches import switched
from fcl_sim.model import (
    Accumulation,
    And,
    AndOperator,
    Conclusion,
    Condition,
    Defuzzification,
    Degree,
    FunctionBlock,
    Hedge,
    Is,
    Method,
    Not,
    Or,
    Points,
    RuleBlock,
    Singleton,
)
from fcl_sim.proof.points import Point, membership
from fcl_sim.proof.profiles import (
    Profile,
    changed,
    constant,
    crossings,
    cut,
    largest,
    of_base,
    refined,
    summed,
)
from fcl_sim.proof.rationals import ONE, ZERO, clamped
from fcl_sim.proof.spans import OPPOSITES
from fcl_sim.units import exact

SELECTING = frozenset((Method.LM, Method.RM, Method.MM))
SUMS = frozenset((Accumulation.SUM, Accumulation.NSUM))
"""Accumulations that are sums as far as a quotient of shares goes."""


class NotStraight(ValueError):
    """The law is not made of straight shares along an input: the message says why."""


@dataclass(frozen=True, slots=True)
class Knot:
    """What an output is at `x`, comes from and goes to there; None where no rule is active and it is kept.

    `active` says of the same three whether a rule is.
    """

    x: Fraction
    values: tuple[Fraction | None, Fraction | None, Fraction | None]
    active: tuple[bool, bool, bool]


@dataclass(frozen=True, slots=True)
class Section:
    """An output along `variable`, the knots rising; between two it is monotone."""

    variable: str
    knots: tuple[Knot, ...]

    def same_around(self, x: Fraction) -> tuple[Fraction, Fraction]:
        """Return from where to where it is what it is at `x`, one of its knots."""
        place = next(place for place, each in enumerate(self.knots) if each.x == x)
        wanted = self.knots[place].values[1]
        high = x
        for own, after in pairwise(self.knots[place:]):
            if not own.values[2] == after.values[0] == wanted:
                break
            high = after.x
            if after.values[1] != wanted:
                break
        low = x
        for own, before in pairwise(reversed(self.knots[: place + 1])):
            if not own.values[0] == before.values[2] == wanted:
                break
            low = before.x
            if before.values[1] != wanted:
                break
        return low, high


def section(
    block: FunctionBlock, output: str, variable: str, at: Point, ends: tuple[Fraction, Fraction]
) -> Section:
    """Return an output along an input between two ends, the others being `at` their values.

    `at` has a number for every input; that of `variable` becomes a knot. Raises
    NotStraight where the law along it is made of curves.
    """
    return _Sectioner(block, output, variable, at, ends).section()


class _Sectioner:
    def __init__(
        self,
        block: FunctionBlock,
        output: str,
        variable: str,
        at: Point,
        ends: tuple[Fraction, Fraction],
    ) -> None:
        self._block = straightened(switched(block))
        self._variable = variable
        self._ends = ends
        self._at = {name.casefold(): value for name, value in at.items()}
        self._own = variable.casefold()
        self._output = next(
            each for each in self._block.defuzzifications if each.variable.casefold() == output.casefold()
        )
        self._terms = {
            (each.variable.casefold(), term.name.casefold()): term
            for each in self._block.fuzzifications
            for term in each.terms
        }
        if self._output.method in {Method.COG, Method.COA, Method.SUM}:
            raise NotStraight(f"{self._output.method} is no mean of singletons")

    def section(self) -> Section:
        """Return the section."""
        shares = self._shares()
        places = [self._place(self._output, term) for term in shares]
        xs = {each.x for own in shares.values() for each in own} | {self._at[self._own]}
        if self._output.method in SELECTING:
            for one, other in combinations(shares.values(), 2):
                xs |= set(crossings(one, other))
        own = [refined(each, xs) for each in shares.values()]
        return Section(self._variable, tuple(self._knots(places, own)))

    def _knots(self, places: Sequence[Fraction], own: Sequence[Profile]) -> Iterator[Knot]:
        last = len(own[0]) - 1
        for number, each in enumerate(own[0]):
            at = [profile[number].at for profile in own]
            before = self._limit(
                [(profile[number].before, profile[max(number - 1, 0)].after) for profile in own]
            )
            after = self._limit(
                [(profile[number].after, profile[min(number + 1, last)].before) for profile in own]
            )
            values = [self._value(places, weights) for weights in (before, at, after)]
            yield Knot(each.x, (values[0], values[1], values[2]), (any(before), any(at), any(after)))

    def _limit(self, shares: Sequence[tuple[Fraction, Fraction]]) -> list[Fraction]:
        """Return weights as they are next to a knot, by those there and those at the other end of the piece.

        Where all vanish, it counts how they do so; where the largest counts, which it is within.
        """
        if self._output.method in SELECTING:
            return [(here + there) / 2 for here, there in shares]
        own = [here for here, _ in shares]
        return own if any(own) else [there for _, there in shares]

    def _value(self, places: Sequence[Fraction], weights: Sequence[Fraction]) -> Fraction | None:
        total = sum(weights, ZERO)
        if total == 0:
            default = None if self._output.held else self._output.default
            found = None if default is None or isnan(default) else exact(default)
        elif self._output.method is Method.COGS:
            moments = (place * weight for place, weight in zip(places, weights, strict=True))
            found = sum(moments, ZERO) / total
        else:
            top = max(weights)
            highest = [place for place, weight in zip(places, weights, strict=True) if weight == top]
            ends = {Method.LM: min(highest), Method.RM: max(highest)}
            found = ends.get(self._output.method, (min(highest) + max(highest)) / 2)
        if found is not None and self._output.clamped and self._output.range is not None:
            low, high = map(exact, self._output.range)
            return min(max(found, low), high)
        return found

    def _place(self, output: Defuzzification, name: str) -> Fraction:
        shape = next(each.shape for each in output.terms if each.name.casefold() == name)
        if not isinstance(shape, Singleton):
            raise NotStraight(f"`{name}` of `{output.variable}` is no singleton")
        return self._number(shape.value)

    def _number(self, value: float | str) -> Fraction:
        if not isinstance(value, str):
            return exact(float(value))
        if value.casefold() == self._own:
            raise NotStraight(f"`{value}` moves something itself")
        return self._at[value.casefold()]

    def _shares(self) -> Mapping[str, Profile]:
        """Return the accumulated share of every term that is concluded, by name in lower case."""
        name = self._output.variable.casefold()
        kinds, group_of = grouped(algorithms(self._block, name))
        parts: dict[str, dict[int, list[Profile]]] = {}
        for number, rule_block in enumerate(self._block.rule_blocks):
            for rule in rule_block.rules:
                own = [each for each in rule.conclusions if each.variable.casefold() == name and each.term]
                degree = self._profile(rule.condition, rule_block) if own else ()
                for each in own:
                    groups = parts.setdefault((each.term or "").casefold(), {})
                    groups.setdefault(group_of[number], []).append(self._concluded(each, degree))
        return {
            term: largest([self._accumulated(kinds[group], own) for group, own in groups.items()])
            for term, groups in parts.items()
        }

    def _concluded(self, conclusion: Conclusion, degree: Profile) -> Profile:
        if conclusion.hedges:
            raise NotStraight("a conclusion has hedges")
        weight = clamped(self._number(conclusion.weight))
        return changed(degree, lambda value: weight * value)

    def _accumulated(self, kind: Accumulation, parts: Sequence[Profile]) -> Profile:
        if kind is Accumulation.MAX:
            return largest(parts)
        if kind in SUMS:
            return summed(parts)
        return _opposite(self._both(OPPOSITES[kind], [_opposite(each) for each in parts]))

    def _profile(self, condition: Condition, operators: RuleBlock) -> Profile:
        match condition:
            case Not(argument):
                return _opposite(self._profile(argument, operators))
            case And(arguments):
                return self._both(
                    operators.and_operator, [self._profile(each, operators) for each in arguments]
                )
            case Or(arguments):
                parts = [_opposite(self._profile(each, operators)) for each in arguments]
                return _opposite(self._both(OPPOSITES[operators.or_operator], parts))
            case Degree(variable):
                return self._degree(variable.casefold())
        return self._is(condition)

    def _degree(self, variable: str) -> Profile:
        if variable not in self._at:
            raise NotStraight(f"a condition asks for `{variable}`, which rules conclude")
        if variable == self._own:
            return of_base(((ZERO, ZERO), (ONE, ONE)), *self._ends)
        return constant(clamped(self._at[variable]), *self._ends)

    def _is(self, condition: Is) -> Profile:
        variable, term = condition.variable.casefold(), condition.term.casefold()
        if not term:
            own = constant(ONE, *self._ends)
        elif (variable, term) not in self._terms:
            raise NotStraight(f"a condition asks for `{condition.variable}`, which rules conclude")
        else:
            own = self._term(variable, term)
        for hedge in reversed(condition.hedges):
            if hedge is Hedge.NOT:
                own = _opposite(own)
            elif hedge is Hedge.ANY:
                own = constant(ONE, *self._ends)
            else:
                raise NotStraight(f"`{hedge}` bends a degree")
        return own

    def _term(self, variable: str, term: str) -> Profile:
        shape = self._terms[variable, term].shape
        if not isinstance(shape, Points):
            raise NotStraight(f"`{self._terms[variable, term].name}` is smooth")
        base: list[tuple[Fraction, Fraction]] = []
        for each in shape.points:
            x = self._number(each.x)
            base.append((max(x, base[-1][0]) if base else x, exact(each.degree)))
        if variable == self._own:
            return of_base(tuple(base), *self._ends)
        return constant(membership(tuple(base), self._at[variable]), *self._ends)

    def _both(self, operator: AndOperator, parts: Sequence[Profile]) -> Profile:
        """Return AND; a degree that does not change may be multiplied."""
        match operator:
            case AndOperator.MIN:
                return _opposite(largest([_opposite(each) for each in parts]))
            case AndOperator.PROD:
                return self._product(parts)
            case AndOperator.BDIF:
                reduced = [parts[0], *(changed(each, lambda value: value - 1) for each in parts[1:])]
                return changed(cut(summed(reduced), ZERO), lambda value: max(ZERO, value))
        raise NotStraight(f"{operator} bends degrees")

    def _product(self, parts: Sequence[Profile]) -> Profile:
        factor, moving = ONE, []
        for each in parts:
            if all(own.before == own.at == own.after == each[0].at for own in each):
                factor *= each[0].at
            else:
                moving.append(each)
        if len(moving) > 1 and factor > 0:
            raise NotStraight("degrees that change together are multiplied")
        if not moving or factor == 0:
            return constant(factor, *self._ends)
        return changed(moving[0], lambda value: factor * value)


def _opposite(own: Profile) -> Profile:
    return changed(own, lambda value: 1 - value)
