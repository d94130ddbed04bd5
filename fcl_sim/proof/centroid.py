"""Bounds of CoG and CoA where the degrees are known within bounds only.

The reach of the output is cut into cells in which all terms are straight. A cell's
area has a least and a largest content; the centre of gravity is farthest to the right
where the contents are the least ones up to some cell and the largest ones from there
on (Karnik and Mendel). Within a cell an area of some content cannot lie farther to the
right than if it filled the cell's end up to its largest height.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fcl_sim.engine.grid import Base
from fcl_sim.model import Activation, Method

Values = NDArray[np.float64]

CELLS = 96
"""Cells at least, besides those that breakpoints make."""


@dataclass(frozen=True, slots=True)
class Activated:
    """What a term is activated by over n boxes: bounds (n,) of the degree, and the weight (A.15)."""

    term: int
    activation: Activation
    low: Values
    high: Values
    weight: float


@dataclass(frozen=True, slots=True)
class Reach:
    """The reach of an output in cells: `edges` (c + 1,), and each term's degrees at both ends (terms, c)."""

    edges: Values
    left: Values
    right: Values


def reach_of(bases: Sequence[Base], low: float, high: float) -> Reach:
    """Return the cells between the ends of an output's reach, with the degrees of terms (S20, S21)."""
    inner = {float(x) for base in bases for x, _ in base if low < float(x) < high}
    edges = np.array(sorted({*np.linspace(low, high, CELLS + 1).tolist(), *inner}))
    left = np.array(
        [[_beside(base, a, b, first=True) for a, b in pairwise(edges.tolist())] for base in bases]
    )
    right = np.array(
        [[_beside(base, a, b, first=False) for a, b in pairwise(edges.tolist())] for base in bases]
    )
    return Reach(edges, left, right)


def _beside(base: Base, a: float, b: float, *, first: bool) -> float:
    """Return the degree at an end of a cell, as a limit from within."""
    points = [(float(x), float(degree)) for x, degree in base]
    x = a if first else b
    for (left, low), (right, high) in pairwise(points):
        if left <= a and b <= right and left < right:
            return low + (high - low) * (x - left) / (right - left)
    return points[0][1] if b <= points[0][0] else points[-1][1]


def bounds(method: Method, reach: Reach, parts: Sequence[Activated]) -> tuple[Values, Values, Values]:
    """Return least and largest value of an output whose parts MAX joins, and its least area: (n,) each."""
    widths = np.diff(reach.edges)
    low, _ = _contents(reach, parts, widths, upper=False)
    high, top = _contents(reach, parts, widths, upper=True)
    least = low.sum(axis=1)
    if method is Method.COA:
        return (*_halves(reach, low, high), least)
    packed = np.divide(low, 2.0 * top, out=np.zeros_like(low), where=top > 0.0)
    most = _extreme(low, high, reach.edges[1:] - packed)
    fewest = -_extreme(low[:, ::-1], high[:, ::-1], -(reach.edges[:-1] + packed)[:, ::-1])
    return fewest, most, least


def _contents(
    reach: Reach, parts: Sequence[Activated], widths: Values, *, upper: bool
) -> tuple[Values, Values]:
    """Return the least or largest content of each cell, and its largest height: (n, c) each.

    An activated term is straight in a cell or bends down once: its content is at least that
    under the chord, and the largest of several is nowhere above that of the chords by more
    than the deepest bend.
    """
    boxes = len(parts[0].low)
    left, right = np.zeros((boxes, len(widths))), np.zeros((boxes, len(widths)))
    bend, chord = np.zeros_like(left), np.zeros_like(left)
    for each in parts:
        degree = (each.high if upper else each.low)[:, None]
        a, b = reach.left[each.term][None, :], reach.right[each.term][None, :]
        if each.activation is Activation.PROD:
            first, last = degree * a, degree * b
        else:
            first, last = np.minimum(degree, a), np.minimum(degree, b)
            rise = np.abs(b - a)
            above = (degree - np.minimum(a, b)) * (np.maximum(a, b) - degree)
            own = np.divide(above, rise, out=np.zeros_like(first), where=(rise > 0.0) & (above > 0.0))
            bend = np.maximum(bend, each.weight * own)
        first, last = each.weight * first, each.weight * last
        left, right = np.maximum(left, first), np.maximum(right, last)
        chord = np.maximum(chord, 0.5 * (first + last))
    if not upper:
        return chord * widths, np.maximum(left, right)
    return (0.5 * (left + right) + bend) * widths, np.maximum(left, right) + bend


def _extreme(low: Values, high: Values, places: Values) -> Values:
    """Return the largest mean of rising places (n, c), the contents within bounds."""
    nothing = np.zeros((len(low), 1))
    before = np.hstack([nothing, np.cumsum(low, axis=1)])
    moment = np.hstack([nothing, np.cumsum(low * places, axis=1)])
    after = np.hstack([np.cumsum(high[:, ::-1], axis=1)[:, ::-1], nothing])
    rest = np.hstack([np.cumsum((high * places)[:, ::-1], axis=1)[:, ::-1], nothing])
    total = before + after
    means = np.divide(moment + rest, total, out=np.full_like(total, -np.inf), where=total > 0.0)
    found = means.max(axis=1)
    return np.asarray(np.where(np.isfinite(found), found, np.nan))


def _halves(reach: Reach, low: Values, high: Values) -> tuple[Values, Values]:
    """Return from where to where half of the area may be reached (S33a)."""
    return -_half(low[:, ::-1], high[:, ::-1], -reach.edges[::-1]), _half(low, high, reach.edges)


def _half(low: Values, high: Values, edges: Values) -> Values:
    """Return the first edge up to which there is surely more than behind it."""
    before = np.cumsum(low, axis=1)
    behind = np.cumsum(high[:, ::-1], axis=1)[:, ::-1]
    behind = np.hstack([behind[:, 1:], np.zeros((len(low), 1))])
    enough = before > behind
    first = np.argmax(enough, axis=1)
    return np.asarray(np.where(enough.any(axis=1), edges[1:][first], edges[-1]))
