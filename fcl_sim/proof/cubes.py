"""Conditions → cubes: the products of sets of cells, one set for each input, in which a rule fires.

A degree is above 0, and 1 minus it is, as its operators have it:

    MIN PROD HPROD EPROD   above 0 where all arguments are; below 1 where any is
    MAX ASUM HSUM ESUM     above 0 where any argument is; below 1 where all are
    BDIF NMIN DPROD        above 0 possibly where all arguments are, surely where all but one are 1, too
    BSUM NMAX DSUM         below 1 possibly where all arguments are, surely where all but one are 0, too

With `fires` taken for `has at least so much of it` the same holds for thresholds.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import reduce

import numpy as np

from fcl_sim.model import (
    Accumulation,
    And,
    AndOperator,
    Conclusion,
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
from fcl_sim.proof.axes import Axis, Flags, Literal, Sure

Cube = Mapping[int, Flags]
"""By the place of an axis, the cells that it has of it; of other axes it has all."""
Cubes = tuple[Cube, ...]

EVERYTHING: Cubes = ({},)
NOTHING: Cubes = ()

MOST = 4096
"""Cubes of one condition; of one with more it is known only that it may fire."""

LOSING = frozenset((AndOperator.BDIF, AndOperator.NMIN, AndOperator.DPROD))
"""AND that may be 0 though no argument is."""
REACHING = frozenset((OrOperator.BSUM, OrOperator.NMAX, OrOperator.DSUM))
"""OR that may be 1 though no argument is."""


@dataclass(frozen=True, slots=True)
class Reach:
    """Where a degree is above 0, and where 1 minus it is.

    Each is `exact` if it is so there and nowhere else, so that what is not in it is known, too.
    """

    holds: Cubes
    fails: Cubes
    holds_exact: bool = True
    fails_exact: bool = True

    @property
    def opposite(self) -> "Reach":
        """That of NOT."""
        return Reach(self.fails, self.holds, self.fails_exact, self.holds_exact)


ALWAYS = Reach(EVERYTHING, NOTHING)
NEVER = Reach(NOTHING, EVERYTHING)


@dataclass(frozen=True, slots=True, kw_only=True)
class Firing:
    """Where a conclusion of a rule is above 0, weight included; `rule` counts through the text.

    `exact` says that it is so there and nowhere else.
    """

    rule: int
    conclusion: Conclusion
    cubes: Cubes
    exact: bool


def firings(
    block: FunctionBlock, axes: Sequence[Axis], *, certain: bool, least: float = 0.0
) -> tuple[Firing, ...]:
    """Return where each conclusion fires: surely, or possibly. A weight of `least` or less does not."""
    return _Reader(block, axes, certain=certain, least=least).read()


def asked(block: FunctionBlock) -> Iterator[Is | Degree]:
    """Yield what the conditions of a block ask for, less hedges and NOT."""
    for rule_block in block.rule_blocks:
        for rule in rule_block.rules:
            yield from leaves(rule.condition)


def leaves(condition: Condition) -> Iterator[Is | Degree]:
    """Yield the subconditions that ask for one degree."""
    match condition:
        case Not(argument):
            yield from leaves(argument)
        case And(arguments) | Or(arguments):
            for each in arguments:
                yield from leaves(each)
        case _:
            yield condition


class _Reader:
    """Reads rules in the order of the text, since a condition may ask for what was concluded before (S29)."""

    def __init__(self, block: FunctionBlock, axes: Sequence[Axis], *, certain: bool, least: float) -> None:
        self._block = block
        self._certain = certain
        self._least = least
        self._axes = axes
        self._asked = {each.variable.casefold() for each in asked(block)}
        self._coarse = False  # whether a condition had too many cubes
        self._places = {each.variable.casefold(): place for place, each in enumerate(axes)}
        self._concluded: dict[tuple[str, str | None], Reach] = {}

    def read(self) -> tuple[Firing, ...]:
        found = []
        rule = 0
        for rule_block in self._block.rule_blocks:
            for each in rule_block.rules:
                reach = self._reach(each.condition, rule_block)
                for conclusion in each.conclusions:
                    own = self._weighted(reach, conclusion)
                    if conclusion.variable.casefold() in self._asked:
                        self._remember(conclusion, own, rule_block)
                    found.append(
                        Firing(rule=rule, conclusion=conclusion, cubes=own.holds, exact=own.holds_exact)
                    )
                rule += 1
        return tuple(found)

    def _weighted(self, reach: Reach, conclusion: Conclusion) -> Reach:
        for hedge in reversed(conclusion.hedges):
            reach = _hedged(reach, hedge)
        weight = conclusion.weight
        if isinstance(weight, str):
            return self._all((reach, self._literal(weight, None)))
        if weight <= self._least:
            return NEVER
        return Reach(reach.holds, EVERYTHING, reach.holds_exact) if weight < 1.0 else reach

    def _remember(self, conclusion: Conclusion, own: Reach, rule_block: RuleBlock) -> None:
        key = (conclusion.variable.casefold(), conclusion.term and conclusion.term.casefold())
        before = self._concluded.get(key, NEVER)
        found = self._any((before, own))
        if rule_block.accumulation is not Accumulation.MAX and before != NEVER:
            found = Reach(found.holds, NOTHING if self._certain else found.fails, fails_exact=False)
        self._concluded[key] = found

    def _reach(self, condition: Condition, operators: RuleBlock) -> Reach:
        match condition:
            case Is():
                return self._is(condition)
            case Degree(variable):
                return self._literal(variable, None)
            case Not(argument):
                return self._reach(argument, operators).opposite
            case And(arguments):
                parts = [self._reach(each, operators) for each in arguments]
                return self._and(parts, operators.and_operator)
            case Or(arguments):
                parts = [self._reach(each, operators).opposite for each in arguments]
                return self._or(parts, operators.or_operator)

    def _is(self, condition: Is) -> Reach:
        reach = self._literal(condition.variable, condition.term) if condition.term else ALWAYS
        for hedge in reversed(condition.hedges):
            reach = _hedged(reach, hedge)
        return reach

    def _literal(self, variable: str, term: str | None) -> Reach:
        key = term and term.casefold()
        place = self._places.get(variable.casefold())
        if place is None:
            return self._concluded.get((variable.casefold(), key), NEVER)
        literal: Literal = self._axes[place].literals[key]
        known = [bool((each.surely == each.possibly).all()) for each in (literal.holds, literal.fails)]
        return Reach(self._cells(place, literal.holds), self._cells(place, literal.fails), *known)

    def _cells(self, place: int, sure: Sure) -> Cubes:
        flags = sure.of(certain=self._certain)
        return EVERYTHING if flags.all() else ({place: flags},) if flags.any() else NOTHING

    def _and(self, parts: Sequence[Reach], operator: AndOperator) -> Reach:
        found = self._all(parts)
        return self._reduced(parts, found) if operator in LOSING else found

    def _or(self, opposites: Sequence[Reach], operator: OrOperator) -> Reach:
        """Return the reach of OR by de Morgan's law, from those of NOT its arguments."""
        found = self._all(opposites)
        return (self._reduced(opposites, found) if operator in REACHING else found).opposite

    def _reduced(self, parts: Sequence[Reach], found: Reach) -> Reach:
        """Return the reach of an AND that may be 0 though no argument is."""
        holds = _but_one(parts) if self._certain else found.holds
        return replace(found, holds=holds, holds_exact=False)

    def _all(self, parts: Sequence[Reach]) -> Reach:
        return Reach(
            reduce(self._product, (each.holds for each in parts), EVERYTHING),
            self._union([each.fails for each in parts]),
            all(each.holds_exact for each in parts) and not self._coarse,
            all(each.fails_exact for each in parts) and not self._coarse,
        )

    def _any(self, parts: Sequence[Reach]) -> Reach:
        return self._all([each.opposite for each in parts]).opposite

    def _product(self, one: Cubes, other: Cubes) -> Cubes:
        if len(one) * len(other) > MOST:
            self._coarse = True
            return NOTHING if self._certain else EVERYTHING
        return tuple(both for a in one for b in other if (both := _intersection(a, b)) is not None)

    def _union(self, parts: Sequence[Cubes]) -> Cubes:
        found = [each for cubes in parts for each in cubes]
        if any(not each for each in found):
            return EVERYTHING
        if len(found) > MOST:
            self._coarse = True
            return NOTHING if self._certain else EVERYTHING
        return _joined(found)


