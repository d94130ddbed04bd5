"""Where no rule fires within a cell, under BDIF and BSUM, too: by half-spaces.

In a cell every degree is straight in the place there, from 0 to 1 along each input. That
a rule fires is then an alternative of systems of linear inequalities, as long as no
products are added up. BDIF of a and b is above 0 where a + b is above 1.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

from fcl_sim.model import (
    And,
    AndOperator,
    Condition,
    Degree,
    FunctionBlock,
    Hedge,
    Is,
    Not,
    Or,
    OrOperator,
    RuleBlock,
)
from fcl_sim.proof.axes import Axis, Cell, base_of, is_straight
from fcl_sim.proof.inequalities import Inequality, TooMany, solution
from fcl_sim.proof.points import membership
from fcl_sim.proof.profiles import of_base
from fcl_sim.proof.spans import OPPOSITES

ZERO, ONE = Fraction(0), Fraction(1)
MOST = 300
"""Systems of inequalities of a rule that are looked at."""
DUALS: Mapping[AndOperator, OrOperator] = {
    both: either for either, both in OPPOSITES.items() if isinstance(either, OrOperator)
}


ALL = frozenset((AndOperator.MIN, AndOperator.PROD, AndOperator.HPROD, AndOperator.EPROD))
"""AND that is above 0 where all its arguments are."""
ANY = frozenset((OrOperator.MAX, OrOperator.ASUM, OrOperator.BSUM, OrOperator.HSUM, OrOperator.ESUM))
"""OR that is above 0 where any of its arguments is."""


class NotLinear(ValueError):
    """That a rule fires is no matter of linear inequalities."""


@dataclass(frozen=True, slots=True)
class Straight:
    """`constant` plus the sum of `factors` times the places along inputs, by their axis."""

    constant: Fraction
    factors: tuple[tuple[int, Fraction], ...] = ()

    @property
    def opposite(self) -> "Straight":
        """1 minus it."""
        return Straight(1 - self.constant, tuple((axis, -factor) for axis, factor in self.factors))


@dataclass(frozen=True, slots=True)
class Joined:
    """Degrees joined by an operator."""

    operator: AndOperator | OrOperator
    parts: tuple["Expression", ...]


Expression = Straight | Joined
System = tuple[Inequality, ...]
Literal = Callable[[str, str | None], Straight]


class HalfSpaces:
    """The rules of a block that conclude on an output, in cells of its axes."""

    def __init__(self, block: FunctionBlock, axes: Sequence[Axis], output: str) -> None:
        self._axes = {each.variable.casefold(): place for place, each in enumerate(axes)}
        self._bases = {
            (each.variable.casefold(), term.name.casefold()): base_of(term)
            for each in block.fuzzifications
            for term in each.terms
            if is_straight(term)
        }
        self._known: dict[tuple[int, Cell, str | None], Straight] = {}
        self._names = [each.variable.casefold() for each in axes]
        self._conditions = [
            (rule.condition, rule_block, each.weight)
            for rule_block in block.rule_blocks
            for rule in rule_block.rules
            for each in rule.conclusions
            if each.variable.casefold() == output.casefold() and each.weight != 0.0
        ]

    def undefined(self, cells: Sequence[Cell]) -> list[Fraction] | None:
        """Return a place in a cell at which no rule fires, by axis; None where every place has one.

        Raises NotLinear where that cannot be told.
        """
        waiting = []
        for system in self._systems(cells):
            left = _undecided(system)
            if left is not None and not left:
                return None  # it holds everywhere
            if left is not None:
                waiting.append(left)
        sides = [
            Inequality(((axis, sign),), constant, strict=True)
            for axis, cell in enumerate(cells)
            if not cell.is_point
            for sign, constant in ((ONE, ZERO), (-ONE, ONE))
        ]
        try:
            found = _escaping(sides, sorted(waiting, key=len), len(cells))
        except TooMany:
            raise NotLinear from None
        return None if found is None else [_place(*each) for each in zip(cells, found, strict=True)]

    def _systems(self, cells: Sequence[Cell]) -> Iterator[System]:
        def literal(variable: str, term: str | None) -> Straight:
            return self._literal(cells, variable, term)

        for condition, rule_block, weight in self._conditions:
            own = _expression(condition, rule_block, literal, negated=False)
            systems = _above([own], ZERO)
            if isinstance(weight, str):
                systems = _both([systems, _above([literal(weight.casefold(), None)], ZERO)])
            yield from systems

    def _literal(self, cells: Sequence[Cell], variable: str, term: str | None) -> Straight:
        axis = self._axes.get(variable)
        if axis is None:
            raise NotLinear(variable)
        key = (axis, cells[axis], term)
        if key not in self._known:
            self._known[key] = self._in(axis, cells[axis], term)
        return self._known[key]

    def _in(self, axis: int, cell: Cell, term: str | None) -> Straight:
        base = ((ZERO, ZERO), (ONE, ONE)) if term is None else self._bases.get((self._names[axis], term))
        if base is None:
            raise NotLinear(term)
        if cell.is_point or cell.low is None or cell.high is None:
            return Straight(membership(base, cell.middle))
        ends = of_base(base, cell.low, cell.high)
        first, last = ends[0].after, ends[-1].before
        return Straight(first, ((axis, last - first),) if last != first else ())


def _place(cell: Cell, part: Fraction) -> Fraction:
    if cell.low is None or cell.high is None:
        return cell.middle
    return cell.low + part * (cell.high - cell.low)


def _expression(condition: Condition, operators: RuleBlock, literal: Literal, *, negated: bool) -> Expression:
    """Return a condition, or its opposite, with NOT in front of nothing but its subconditions."""
    match condition:
        case Not(argument):
            return _expression(argument, operators, literal, negated=not negated)
        case And(arguments) | Or(arguments):
            operator: AndOperator | OrOperator = (
                operators.and_operator if isinstance(condition, And) else operators.or_operator
            )
            if negated:
                operator = DUALS[operator] if isinstance(operator, AndOperator) else OPPOSITES[operator]
            return Joined(
                operator,
                tuple(_expression(each, operators, literal, negated=negated) for each in arguments),
            )
        case Degree(variable):
            own = literal(variable.casefold(), None)
        case Is(variable, term):
            own = literal(variable.casefold(), term.casefold()) if term else Straight(ONE)
            for hedge in reversed(condition.hedges):
                if hedge is Hedge.ANY:
                    own = Straight(ONE)
                elif hedge is Hedge.NOT:
                    own = own.opposite
                else:
                    raise NotLinear(hedge)
        case _:
            raise TypeError(condition)
    return own.opposite if negated else own


def _above(parts: Sequence[Expression], constant: Fraction) -> list[System]:
    """Return when the sum of expressions and a constant is above 0: alternatives of systems."""
    place = next((place for place, each in enumerate(parts) if isinstance(each, Joined)), None)
    if place is None:
        return [(_inequality([each for each in parts if isinstance(each, Straight)], constant),)]
    chosen, rest = parts[place], [*parts[:place], *parts[place + 1 :]]
    if not isinstance(chosen, Joined):
        raise TypeError(chosen)
    if not rest and constant == 0:
        return _alone(chosen)
    match chosen.operator:
        case AndOperator.MIN:
            return _both([_above([*rest, each], constant) for each in chosen.parts])
        case OrOperator.MAX:
            return _either([_above([*rest, each], constant) for each in chosen.parts])
        case AndOperator.BDIF:
            whole = _above([*rest, *chosen.parts], constant - (len(chosen.parts) - 1))
            return _either([_above(rest, constant), whole])
        case OrOperator.BSUM:
            return _both([_above(rest, constant + 1), _above([*rest, *chosen.parts], constant)])
    raise NotLinear(chosen.operator)


def _alone(own: Joined) -> list[System]:
    """Return when an expression itself is above 0."""
    if own.operator is AndOperator.BDIF:
        return _above(own.parts, Fraction(1 - len(own.parts)))
    if own.operator in ALL:
        return _both([_above([each], ZERO) for each in own.parts])
    if own.operator in ANY:
        return _either([_above([each], ZERO) for each in own.parts])
    raise NotLinear(own.operator)


def _both(alternatives: Sequence[list[System]]) -> list[System]:
    size = 1
    for each in alternatives:
        size *= len(each)
    if size > MOST:
        raise NotLinear
    return [tuple(own for system in chosen for own in system) for chosen in product(*alternatives)]


def _either(alternatives: Sequence[list[System]]) -> list[System]:
    found = [system for each in alternatives for system in each]
    if len(found) > MOST:
        raise NotLinear
    return found


def _inequality(parts: Sequence[Straight], constant: Fraction) -> Inequality:
    factors: dict[int, Fraction] = {}
    for each in parts:
        constant += each.constant
        for axis, factor in each.factors:
            factors[axis] = factors.get(axis, ZERO) + factor
    return Inequality(
        tuple(sorted((axis, factor) for axis, factor in factors.items() if factor != 0)),
        constant,
        strict=True,
    )


def _undecided(system: System) -> System | None:
    """Return those inequalities that hold in a part of the cell alone; None where one holds nowhere."""
    left = []
    for each in system:
        least = each.constant + sum(min(factor, ZERO) for _, factor in each.factors)
        most = each.constant + sum(max(factor, ZERO) for _, factor in each.factors)
        if most <= 0:
            return None
        if least < 0 or (least == 0 and not each.factors):
            left.append(each)
    return tuple(left)


def _escaping(kept: list[Inequality], systems: Sequence[System], axes: int) -> list[Fraction] | None:
    """Return a place that keeps to some inequalities and misses one of every system; None without any."""
    found = solution(kept, axes)
    if found is None or not systems:
        return found
    for each in systems[0]:
        missed = Inequality(
            tuple((axis, -factor) for axis, factor in each.factors), -each.constant, strict=False
        )
        place = _escaping([*kept, missed], systems[1:], axes)
        if place is not None:
            return place
    return None
