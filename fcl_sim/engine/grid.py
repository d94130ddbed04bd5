"""The merged grid of a fuzzified variable: knots, cells, and a segment of each term per cell.

All of it is computed in fractions and rounded once.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

Base = tuple[tuple[Fraction, Fraction], ...]
"""Base points (abscissa, degree) of a membership function, in rising order."""


@dataclass(frozen=True, slots=True)
class Segment:
    """A straight piece: degree = value + slope (x - origin); the origin is its lower end."""

    origin: Fraction
    value: Fraction
    slope: Fraction


@dataclass(frozen=True, slots=True)
class Cell:
    """An open interval between knots, or a knot: by function, its segment and bounds of its degree."""

    segments: tuple[Segment, ...]
    bounds: tuple[tuple[Fraction, Fraction], ...]


@dataclass(frozen=True, slots=True)
class Grid:
    """Knots, rising; cell 2 k is the interval before knot k, cell 2 k + 1 is knot k itself."""

    knots: tuple[Fraction, ...]
    cells: tuple[Cell, ...]


def complement(base: Base) -> Base:
    """Return the base points of NOT: 1 minus each degree."""
    return tuple((x, 1 - degree) for x, degree in base)


def merge(functions: Sequence[Base]) -> Grid:
    """Return the grid that has a knot at every base point of `functions`."""
    knots = tuple(sorted({x for base in functions for x, _ in base}))
    columns = [_column(base, knots) for base in functions]
    cells = [
        Cell(tuple(segment for segment, _ in row), tuple(bounds for _, bounds in row))
        for row in zip(*columns, strict=True)
    ]
    return Grid(knots, tuple(cells))


def _column(base: Base, knots: Sequence[Fraction]) -> Iterable[tuple[Segment, tuple[Fraction, Fraction]]]:
    """Return a function's segment and bounds in each cell, from left to right."""
    column = []
    after = 0  # first point beyond the cell
    for knot in knots:
        column.append(_between(base, after))
        here = after
        while after < len(base) and base[after][0] == knot:
            after += 1
        column.append(_at(base, here, after, knot))
    column.append(_between(base, after))
    return column


def _between(base: Base, after: int) -> tuple[Segment, tuple[Fraction, Fraction]]:
    """Return the segment between the points `after - 1` and `after`; S20 beyond the ends."""
    if after == 0 or after == len(base):
        return _constant(base[max(after - 1, 0)][1])
    (left, low), (right, high) = base[after - 1], base[after]
    if low == high:
        return _constant(low)
    slope = (high - low) / (right - left)
    lower = Segment(left, low, slope) if low < high else Segment(right, high, slope)
    return lower, (min(low, high), max(low, high))


def _at(base: Base, here: int, after: int, knot: Fraction) -> tuple[Segment, tuple[Fraction, Fraction]]:
    """Return the degree at a knot where the points `here` to `after` (exclusive) lie, or none.

    Of points at one abscissa, the larger degree holds there (S21).
    """
    if after > here:
        return _constant(max(degree for _, degree in base[here:after]))
    segment, _ = _between(base, after)
    return _constant(segment.value + segment.slope * (knot - segment.origin))


def _constant(degree: Fraction) -> tuple[Segment, tuple[Fraction, Fraction]]:
    return Segment(Fraction(0), degree, Fraction(0)), (degree, degree)