def _hedged(reach: Reach, hedge: Hedge) -> Reach:
    """Return the reach after a hedge: those that change a degree leave 0 and 1 where they are."""
    if hedge is Hedge.ANY:
        return ALWAYS
    return reach.opposite if hedge is Hedge.NOT else reach


def _but_one(parts: Sequence[Reach]) -> Cubes:
    """Return where all arguments are surely 1 but one, which is above 0.

    Whether an argument is 1 is told of those that one axis decides.
    """
    found: list[Cube] = []
    for place, part in enumerate(parts):
        others = [_one(each) for other, each in enumerate(parts) if other != place]
        for cube in part.holds:
            both: Cube | None = cube
            for each in others:
                both = None if both is None or each is None else _intersection(both, each)
            if both is not None:
                found.append(both)
    return _joined(found)


def _one(part: Reach) -> Cube | None:
    """Return where a degree is surely 1, as one cube, where that can be told."""
    if not part.fails_exact or len(part.holds) != 1 or len(part.fails) > 1:
        return None
    (held,) = part.holds
    if not part.fails:
        return held
    (failed,) = part.fails
    if len(failed) != 1:
        return None
    ((place, flags),) = failed.items()
    return _intersection(held, {place: ~flags})


def _intersection(one: Cube, other: Cube) -> Cube | None:
    both = dict(one)
    for place, flags in other.items():
        common = both[place] & flags if place in both else flags
        if not common.any():
            return None
        both[place] = common
    return both


