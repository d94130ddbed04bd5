"""The plan of an output whose terms have areas: what is accumulated where, and room to work in.

Under norms of the Open Level, every conclusion is activated by itself, but for
those that MAX joins: there only the largest degree counts. Otherwise:

Under PROD a term's activated results differ in one factor, so that one word
accumulates it. Under MIN with MAX, those of one weight differ in the degree
where the term is cut off; with a sum, every conclusion is cut off by itself.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

from fcl_sim.engine.conditions import NORM_CODE
from fcl_sim.engine.grid import Base
from fcl_sim.model import (
    Accumulation,
    Activation,
    Conclusion,
    Defuzzification,
    FunctionBlock,
    Point,
    Points,
    RuleBlock,
    Term,
)

EXACT = frozenset((Activation.MIN, Activation.PROD))
"""What cuts polylines off, or lowers them."""
Weight = float | str
Key = tuple[Any, ...]


@dataclass(frozen=True, slots=True)
class Pair:
    """A word of the memory that cuts a term off (MIN), or is its factor (PROD); under MIN, the weight."""

    word: int
    activation: Activation
    weight: Weight


@dataclass(frozen=True, slots=True)
class Part:
    """What one term contributes to an accumulation: the sum of its pairs' results."""

    term: int
    pairs: tuple[Pair, ...]


@dataclass(frozen=True, slots=True)
class Target:
    """Where a conclusion accumulates: a word, whether it is summed there, and whether weighted before."""

    word: int
    summed: bool
    weighted: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class AreaPlan:
    """How one output with areas is accumulated.

    `words` is how many words it takes; `targets` has the conclusions on it by
    (rule block, rule, conclusion), `groups` its accumulations, and `curved` tells
    which of them activate or accumulate by norms of the Open Level. `bases` are the
    terms' points within `limits`, empty where there is nothing but 0; None
    where points are moved. `limits` are None where moved points have no RANGE.
    `counts` says how many points each term has at most.
    """

    words: int
    targets: Mapping[tuple[int, int, int], Target]
    groups: tuple[tuple[Accumulation, tuple[Part, ...]], ...]
    curved: tuple[bool, ...]
    limits: tuple[float, float] | None
    bases: tuple[Base, ...] | None
    counts: tuple[int, ...]


def algorithms(block: FunctionBlock, variable: str) -> dict[int, Accumulation]:
    """Return by rule block, of those that conclude on a variable, the algorithm it accumulates by (S8)."""
    own = [each.accumulation for each in block.defuzzifications if each.variable.casefold() == variable]
    return {
        index: (own and own[0]) or rule_block.accumulation
        for index, rule_block in enumerate(block.rule_blocks)
        if any(each.variable.casefold() == variable for rule in rule_block.rules for each in rule.conclusions)
    }


def grouped(kinds: Mapping[int, Accumulation]) -> tuple[tuple[Accumulation, ...], dict[int, int]]:
    """Return the accumulations, one where the rule blocks agree (S26), and the group of each rule block."""
    agreed = len(set(kinds.values())) <= 1
    numbers = {index: 0 if agreed else group for group, index in enumerate(kinds)}
    chosen = tuple(kinds.values())
    return (chosen[:1] if agreed else chosen) or (Accumulation.MAX,), numbers


