"""A rule base over boxes of its inputs: bounds of every output, and of its slopes along every input.

Bounds hold whatever the output does within; they get narrower with the boxes.
They are computed in binary64, and rounding is allowed for by what compares them.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fcl_sim.engine.plan_areas import EXACT
from fcl_sim.engine.switches import switched
from fcl_sim.model import (
    Accumulation,
    Activation,
    AndOperator,
    Defuzzification,
    FunctionBlock,
    Method,
    Point,
    Points,
    Rule,
    RuleBlock,
    Singleton,
)
from fcl_sim.proof.axes import base_of, is_constant
from fcl_sim.proof.centroid import Activated, Reach, bounds, reach_of
from fcl_sim.proof.degrees import Boxes, Degrees, NotEnclosed
from fcl_sim.proof.spans import Span, both, either, hedged

Values = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Law:
    """What is known of an output over n boxes: bounds, those of its slopes (n, inputs), gaps."""

    low: Values
    high: Values
    falls: Values
    rises: Values
    maybe_undefined: NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class _Concluded:
    """A conclusion: its term in lower case, the bounds of its rule's degree and weight, and how it acts."""

    term: str
    span: Span
    weight: Span
    activation: Activation
    constant: float | None
    """The weight where no variable holds it."""


class Enclosure:
    """Bounds of one output of a block."""

    def __init__(self, block: FunctionBlock, output: str) -> None:
        self._block = switched(block)
        self._inputs = {each.name.casefold(): place for place, each in enumerate(block.inputs)}
        self._output = next(
            each for each in self._block.defuzzifications if each.variable.casefold() == output.casefold()
        )
        self._terms = {
            (each.variable.casefold(), term.name.casefold()): term
            for each in self._block.fuzzifications
            for term in each.terms
        }
        self._places = _places(self._output)
        accumulations = {
            each.accumulation for each in self._block.rule_blocks if _concludes(each, self._output.variable)
        }
        if len(accumulations) > 1 and self._output.accumulation is None:
            raise NotEnclosed("its rule blocks disagree on ACCU")
        self._accumulation = self._output.accumulation or next(iter(accumulations), Accumulation.MAX)
        self._reach = self._area_reach()

    def rules(self, boxes: Boxes) -> list[tuple[Rule, Span]]:
        """Return every rule with the bounds of its degree, in the order of the text."""
        return [(rule, span) for _, rule, span in self._read(Degrees(boxes, self._inputs, self._terms))]

    @property
    def places(self) -> Mapping[str, tuple[float, float]]:
        """From where to where each term of the output lies, by name in lower case."""
        return self._places

    def law(self, boxes: Boxes) -> Law:
        """Return what is known of the output over boxes."""
        concluded = self._concluded(boxes)
        if not concluded:
            return self._without_a_rule(len(boxes))
        law = self._defuzzified(self._accumulated(concluded), len(boxes))
        return law if self._reach is None else self._of_area(law, concluded, self._reach)

    @property
    def follows_slopes(self) -> bool:
        """Whether slopes may have bounds."""
        return self._output.method is Method.COGS

    def shares(self, boxes: Boxes) -> dict[str, Span]:
        """Return the accumulated degree of each term that is concluded, by name in lower case."""
        return self._accumulated(self._concluded(boxes))

    def _concluded(self, boxes: Boxes) -> list[_Concluded]:
        """Return every conclusion on the output, with the bounds of its degree before its weight."""
        reader = Degrees(boxes, self._inputs, self._terms)
        found = []
        for rule_block, rule, span in self._read(reader, only=self._output.variable):
            for each in rule.conclusions:
                if each.variable.casefold() == self._output.variable.casefold() and each.term is not None:
                    own = span
                    for hedge in reversed(each.hedges):
                        own = hedged(own, hedge)
                    term, weight = each.term.casefold(), reader.weight(each.weight)
                    fixed = None if isinstance(each.weight, str) else each.weight
                    found.append(_Concluded(term, own, weight, rule_block.activation, fixed))
        return found

    def _read(self, reader: Degrees, only: str = "") -> Iterator[tuple[RuleBlock, Rule, Span]]:
        """Yield rules with the bounds of their degrees, in their order; `only` those on a variable."""
        for rule_block in self._block.rule_blocks:
            for rule in rule_block.rules:
                if not only or any(each.variable.casefold() == only.casefold() for each in rule.conclusions):
                    yield rule_block, rule, reader.of(rule.condition, rule_block)

    def _accumulated(self, concluded: Sequence[_Concluded]) -> dict[str, Span]:
        shares: dict[str, list[Span]] = {}
        for each in concluded:
            own = (
                both(AndOperator.PROD, [each.span, each.weight])
                if each.constant is None
                else each.span.times(each.constant)
            )
            shares.setdefault(each.term, []).append(own)
        return {term: either(self._accumulation, own) for term, own in shares.items()}

    def _area_reach(self) -> Reach | None:
        """Return the cells of an output whose areas are followed; None of any other."""
        shapes = [each.shape for each in self._output.terms]
        activations = {
            each.activation for each in self._block.rule_blocks if _concludes(each, self._output.variable)
        }
        if (
            self._output.method not in {Method.COG, Method.COA}
            or self._accumulation is not Accumulation.MAX
            or not activations <= EXACT
            or not all(isinstance(each, Points) for each in shapes)
        ):
            return None
        bases = [base_of(each) for each in self._output.terms]
        xs = [float(x) for base in bases for x, _ in base]
        low, high = self._output.range or (min(xs), max(xs))
        return reach_of(bases, low, high)

    def _of_area(self, law: Law, concluded: Sequence[_Concluded], reach: Reach) -> Law:
        """Return narrower bounds of a centre of gravity, or of area."""
        names = [each.name.casefold() for each in self._output.terms]
        groups: dict[tuple[str, Activation, float], list[_Concluded]] = {}
        for each in concluded:
            if each.constant is None:
                return law
            groups.setdefault((each.term, each.activation, each.constant), []).append(each)
        parts = [
            Activated(
                names.index(term),
                activation,
                np.max([each.span.low for each in own], axis=0),
                np.max([each.span.high for each in own], axis=0),
                weight,
            )
            for (term, activation, weight), own in groups.items()
        ]
        low, high, least = bounds(self._output.method, reach, parts)
        undefined = law.maybe_undefined | ~(least > 0.0)
        low, high = self._with_default(low, high, undefined)
        return replace(law, low=low, high=high, maybe_undefined=undefined)

    def _without_a_rule(self, boxes: int) -> Law:
        """Return what is known of an output that no rule concludes on: its default."""
        none = np.full(boxes, np.inf)
        low, high = self._with_default(none, -none, np.ones(boxes, dtype=bool))
        flat = np.full((boxes, len(self._inputs)), np.inf)
        return Law(low, high, -flat, flat, np.ones(boxes, dtype=bool))

    def _defuzzified(self, spans: Mapping[str, Span], boxes: int) -> Law:
        names = sorted(spans, key=lambda each: self._places[each])
        lows = np.array([spans[each].low for each in names])
        highs = np.array([spans[each].high for each in names])
        undefined = np.asarray(~(lows > 0.0).any(axis=0))
        if self._output.method is Method.COGS and all(low == high for low, high in self._places.values()):
            places = np.array([self._places[each][0] for each in names])
            low, high = average(lows, highs, places)
            falls, rises = _slopes([spans[each] for each in names], places, low, high)
        else:
            low, high = self._hull(names, highs)
            flat = np.full((boxes, len(self._inputs)), np.inf)
            falls, rises = -flat, flat
        low, high = self._with_default(low, high, undefined)
        falls = np.where(undefined[:, None], -np.inf, falls)
        rises = np.where(undefined[:, None], np.inf, rises)
        if self._output.clamped and self._output.range is not None:
            low, high = (np.clip(each, *self._output.range) for each in (low, high))
        return Law(low, high, falls, rises, undefined)

    def _hull(self, names: Sequence[str], highs: Values) -> tuple[Values, Values]:
        """Return from the least to the largest place of the terms that may count."""
        ends = [self._places[each] for each in names]
        may = highs > 0.0
        low = np.min(np.where(may, np.array([[end] for end, _ in ends]), np.inf), axis=0)
        high = np.max(np.where(may, np.array([[end] for _, end in ends]), -np.inf), axis=0)
        return low, high

    def _with_default(self, low: Values, high: Values, undefined: NDArray[np.bool_]) -> tuple[Values, Values]:
        default = self._output.default
        marks = [default] if default is not None and not self._output.held else self._kept()
        return (
            np.where(undefined, np.fmin(low, min(marks)), low),
            np.where(undefined, np.fmax(high, max(marks)), high),
        )

    def _kept(self) -> list[float]:
        """Return the ends of what NC may keep: anything that was given out before, or at first."""
        name = self._output.variable.casefold()
        initial = next(each.initial for each in self._block.outputs if each.name.casefold() == name)
        return [initial or 0.0, *(end for ends in self._places.values() for end in ends)]