def _joined(cubes: Sequence[Cube]) -> Cubes:
    """Return cubes with those joined that are of one axis alone, and none twice."""
    single: dict[int, Flags] = {}
    others: dict[tuple[tuple[int, bytes], ...], Cube] = {}
    for each in cubes:
        if len(each) == 1:
            ((place, flags),) = each.items()
            single[place] = single[place] | flags if place in single else flags
        else:
            others[tuple(sorted((place, flags.tobytes()) for place, flags in each.items()))] = each
    if any(flags.all() for flags in single.values()):
        return EVERYTHING
    return (*({place: flags} for place, flags in single.items()), *others.values())


WORD = 64
"""Cubes that are looked at together, a bit of a word each."""


def painted(shape: Sequence[int], cubes: Sequence[Cube]) -> Flags:
    """Return the cells of a space of `shape` that are in any of the cubes.

    A run of an axis has a bit for each cube that it is in; a cell is in those whose bit all its runs have.
    """
    found = np.zeros(shape, np.bool_)
    for start in range(0, len(cubes), WORD):
        some = cubes[start : start + WORD]
        kind = np.min_scalar_type(2 ** len(some) - 1)
        bits = (np.ones((), kind) << np.arange(len(some), dtype=kind)).astype(kind)
        words = np.bitwise_or.reduce(bits)
        for axis, size in enumerate(shape):
            own = [each[axis] if axis in each else np.ones(size, np.bool_) for each in some]
            runs = np.bitwise_or.reduce(np.where(np.array(own), bits[:, None], kind.type(0)), axis=0)
            words = np.bitwise_and.outer(words, runs)
        found |= words != 0
    return found


def left_out(shape: Sequence[int], cubes: Sequence[Cube]) -> Flags:
    """Return the cells of a space of `shape` that are in none of the cubes."""
    return np.asarray(~painted(shape, cubes))