def plan_area(block: FunctionBlock, output: Defuzzification, at: int) -> AreaPlan:
    """Return the plan of `output`, whose accumulated words begin at `at`."""
    variable = output.variable.casefold()
    kinds, group_of = grouped(algorithms(block, variable))
    curved = [
        kind in NORM_CODE or not _activations(block, group_of, group) <= EXACT
        for group, kind in enumerate(kinds)
    ]
    names = {term.name.casefold(): number for number, term in enumerate(output.terms)}
    words: dict[Key, int] = {}
    parts: list[dict[Key, dict[int, Pair]]] = [{} for _ in kinds]
    targets = {}
    for place, rule_block, each in conclusions(block):
        if each.variable.casefold() == variable and each.term is not None:
            group, term = group_of[place[0]], names[each.term.casefold()]
            kind, activation = kinds[group], rule_block.activation
            part, key = _keys(kind, activation, term, each, place, curved=curved[group])
            word = words.setdefault((group, *key), at + len(words))
            prod = activation is Activation.PROD and not curved[group]
            parts[group].setdefault(part, {})[word] = Pair(word, activation, 1.0 if prod else each.weight)
            targets[place] = Target(word, prod and kind is not Accumulation.MAX, prod)
    shapes = [points_of(term) for term in output.terms]
    limits = _limits(output, shapes)
    moved = any(isinstance(point.x, str) for points in shapes for point in points)
    bases = None if moved or limits is None else tuple(_within(_base(points), limits) for points in shapes)
    return AreaPlan(
        words=len(words),
        targets=targets,
        groups=tuple(
            (kind, tuple(Part(part[0], tuple(own.values())) for part, own in members.items()))
            for kind, members in zip(kinds, parts, strict=True)
        ),
        curved=tuple(curved),
        limits=limits,
        bases=bases,
        counts=tuple(len(points) + 2 for points in shapes) if bases is None else tuple(map(len, bases)),
    )


def _activations(block: FunctionBlock, group_of: Mapping[int, int], group: int) -> set[Activation]:
    """Return by what the rule blocks of a group activate."""
    return {block.rule_blocks[index].activation for index, own in group_of.items() if own == group}


def _keys(
    kind: Accumulation,
    activation: Activation,
    term: int,
    conclusion: Conclusion,
    place: tuple[int, int, int],
    *,
    curved: bool,
) -> tuple[Key, Key]:
    """Return what conclusions of one part, and of one word in it, have in common."""
    if curved:
        joined = kind is Accumulation.MAX
        return (term,), (term, activation, conclusion.weight) if joined else (term, *place)
    if kind is Accumulation.MAX:
        part = (term, activation, 1.0 if activation is Activation.PROD else conclusion.weight)
        return part, part
    return (term,), (term,) if activation is Activation.PROD else (term, *place)


def conclusions(block: FunctionBlock) -> Iterator[tuple[tuple[int, int, int], RuleBlock, Conclusion]]:
    """Yield every conclusion with its place (rule block, rule, conclusion) and its rule block."""
    for number, rule_block in enumerate(block.rule_blocks):
        for place, rule in enumerate(rule_block.rules):
            for index, each in enumerate(rule.conclusions):
                yield (number, place, index), rule_block, each


def points_of(term: Term) -> tuple[Point, ...]:
    """Return the base points of a term that has an area."""
    if not isinstance(term.shape, Points):
        raise TypeError(term)
    return term.shape.points


def _limits(output: Defuzzification, shapes: Sequence[Sequence[Point]]) -> tuple[float, float] | None:
    """Return RANGE, else the hull of constant points (S32), else None."""
    if output.range is not None:
        return output.range
    xs = [point.x for points in shapes for point in points]
    numbers = [x for x in xs if not isinstance(x, str)]
    return (min(numbers), max(numbers)) if len(numbers) == len(xs) else None


def _base(points: Sequence[Point]) -> Base:
    return tuple((Fraction(point.x), Fraction(point.degree)) for point in points)


def _within(base: Base, limits: tuple[float, float]) -> Base:
    """Return a term's points from limit to limit, without what is 0 at both ends."""
    low, high = map(Fraction, limits)
    inside = [(x, degree) for x, degree in base if low <= x <= high]
    if not inside or inside[0][0] > low:
        inside.insert(0, (low, _between(base, low)))
    if inside[-1][0] < high:
        inside.append((high, _between(base, high)))
    nonzero = [number for number, (_, degree) in enumerate(inside) if degree > 0]
    return tuple(inside[max(0, nonzero[0] - 1) : nonzero[-1] + 2]) if nonzero else ()


def _between(base: Base, x: Fraction) -> Fraction:
    """Return the degree at `x`, where no base point lies."""
    if x < base[0][0]:
        return base[0][1]
    for (left, low), (right, high) in pairwise(base):
        if left < x < right:
            return low + (high - low) * (x - left) / (right - left)
    return base[-1][1]
