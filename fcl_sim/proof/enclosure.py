"""A rule base over boxes of its inputs: bounds of every output, and of its slopes along every input.

Bounds hold whatever the output does within; they get narrower with the boxes.
They are computed in binary64, and rounding is allowed for by what compares them.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fcl_sim.engine.smooth import degrees_at, turns
from fcl_sim.engine.switches import switched
from fcl_sim.model import (
    And,
    Condition,
    Curve,
    CurveKind,
    Defuzzification,
    Degree,
    FunctionBlock,
    Is,
    Method,
    Not,
    Or,
    Point,
    Points,
    Rule,
    RuleBlock,
    Singleton,
    Term,
)
from fcl_sim.proof.axes import is_constant
from fcl_sim.proof.spans import Span, both, constant, either, hedged

Values = NDArray[np.float64]

WANDERING = frozenset(
    (
        CurveKind.GAUSSIAN_PRODUCT,
        CurveKind.SIGMOID_DIFFERENCE,
        CurveKind.SIGMOID_DISTANCE,
        CurveKind.SIGMOID_PRODUCT,
    )
)
"""Curves that may turn where `turns` does not say so."""


class NotEnclosed(ValueError):
    """A rule base has something that is not bounded: the message says what."""


@dataclass(frozen=True, slots=True)
class Boxes:
    """Boxes of the inputs, by the place of each: `low` and `high` (n, inputs)."""

    low: Values
    high: Values

    @property
    def middle(self) -> Values:
        """Their middles."""
        return np.asarray(0.5 * self.low + 0.5 * self.high)

    def __len__(self) -> int:
        return len(self.low)


@dataclass(frozen=True, slots=True)
class Law:
    """What is known of an output over n boxes: bounds, those of its slopes (n, inputs), gaps."""

    low: Values
    high: Values
    falls: Values
    rises: Values
    maybe_undefined: NDArray[np.bool_]


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
        self._accumulation = self._output.accumulation or next(iter(accumulations))

    def rules(self, boxes: Boxes) -> list[tuple[Rule, Span]]:
        """Return every rule with the bounds of its degree, in the order of the text."""
        reader = _Degrees(boxes, self._inputs, self._terms)
        return [
            (rule, reader.of(rule.condition, rule_block))
            for rule_block in self._block.rule_blocks
            for rule in rule_block.rules
        ]

    @property
    def places(self) -> Mapping[str, tuple[float, float]]:
        """From where to where each term of the output lies, by name in lower case."""
        return self._places

    def law(self, boxes: Boxes) -> Law:
        """Return what is known of the output over boxes."""
        return self._defuzzified(self.shares(boxes), len(boxes))

    def shares(self, boxes: Boxes) -> dict[str, Span]:
        """Return the accumulated degree of each term that is concluded, by name in lower case."""
        shares: dict[str, list[Span]] = {}
        for rule, span in self.rules(boxes):
            for each in rule.conclusions:
                if each.variable.casefold() == self._output.variable.casefold() and each.term is not None:
                    own = span
                    for hedge in reversed(each.hedges):
                        own = hedged(own, hedge)
                    if isinstance(each.weight, str):
                        raise NotEnclosed(f"`{each.weight}` is a weight that a variable holds")
                    shares.setdefault(each.term.casefold(), []).append(own.times(each.weight))
        return {term: either(self._accumulation, own) for term, own in shares.items()}

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


class _Degrees:
    """Bounds of the degrees of conditions over boxes; each term is computed once."""

    def __init__(
        self, boxes: Boxes, inputs: Mapping[str, int], terms: Mapping[tuple[str, str], Term]
    ) -> None:
        self._boxes, self._inputs, self._terms = boxes, inputs, terms
        self._known: dict[tuple[str, str], Span] = {}

    def of(self, condition: Condition, operators: RuleBlock) -> Span:
        """Return the bounds of a condition."""
        match condition:
            case Is():
                return self._is(condition)
            case Degree(variable):
                return self._degree(variable.casefold())
            case Not(argument):
                return self.of(argument, operators).opposite
            case And(arguments):
                return both(operators.and_operator, [self.of(each, operators) for each in arguments])
            case Or(arguments):
                return either(operators.or_operator, [self.of(each, operators) for each in arguments])

    def _is(self, condition: Is) -> Span:
        key = (condition.variable.casefold(), condition.term.casefold())
        if not condition.term:
            span = constant(1.0, len(self._boxes), len(self._inputs))
        elif key in self._terms:
            if key not in self._known:
                self._known[key] = self._term(self._inputs[key[0]], self._terms[key])
            span = self._known[key]
        else:
            raise NotEnclosed(f"a condition asks for `{condition.variable}`, which rules conclude")
        for hedge in reversed(condition.hedges):
            span = hedged(span, hedge)
        return span

    def _degree(self, variable: str) -> Span:
        if variable not in self._inputs:
            raise NotEnclosed(f"a condition asks for `{variable}`, which rules conclude")
        place = self._inputs[variable]
        low, high = self._boxes.low[:, place], self._boxes.high[:, place]
        slopes = np.zeros((2, len(low), len(self._inputs)))
        slopes[1, :, place] = (high > 0.0) & (low < 1.0)
        slopes[0, :, place] = (low >= 0.0) & (high <= 1.0)
        return Span(np.clip(low, 0.0, 1.0), np.clip(high, 0.0, 1.0), slopes[0], slopes[1])

    def _term(self, place: int, term: Term) -> Span:
        low, high = self._boxes.low[:, place], self._boxes.high[:, place]
        match term.shape:
            case Points(points) if is_constant(term):
                own = _straight([(float(each.x), each.degree) for each in points], low, high)
            case Curve() as curve if is_constant(term):
                own = _smooth(curve, low, high)
            case _:
                raise NotEnclosed(f"variables move `{term.name}`")
        slopes = np.zeros((2, len(low), len(self._inputs)))
        slopes[:, :, place] = own[2:]
        return Span(own[0], own[1], slopes[0], slopes[1])


def _straight(points: Sequence[tuple[float, float]], low: Values, high: Values) -> Values:
    """Return least and largest degree, and slopes, of base points from `low` to `high`: (4, n)."""
    xs, degrees = np.array([x for x, _ in points]), np.array([degree for _, degree in points])
    ends = np.interp(low, xs, degrees), np.interp(high, xs, degrees)
    found = np.array([np.minimum(*ends), np.maximum(*ends), np.zeros_like(low), np.zeros_like(low)])
    for x, degree in points:
        inside = (low <= x) & (x <= high)
        found[0] = np.where(inside, np.minimum(found[0], degree), found[0])
        found[1] = np.where(inside, np.maximum(found[1], degree), found[1])
    first = np.ones(low.shape, np.bool_)
    pieces = [(-np.inf, xs[0], 0.0)]
    for (left, one), (right, other) in pairwise(points):
        slope = (other - one) / (right - left) if right > left else np.copysign(np.inf, other - one)
        if one != other or right > left:
            pieces.append((left, right, slope))
    pieces.append((xs[-1], np.inf, 0.0))
    for left, right, slope in pieces:
        touched = (low < right) & (high > left) | ((low == high) & (low >= left) & (low <= right))
        if left == right:
            touched = (low <= left) & (high >= left)
        fall, rise = (min(slope, 0.0), max(slope, 0.0)) if left == right else (slope, slope)
        found[2] = np.where(touched, np.where(first, fall, np.minimum(found[2], fall)), found[2])
        found[3] = np.where(touched, np.where(first, rise, np.maximum(found[3], rise)), found[3])
        first &= ~touched
    return found


def _smooth(curve: Curve, low: Values, high: Values) -> Values:
    """Return least and largest degree of a curve from `low` to `high`; its slopes are not followed."""
    ends = [degrees_at(curve, np.ascontiguousarray(each)) for each in (low, high)]
    least, most = np.minimum(*ends), np.maximum(*ends)
    if curve.kind in WANDERING:
        least, most = np.zeros_like(least), np.full_like(most, curve.height)
    for place in turns(curve):
        inside = (low <= place) & (place <= high)
        (degree,) = degrees_at(curve, np.array([float(place)])).tolist()
        least, most = (
            np.where(inside, np.minimum(least, degree), least),
            np.where(inside, np.maximum(most, degree), most),
        )
    return np.array([least, most, np.full_like(low, -np.inf), np.full_like(low, np.inf)])
