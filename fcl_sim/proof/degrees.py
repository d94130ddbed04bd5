"""Bounds of the degrees of conditions over boxes of the inputs, and of their slopes along every input."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fcl_sim.engine.smooth import degrees_at, turns
from fcl_sim.model import (
    And,
    Condition,
    Curve,
    CurveKind,
    Degree,
    Is,
    Not,
    Or,
    Point,
    Points,
    RuleBlock,
    Term,
)
from fcl_sim.proof.axes import is_constant
from fcl_sim.proof.spans import Span, both, constant, either, hedged
from fcl_sim.proof.steepness import slopes_of

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

    @property
    def reach(self) -> list[float]:
        """How far they all go together along each input."""
        together: list[float] = (self.high.max(axis=0) - self.low.min(axis=0)).tolist()
        return together

    def __len__(self) -> int:
        return len(self.low)


class Degrees:
    """Bounds of the degrees of conditions over boxes; each term is computed once."""

    def __init__(
        self, boxes: Boxes, inputs: Mapping[str, int], terms: Mapping[tuple[str, str], Term]
    ) -> None:
        self._boxes, self._inputs, self._terms = boxes, inputs, terms
        self._known: dict[tuple[str, str], Span] = {}

    def weight(self, weight: float | str) -> Span:
        """Return the bounds of a weight."""
        if isinstance(weight, str):
            return self._degree(weight.casefold())
        return constant(weight, len(self._boxes), len(self._inputs))

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
            case Points(points):
                return self._moved(place, points)
            case _:
                raise NotEnclosed(f"variables move `{term.name}`")
        slopes = np.zeros((2, len(low), len(self._inputs)))
        slopes[:, :, place] = own[2:]
        return Span(own[0], own[1], slopes[0], slopes[1])

    def _moved(self, place: int, points: Sequence[Point]) -> Span:
        """Return the bounds of a term whose points are moved, each the largest so far (S22)."""
        low, high = self._boxes.low, self._boxes.high
        movers = [self._inputs[each.x.casefold()] for each in points if isinstance(each.x, str)]
        ends = []
        for end, so_far in ((low, -np.inf), (high, -np.inf)):
            found: list[Values] = []
            for each in points:
                own = end[:, self._inputs[each.x.casefold()]] if isinstance(each.x, str) else float(each.x)
                found.append(np.maximum(found[-1] if found else so_far, own) + np.zeros(len(low)))
            ends.append(np.array(found))
        own = moved_bounds(ends[0], ends[1], [each.degree for each in points], low[:, place], high[:, place])
        slopes = np.zeros((2, len(low), len(self._inputs)))
        slopes[0][:, movers], slopes[1][:, movers] = -np.inf, np.inf
        slopes[:, :, place] = own[2:] if place not in movers else slopes[:, :, place]
        return Span(own[0], own[1], slopes[0], slopes[1])


def moved_bounds(lows: Values, highs: Values, degrees: Sequence[float], low: Values, high: Values) -> Values:
    """Return least and largest degree, and slopes, of points within `lows` and `highs` (points, n): (4, n).

    Along a stretch between two points the part that is passed rises with x, and falls with both points.
    """
    first, last = low <= highs[0], high >= lows[-1]
    least = np.where(first, degrees[0], np.inf)
    most = np.where(first, degrees[0], -np.inf)
    least, most = (
        np.where(last, np.minimum(least, degrees[-1]), least),
        np.where(last, np.maximum(most, degrees[-1]), most),
    )
    falls, rises = (np.where(first | last, 0.0, end) for end in (np.inf, -np.inf))
    for place, (one, other) in enumerate(pairwise(degrees)):
        met = (low <= highs[place + 1]) & (high >= lows[place])
        widths = (
            np.maximum(lows[place + 1] - highs[place], 0.0),
            np.maximum(highs[place + 1] - lows[place], 0.0),
        )
        with np.errstate(divide="ignore", invalid="ignore"):
            least_part = np.where(low > highs[place], (low - highs[place]) / widths_of(highs, place), 0.0)
            most_part = np.where(high < lows[place + 1], (high - lows[place]) / widths_of(lows, place), 1.0)
            steep = [np.where(width > 0.0, (other - one) / width, np.inf * (other - one)) for width in widths]
        parts = np.nan_to_num(np.clip([least_part, most_part], 0.0, 1.0))
        ends = one + (other - one) * parts
        slopes = np.nan_to_num(np.array(steep), nan=0.0, posinf=np.inf, neginf=-np.inf)
        least = np.where(met, np.minimum(least, ends.min(axis=0)), least)
        most = np.where(met, np.maximum(most, ends.max(axis=0)), most)
        falls = np.where(met, np.minimum(falls, slopes.min(axis=0)), falls)
        rises = np.where(met, np.maximum(rises, slopes.max(axis=0)), rises)
    return np.array([least, most, falls, rises])


def widths_of(ends: Values, place: int) -> Values:
    """Return how far a point is from the next."""
    return np.asarray(ends[place + 1] - ends[place])


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
    """Return least and largest degree of a curve from `low` to `high`, and slopes: (4, n)."""
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
    return np.array([least, most, *slopes_of(curve, low, high)])