def _places(output: Defuzzification) -> dict[str, tuple[float, float]]:
    """Return from where to where each term of an output lies."""
    found = {}
    for term in output.terms:
        match term.shape:
            case Singleton(value) if not isinstance(value, str):
                found[term.name.casefold()] = (float(value), float(value))
            case Points(points) if is_constant(term):
                found[term.name.casefold()] = _reach(points, output.range)
            case _:
                raise NotEnclosed(f"`{term.name}` of `{output.variable}` is moved, or smooth")
    return found


def _reach(points: Sequence[Point], limits: tuple[float, float] | None) -> tuple[float, float]:
    """Return from where to where a term with an area reaches: to the RANGE where it does not end before."""
    first, last = float(points[0].x), float(points[-1].x)
    if limits is None:
        return first, last
    low = limits[0] if points[0].degree > 0.0 else max(first, limits[0])
    high = limits[1] if points[-1].degree > 0.0 else min(last, limits[1])
    return low, high


def _concludes(rule_block: RuleBlock, variable: str) -> bool:
    return any(
        each.variable.casefold() == variable.casefold()
        for rule in rule_block.rules
        for each in rule.conclusions
    )


def average(lows: Values, highs: Values, places: Values) -> tuple[Values, Values]:
    """Return bounds of the mean of rising `places` (k,), the weights within `lows` and `highs` (k, n).

    The largest has the upper weights from some place on and the lower before.
    """
    bounds = []
    for below, above in ((lows, highs), (highs, lows)):
        weights = np.cumsum(np.vstack([np.zeros_like(below[:1]), below]), axis=0)
        moments = np.cumsum(np.vstack([np.zeros_like(below[:1]), below * places[:, None]]), axis=0)
        rest = np.cumsum(np.vstack([np.zeros_like(above[:1]), above[::-1]]), axis=0)[::-1]
        rest_moments = np.cumsum(
            np.vstack([np.zeros_like(above[:1]), (above * places[:, None])[::-1]]), axis=0
        )[::-1]
        total, moment = weights + rest, moments + rest_moments
        bounds.append(np.divide(moment, total, out=np.full_like(total, np.nan), where=total > 0.0))
    high, low = bounds
    with np.errstate(all="ignore"):
        return np.fmin.reduce(low, axis=0), np.fmax.reduce(high, axis=0)


