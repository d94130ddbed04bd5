"""Numbers between two ends, many at a time: degrees, and their slopes along the inputs.

A span holds for n boxes the ends (n,) of a quantity; a slope span those of its
derivative along each input. Operators are those of Tables 3 to 5 and the Open
Level: all are monotone in each argument.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from fcl_sim.model import Accumulation, AndOperator, Hedge, OrOperator

Values = NDArray[np.float64]

Norm = Callable[[Values, Values], Values]


@dataclass(frozen=True, slots=True)
class Span:
    """The ends of a quantity over n boxes, and of its slopes along d inputs, (n, d) each."""

    low: Values
    high: Values
    falls: Values
    rises: Values

    @property
    def opposite(self) -> "Span":
        """1 minus it."""
        return Span(1.0 - self.high, 1.0 - self.low, -self.rises, -self.falls)

    def times(self, factor: float) -> "Span":
        """Return it times a factor that is not negative."""
        return Span(factor * self.low, factor * self.high, factor * self.falls, factor * self.rises)


def constant(value: float, boxes: int, inputs: int) -> Span:
    """Return a number as a span."""
    same, flat = np.full(boxes, value), np.zeros((boxes, inputs))
    return Span(same, same, flat, flat)


def both(operator: AndOperator, parts: Sequence[Span]) -> Span:
    """Return AND."""
    return reduce(lambda one, other: _and(operator, one, other), parts)


def either(operator: OrOperator | Accumulation, parts: Sequence[Span]) -> Span:
    """Return OR, or an accumulation, by de Morgan's law; NSUM and SUM are the plain sum."""
    if operator in {Accumulation.SUM, Accumulation.NSUM}:
        return reduce(_sum, parts)
    opposite = OPPOSITES[operator]
    return reduce(lambda one, other: _and(opposite, one.opposite, other.opposite).opposite, parts)


OPPOSITES: dict[OrOperator | Accumulation, AndOperator] = {
    OrOperator.MAX: AndOperator.MIN,
    OrOperator.ASUM: AndOperator.PROD,
    OrOperator.BSUM: AndOperator.BDIF,
    OrOperator.HSUM: AndOperator.HPROD,
    OrOperator.ESUM: AndOperator.EPROD,
    OrOperator.DSUM: AndOperator.DPROD,
    OrOperator.NMAX: AndOperator.NMIN,
    Accumulation.MAX: AndOperator.MIN,
    Accumulation.ASUM: AndOperator.PROD,
    Accumulation.BSUM: AndOperator.BDIF,
    Accumulation.HSUM: AndOperator.HPROD,
    Accumulation.ESUM: AndOperator.EPROD,
    Accumulation.DSUM: AndOperator.DPROD,
    Accumulation.NMAX: AndOperator.NMIN,
}


def _sum(one: Span, other: Span) -> Span:
    return Span(one.low + other.low, one.high + other.high, one.falls + other.falls, one.rises + other.rises)


def _and(operator: AndOperator, one: Span, other: Span) -> Span:
    norm = NORMS[operator]
    low, high = norm(one.low, other.low), norm(one.high, other.high)
    match operator:
        case AndOperator.MIN:
            falls, rises = _of_lesser(one, other)
        case AndOperator.PROD:
            first, second = _scaled(one, other), _scaled(other, one)
            falls, rises = first[0] + second[0], first[1] + second[1]
        case AndOperator.BDIF:
            falls, rises = _of_difference(one, other)
        case _:  # their slopes are not followed
            falls, rises = _unknown(one, other)
    return Span(low, high, falls, rises)


def _of_lesser(one: Span, other: Span) -> tuple[Values, Values]:
    """Return the slopes of MIN: those of the one that is surely less, else of both."""
    first, second = (one.high < other.low)[:, None], (other.high < one.low)[:, None]
    falls = np.where(first, one.falls, np.where(second, other.falls, np.minimum(one.falls, other.falls)))
    rises = np.where(first, one.rises, np.where(second, other.rises, np.maximum(one.rises, other.rises)))
    return falls, rises


def _of_difference(one: Span, other: Span) -> tuple[Values, Values]:
    """Return the slopes of BDIF: those of the sum, or 0 where it may be cut off."""
    falls, rises = one.falls + other.falls, one.rises + other.rises
    whole, none = (one.low + other.low >= 1.0)[:, None], (one.high + other.high <= 1.0)[:, None]
    cut_falls, cut_rises = np.minimum(falls, 0.0), np.maximum(rises, 0.0)
    return (
        np.where(whole, falls, np.where(none, 0.0, cut_falls)),
        np.where(whole, rises, np.where(none, 0.0, cut_rises)),
    )


def _scaled(slopes: Span, by: Span) -> tuple[Values, Values]:
    """Return the slopes of one span times the other, which is not negative."""
    low, high = by.low[:, None], by.high[:, None]
    with np.errstate(invalid="ignore"):  # an edge times 0
        falls = np.fmin(slopes.falls * low, slopes.falls * high)
        rises = np.fmax(slopes.rises * low, slopes.rises * high)
    return np.nan_to_num(falls, nan=0.0, neginf=-np.inf), np.nan_to_num(rises, nan=0.0, posinf=np.inf)


def _unknown(one: Span, other: Span) -> tuple[Values, Values]:
    moves = (one.falls < 0.0) | (one.rises > 0.0) | (other.falls < 0.0) | (other.rises > 0.0)
    return np.where(moves, -np.inf, 0.0), np.where(moves, np.inf, 0.0)


def _hamacher(a: Values, b: Values) -> Values:
    below = a + b - a * b
    return np.divide(a * b, below, out=np.zeros_like(below), where=below > 0.0)


def _einstein(a: Values, b: Values) -> Values:
    found: Values = a * b / (2.0 - (a + b - a * b))
    return found


NORMS: dict[AndOperator, Norm] = {
    AndOperator.MIN: np.minimum,
    AndOperator.PROD: np.multiply,
    AndOperator.BDIF: lambda a, b: np.maximum(0.0, a + b - 1.0),
    AndOperator.HPROD: _hamacher,
    AndOperator.EPROD: _einstein,
    AndOperator.DPROD: lambda a, b: np.where(np.maximum(a, b) >= 1.0, np.minimum(a, b), 0.0),
    AndOperator.NMIN: lambda a, b: np.where(a + b > 1.0, np.minimum(a, b), 0.0),
}


def hedged(span: Span, hedge: Hedge) -> Span:
    """Return what a hedge makes of a span; slopes are followed through `very` and NOT alone."""
    boxes, inputs = span.falls.shape
    match hedge:
        case Hedge.ANY:
            return constant(1.0, boxes, inputs)
        case Hedge.NOT:
            return span.opposite
        case Hedge.VERY:
            return _and(AndOperator.PROD, span, span)
    formula = HEDGES[hedge]
    falls, rises = _unknown(span, span)
    return Span(formula(span.low), formula(span.high), falls, rises)


HEDGES: dict[Hedge, Callable[[Values], Values]] = {
    Hedge.EXTREMELY: lambda a: np.where(a <= 0.5, 2.0 * a * a, 1.0 - 2.0 * (1.0 - a) ** 2),
    Hedge.SOMEWHAT: np.sqrt,
    Hedge.SELDOM: lambda a: np.where(a <= 0.5, np.sqrt(a / 2.0), 1.0 - np.sqrt((1.0 - a) / 2.0)),
}
