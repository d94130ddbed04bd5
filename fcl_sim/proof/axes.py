"""Axes: each input cut at the breakpoints of its terms, so that in a cell each degree keeps its sign.

Cells are open intervals and the points between them, in turns: a term may be 0
at a point alone, and a ridge of no width is found like any other gap.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fcl_sim.engine.grid import Function, Grid, merge
from fcl_sim.engine.smooth import degrees_at, sight, turns
from fcl_sim.model import Curve, CurveKind, Fuzzification, Points, Term
from fcl_sim.proof.moved import Reach, Spot, ends_of, may_be, may_differ, nowhere, spots_of
from fcl_sim.proof.universe import Stretch
from fcl_sim.units import exact

Flags = NDArray[np.bool_]
End = Fraction | None
ZERO, ONE = Fraction(0), Fraction(1)
TINY = Fraction(1, 10**400)
"""What stands for a degree that is above 0, or below 1, by less than a float can tell."""

FLAT = frozenset(
    (CurveKind.Z_SHAPE, CurveKind.S_SHAPE, CurveKind.PI_SHAPE, CurveKind.CONCAVE, CurveKind.GAUSSIAN_PRODUCT)
)
"""Curves that are 1 over a stretch; the others are so at a point at most."""
ENDING = frozenset(
    (
        CurveKind.COSINE,
        CurveKind.Z_SHAPE,
        CurveKind.S_SHAPE,
        CurveKind.PI_SHAPE,
        CurveKind.SIGMOID_DIFFERENCE,
        CurveKind.SIGMOID_DISTANCE,
    )
)
"""Curves that are 0 somewhere; the others never are, however small they get."""


@dataclass(frozen=True, slots=True)
class Cell:
    """An open interval, or a point where both ends are the same; None is no end."""

    low: End
    high: End

    @property
    def is_point(self) -> bool:
        """Whether it has no width."""
        return self.low is not None and self.low == self.high

    @property
    def width(self) -> Fraction | None:
        """How wide it is; None without end."""
        return None if self.low is None or self.high is None else self.high - self.low

    @property
    def middle(self) -> Fraction:
        """A point of it."""
        if self.low is None:
            return ZERO if self.high is None else self.high - 1
        return self.low + 1 if self.high is None else (self.low + self.high) / 2


@dataclass(frozen=True, slots=True)
class Sure:
    """In which cells something is so: surely, and possibly; the two differ only where it is not known."""

    surely: Flags
    possibly: Flags

    def of(self, *, certain: bool) -> Flags:
        """Return one of them."""
        return self.surely if certain else self.possibly


@dataclass(frozen=True, slots=True)
class Literal:
    """In which cells a degree is above 0 (`holds`), and in which 1 minus it is (`fails`)."""

    holds: Sure
    fails: Sure


@dataclass(frozen=True, slots=True, kw_only=True)
class Axis:
    """An input in cells, from below to above.

    `literals` are by term, in lower case; None is the input itself as a degree.
    `lows` and `highs` bound the degrees over each cell, on 0 and 1 where that
    is so; `middles` are the degrees of straight terms in the middle of each.
    """

    variable: str
    cells: tuple[Cell, ...]
    literals: Mapping[str | None, Literal]
    lows: Mapping[str | None, tuple[Fraction, ...]] = field(default_factory=dict)
    highs: Mapping[str | None, tuple[Fraction, ...]] = field(default_factory=dict)
    middles: Mapping[str | None, tuple[Fraction, ...]] = field(default_factory=dict)


def known(flags: Iterable[bool]) -> Sure:
    """Return what is known in every cell."""
    array = np.fromiter(flags, np.bool_)
    return Sure(array, array)


def unknown(cells: int) -> Sure:
    """Return what is known in no cell."""
    return Sure(np.zeros(cells, np.bool_), np.ones(cells, np.bool_))


def axis(
    variable: str,
    fuzzification: Fuzzification,
    stretch: Stretch | None,
    cuts: Iterable[Fraction] = (),
    *,
    as_degree: bool = False,
    reach: Reach = nowhere,
) -> Axis:
    """Return an input with terms in cells; `cuts` are further ends of cells.

    With `as_degree` it is brought in as a degree as well, such as a weight.
    `reach` tells from where to where variables go that move points.
    """
    moved = {
        each.name.casefold(): spots_of(each.shape, reach)
        for each in fuzzification.terms
        if isinstance(each.shape, Points) and not is_constant(each)
    }
    further = [*cuts, *(end for spots in moved.values() for end in ends_of(spots))]
    grid = cut(fuzzification, stretch, (*further, ZERO, ONE) if as_degree else further)
    cells, inside = cells_of(grid, stretch)
    literals: dict[str | None, Literal] = {}
    lows: dict[str | None, tuple[Fraction, ...]] = {}
    highs: dict[str | None, tuple[Fraction, ...]] = {}
    middles: dict[str | None, tuple[Fraction, ...]] = {}
    straight = 0
    for term in fuzzification.terms:
        key = term.name.casefold()
        if is_straight(term):
            bounds = [grid.cells[place].bounds[straight] for place in inside]
            middles[key] = tuple(
                grid.cells[place].segments[straight].degree(each.middle)
                for place, each in zip(inside, cells, strict=True)
            )
            straight += 1
        elif isinstance(term.shape, Curve) and is_constant(term):
            bounds = [_curve_bounds(term.shape, each) for each in cells]
        else:  # its points, or what makes its curve, are moved by variables
            literals[key] = (
                Literal(_moved(moved[key], ZERO, cells), _moved(moved[key], ONE, cells))
                if key in moved
                else Literal(unknown(len(cells)), unknown(len(cells)))
            )
            lows[key], highs[key] = (ZERO,) * len(cells), (ONE,) * len(cells)
            continue
        literals[key] = Literal(known(high > 0 for _, high in bounds), known(low < 1 for low, _ in bounds))
        lows[key], highs[key] = (tuple(each[end] for each in bounds) for end in (0, 1))
    if as_degree:
        spots = [each.middle for each in cells]
        literals[None] = Literal(known(each > 0 for each in spots), known(each < 1 for each in spots))
    return Axis(variable=variable, cells=cells, literals=literals, lows=lows, highs=highs, middles=middles)


def _moved(spots: Sequence[Spot], bound: Fraction, cells: Sequence[Cell]) -> Sure:
    """Return in which cells a term whose points are moved surely, and possibly, is off 0, or off 1."""
    surely = [not may_be(spots, bound, each.low, each.high) for each in cells]
    possibly = [may_differ(spots, bound, each.low, each.high) for each in cells]
    return Sure(np.array(surely, np.bool_), np.array(possibly, np.bool_))


def degree_axis(variable: str, stretch: Stretch | None, cuts: Iterable[Fraction] = ()) -> Axis:
    """Return an input that is brought in as a degree: from 0 to 1, since it is clamped (S27)."""
    low, high = stretch or (ZERO, ONE)
    inner = {each for each in (ZERO, ONE, *cuts) if low < each < high}
    cells = _alternating((low, *sorted(inner), high))
    ends = [(_clamped(each.low), _clamped(each.high)) for each in cells]
    literal = Literal(known(top > 0 for _, top in ends), known(bottom < 1 for bottom, _ in ends))
    return Axis(
        variable=variable,
        cells=cells,
        literals={None: literal},
        lows={None: tuple(bottom for bottom, _ in ends)},
        highs={None: tuple(top for _, top in ends)},
    )


def cut(fuzzification: Fuzzification, stretch: Stretch | None, cuts: Iterable[Fraction] = ()) -> Grid:
    """Return the merged grid of the terms that are straight, with a knot wherever another may turn."""
    marks = set(cuts) | set(stretch or ())
    for each in fuzzification.terms:
        if isinstance(each.shape, Curve) and is_constant(each):
            marks |= {exact(float(place)) for place in turns(each.shape)}
    functions = [Function(base_of(each)) for each in fuzzification.terms if is_straight(each)]
    if marks:
        functions.append(Function(tuple((place, ZERO) for place in sorted(marks))))
    return merge(functions)


def cells_of(grid: Grid, stretch: Stretch | None) -> tuple[tuple[Cell, ...], list[int]]:
    """Return the cells of a grid within a stretch, and their places in the grid."""
    cells = _alternating((None, *grid.knots, None))[1:-1]
    if stretch is None:
        return cells, list(range(len(cells)))
    low, high = stretch
    inside = [
        place
        for place, each in enumerate(cells)
        if each.low is not None and each.high is not None and low <= each.low and each.high <= high
    ]
    return tuple(cells[place] for place in inside), inside


def _alternating(ends: Sequence[End]) -> tuple[Cell, ...]:
    cells = [Cell(ends[0], ends[0])]
    for low, high in pairwise(ends):
        cells += [Cell(low, high), Cell(high, high)]
    return tuple(cells)


def is_straight(term: Term) -> bool:
    """Return whether a term has constant base points."""
    return isinstance(term.shape, Points) and is_constant(term)


def is_constant(term: Term) -> bool:
    """Return whether no variable moves a term of an input."""
    match term.shape:
        case Points(points):
            return not any(isinstance(each.x, str) for each in points)
        case Curve(_, parameters):
            return not any(isinstance(each, str) for each in parameters)
    return False


@lru_cache(maxsize=4096)
def base_of(term: Term) -> tuple[tuple[Fraction, Fraction], ...]:
    """Return the constant base points of a term as the text has them."""
    if not isinstance(term.shape, Points):
        raise TypeError(term)
    return tuple((exact(float(each.x)), exact(each.degree)) for each in term.shape.points)


def _curve_bounds(curve: Curve, cell: Cell) -> tuple[Fraction, Fraction]:
    """Return the degrees of a curve over a cell in which it does not turn; 0 and 1 only where it is that.

    Where a curve could turn within, that is of no harm: only 0 and 1 are looked at.
    """
    first, last = sight(curve)
    low = min(first, float(cell.high or 0) - 1.0) if cell.low is None else float(cell.low)
    high = max(last, float(cell.low or 0) + 1.0) if cell.high is None else float(cell.high)
    xs = np.array([low, 0.5 * low + 0.5 * high, high])
    degrees = [_degree(curve, value) for value in degrees_at(curve, xs).tolist()]
    inner = degrees[1]
    if cell.is_point:
        return inner, inner
    least, most = min(degrees), max(degrees)
    return (least - TINY, most) if least == 1 and curve.kind not in FLAT else (least, most)


def _degree(curve: Curve, value: float) -> Fraction:
    """Return a computed degree; one that never is 0 does not become so by being small."""
    if value == 0.0 and curve.kind not in ENDING:
        return TINY
    return Fraction(value)


def _clamped(end: End) -> Fraction:
    return ZERO if end is None else min(max(end, ZERO), ONE)