def _slopes(spans: Sequence[Span], places: Values, low: Values, high: Values) -> tuple[Values, Values]:
    """Return bounds of the slopes of the mean, Σ w' (s - y) / Σ w: the narrower ones of two forms."""
    total_low = np.sum([each.low for each in spans], axis=0)
    total_high = np.sum([each.high for each in spans], axis=0)
    apart = np.zeros((2, *spans[0].falls.shape))
    moment, total = apart.copy(), apart.copy()
    for span, place in zip(spans, places.tolist(), strict=True):
        moment += _product(span.falls, span.rises, place, place)
        total += np.array([span.falls, span.rises])
        apart += _product(span.falls, span.rises, (place - high)[:, None], (place - low)[:, None])
    drift = _product(total[0], total[1], low[:, None], high[:, None])
    falls = np.maximum(apart[0], moment[0] - drift[1])
    rises = np.minimum(apart[1], moment[1] - drift[0])
    with np.errstate(divide="ignore", invalid="ignore"):
        small, large = total_low[:, None], total_high[:, None]
        falls = np.where(falls < 0.0, falls / small, falls / large)
        rises = np.where(rises > 0.0, rises / small, rises / large)
    return np.nan_to_num(falls, nan=-np.inf, neginf=-np.inf), np.nan_to_num(rises, nan=np.inf, posinf=np.inf)


def _product(low: Values, high: Values, other_low: Values | float, other_high: Values | float) -> Values:
    """Return the ends of a product of two quantities by theirs."""
    with np.errstate(invalid="ignore"):
        ends = np.array([low * other_low, low * other_high, high * other_low, high * other_high])
    ends = np.nan_to_num(ends, nan=0.0, posinf=np.inf, neginf=-np.inf)
    return np.array([ends.min(axis=0), ends.max(axis=0)])
