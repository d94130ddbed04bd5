"""The merged grid of a fuzzified variable: knots, cells, and a segment of each term per cell.

All of it is computed in fractions and rounded once.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

Base = tuple[tuple[Fraction, Fraction], ...]
"""Base points (abscissa, degree) of a membership function, in rising order."""
Bounds = tuple[Fraction, Fraction]


@dataclass(frozen=True, slots=True)
class Function:
    """A membership function by its base points, or with `negated` 1 minus it."""

    base: Base
    negated: bool = False


@dataclass(frozen=True, slots=True)
class Segment:
    """A straight piece: degree = value + (x - origin) / run; the origin is its lower end.

    `run` is None where the degree is constant.
    """

    origin: Fraction
    value: Fraction
    run: Fraction | None = None

    def degree(self, x: Fraction) -> Fraction:
        """Return the degree at `x`."""
        return self.value if self.run is None else self.value + (x - self.origin) / self.run


@dataclass(frozen=True, slots=True)
class Cell:
    """An open interval between knots, or a knot: by function, its segment and bounds of its degree."""

    segments: tuple[Segment, ...]
    bounds: tuple[Bounds, ...]


@dataclass(frozen=True, slots=True)
class Grid:
    """Knots, rising; cell 2 k is the interval before knot k, cell 2 k + 1 is knot k itself."""

    knots: tuple[Fraction, ...]
    cells: tuple[Cell, ...]


def merge(functions: Sequence[Function]) -> Grid:
    """Return the grid that has a knot at every base point of `functions`."""
    knots = tuple(sorted({x for function in functions for x, _ in function.base}))
    columns = [_column(function, knots) for function in functions]
    cells = [
        Cell(tuple(segment for segment, _ in row), tuple(bounds for _, bounds in row))
        for row in zip(*columns, strict=True)
    ]
    return Grid(knots, tuple(cells))


def _column(function: Function, knots: Sequence[Fraction]) -> list[tuple[Segment, Bounds]]:
    """Return a function's segment and bounds in each cell, from left to right."""
    base = function.base
    ends = tuple((x, 1 - degree) for x, degree in base) if function.negated else base
    column = []
    after = 0  # first point beyond the cell
    for knot in knots:
        column.append(_between(ends, after))
        here = after
        while after < len(base) and base[after][0] == knot:
            after += 1
        degree = _at(base, here, after, knot)
        column.append(_constant(1 - degree if function.negated else degree))
    column.append(_between(ends, after))
    return column


def _between(base: Base, after: int) -> tuple[Segment, Bounds]:
    """Return the segment between the points `after - 1` and `after`; S20 beyond the ends."""
    if after == 0 or after == len(base):
        return _constant(base[max(after - 1, 0)][1])
    (left, low), (right, high) = base[after - 1], base[after]
    if low == high:
        return _constant(low)
    run = (right - left) / (high - low)
    lower = Segment(left, low, run) if low < high else Segment(right, high, run)
    return lower, (min(low, high), max(low, high))


def _at(base: Base, here: int, after: int, knot: Fraction) -> Fraction:
    """Return the degree at a knot where the points `here` to `after` (exclusive) lie, or none.

    Of points at one abscissa, the larger degree holds there (S21).
    """
    if after > here:
        return max(degree for _, degree in base[here:after])
    segment, _ = _between(base, after)
    return segment.degree(knot)


def _constant(degree: Fraction) -> tuple[Segment, Bounds]:
    return Segment(Fraction(0), degree), (degree, degree)
