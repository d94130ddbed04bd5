"""Terms of an input whose degrees are to add up to 1: where they miss it, and the base point that does it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fcl_sim.model import Fuzzification, Points, Term
from fcl_sim.proof.axes import ZERO, Axis, is_straight

NEARLY = Fraction(1, 10)
"""How far a sum of degrees may be from 1 to be taken for a slip, wherever it comes from."""
ROUNDED = Fraction(1, 10**9)
"""How far it may be by rounding."""

Values = NDArray[np.float64]
Line = list[tuple[float, float]]
"""The base points of a term."""


@dataclass(frozen=True, slots=True)
class Slip:
    """A base point of a term, at `place`, that would have the degrees add up to 1 at `better`."""

    term: Term
    place: float
    better: float


@dataclass(frozen=True, slots=True)
class OffOne:
    """Where the sum of an input's degrees is farthest from 1, what it is there, and because of what."""

    at: Fraction
    total: Fraction
    slip: Slip | None


def off_one(axis: Axis, fuzzification: Fuzzification) -> OffOne | None:
    """Return where the sum of all degrees misses 1, if it is nearly 1 at all of the terms' points.

    Or if one base point alone keeps it from being 1, while others are matched.
    """
    terms = fuzzification.terms
    if len(terms) < 2 or not all(map(is_straight, terms)):
        return None
    sums = []
    for place, cell in enumerate(axis.cells):
        if cell.is_point and cell.low is not None:
            total = sum((each[place] for each in axis.highs.values()), ZERO)
            sums.append((cell.low, total))
    at, worst = max(sums, key=lambda each: abs(each[1] - 1), default=(ZERO, Fraction(1)))
    if abs(worst - 1) <= ROUNDED:
        return None
    slip = next(_slips(terms), None)
    if abs(worst - 1) > NEARLY and (slip is None or not _is_matched_elsewhere(terms, slip)):
        return None
    return OffOne(at, worst, slip)


def _lines(terms: Sequence[Term]) -> list[Line]:
    return [
        [(float(point.x), point.degree) for point in each.shape.points]
        for each in terms
        if isinstance(each.shape, Points)
    ]


def _slips(terms: Sequence[Term]) -> Iterator[Slip]:
    """Yield the single base points that, moved to a place of another term's, make all sums 1."""
    lines = _lines(terms)
    for number, (term, line) in enumerate(zip(terms, lines, strict=True)):
        others = sorted({x for each in lines if each is not line for x, _ in each})
        for place, (x, degree) in enumerate(line):
            low = line[place - 1][0] if place else -np.inf
            high = line[place + 1][0] if place + 1 < len(line) else np.inf
            for better in others:
                if low < better < high and better != x:
                    moved = [*line[:place], (better, degree), *line[place + 1 :]]
                    if _is_one([*lines[:number], moved, *lines[number + 1 :]]):
                        yield Slip(term, x, better)


def _is_one(lines: Sequence[Line]) -> bool:
    places = np.array(sorted({x for line in lines for x, _ in line}))
    middles = 0.5 * places[1:] + 0.5 * places[:-1]
    return all(bool((np.abs(_sums(lines, each) - 1.0) <= float(ROUNDED)).all()) for each in (places, middles))


def _sums(lines: Sequence[Line], places: Values) -> Values:
    return np.asarray(np.sum([_degrees(each, places) for each in lines], axis=0))


def _degrees(line: Line, places: Values) -> Values:
    xs, degrees = ([each[axis] for each in line] for axis in (0, 1))
    return np.asarray(np.interp(places, xs, degrees))


def _is_matched_elsewhere(terms: Sequence[Term], slip: Slip) -> bool:
    """Return whether two terms share a flank that the slip has no part in: then the sum is meant to be 1."""
    lines = _lines(terms)
    own = next(line for term, line in zip(terms, lines, strict=True) if term is slip.term)
    at = [x for x, _ in own].index(slip.place)
    ends = [slip.better, *(x for x, _ in own[max(at - 1, 0) : at + 2])]
    for left, right in pairwise(sorted({x for line in lines for x, _ in line})):
        if right <= min(ends) or left >= max(ends):
            middle = np.array([0.5 * left + 0.5 * right])
            if sum(bool(_degrees(each, middle)[0] > 0.0) for each in lines) > 1:
                return True
    return False
