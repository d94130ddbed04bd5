"""Axes on which a degree counts only from a part of the strongest one on: tails are no cover.

A term counts where it has at least `least` times the degree of the strongest term of its input there, a
complement or a degree from outside where it is at least `least`. So what a full grid of the same terms would
give counts everywhere, by whatever operator. Smooth terms are halved until they are on one side, down to
`NARROW`; what is left between is not known.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

import numpy as np

from fcl_sim.engine.grid import Cell as GridCell
from fcl_sim.engine.grid import Segment
from fcl_sim.engine.smooth import degrees_at
from fcl_sim.model import Curve, FunctionBlock, Fuzzification, Points, Term
from fcl_sim.proof.axes import (
    ONE,
    ZERO,
    Axis,
    Cell,
    Literal,
    Sure,
    axis,
    cells_of,
    cut,
    degree_axis,
    is_constant,
    is_straight,
    known,
    unknown,
)
from fcl_sim.proof.universe import Stretch, Universe
from fcl_sim.units import exact

NARROW = 2.0**-20
"""Part of the stretch between two turns of a term to which it is halved."""


Literals = Mapping[str | None, Literal]


def strong_axes(
    block: FunctionBlock, axes: Sequence[Axis], universe: Universe, least: Fraction
) -> tuple[tuple[Axis, ...], tuple[Axis, ...]]:
    """Return axes with more cells, and the same in whose literals a degree holds where it counts."""
    terms = {each.variable.casefold(): each for each in block.fuzzifications}
    found = [_strong(each, terms.get(each.variable.casefold()), universe, least) for each in axes]
    strong = [replace(refined, literals=literals) for refined, literals in found]
    return tuple(refined for refined, _ in found), tuple(strong)


def _strong(
    plain: Axis, fuzzification: Fuzzification | None, universe: Universe, least: Fraction
) -> tuple[Axis, Literals]:
    stretch = universe.of(plain.variable)
    as_degree = None in plain.literals
    if fuzzification is None:
        return _strong_degree(plain, stretch, least)
    own = [each for each in fuzzification.terms if is_constant(each)]
    if all(is_straight(each) for each in own):
        cuts = set(_crossings(fuzzification, stretch, least))
        refined = axis(plain.variable, fuzzification, stretch, cuts, as_degree=as_degree, reach=universe.of)
        literals = _exactly(refined, own, least)
    else:
        refined, literals = _halved(plain, fuzzification, own, universe, float(least))
    blank = Literal(unknown(len(refined.cells)), unknown(len(refined.cells)))
    return refined, {key: literals.get(key or "", blank) for key in refined.literals}


def _strong_degree(plain: Axis, stretch: Stretch | None, least: Fraction) -> tuple[Axis, Literals]:
    refined = degree_axis(plain.variable, stretch, (least, 1 - least))
    middles = [min(max(each.middle, ZERO), ONE) for each in refined.cells]
    literal = Literal(known(each >= least for each in middles), known(1 - each >= least for each in middles))
    return refined, {None: literal}


def _exactly(refined: Axis, terms: Sequence[Term], least: Fraction) -> dict[str, Literal]:
    """Return where straight terms count, which the middle of each cell tells."""
    middles = {each.name.casefold(): refined.middles[each.name.casefold()] for each in terms}
    bars = [least * max(each) for each in zip(*middles.values(), strict=True)]
    return {
        key: Literal(
            known(own > 0 and own >= bar for own, bar in zip(degrees, bars, strict=True)),
            known(1 - own >= least for own in degrees),
        )
        for key, degrees in middles.items()
    }


def _crossings(fuzzification: Fuzzification, stretch: Stretch | None, least: Fraction) -> Iterator[Fraction]:
    """Yield where a straight term crosses `least` times another, or its complement crosses `least`."""
    grid = cut(fuzzification, stretch)
    cells, inside = cells_of(grid, stretch)
    for cell, place in zip(cells, inside, strict=True):
        if cell.low is not None and cell.high is not None and not cell.is_point:
            for root in _roots(grid.cells[place], least):
                if cell.low < root < cell.high:
                    yield root


def _roots(cell: GridCell, least: Fraction) -> Iterator[Fraction]:
    lines = [_line(each) for each in cell.segments]
    active = [each for each, (_, high) in zip(lines, cell.bounds, strict=True) if high > 0]
    constant = (ONE - least, ZERO)
    for value, slope in active:
        others = [(least * other, least * steep) for other, steep in active]
        for other, steep in (*others, constant):
            if slope != steep:
                yield (other - value) / (slope - steep)


def _line(segment: Segment) -> tuple[Fraction, Fraction]:
    """Return a segment's degree at 0 and its slope."""
    slope = ZERO if segment.run is None else 1 / segment.run
    return segment.value - segment.origin * slope, slope


@dataclass(frozen=True, slots=True)
class _Piece:
    """A stretch on which for each term it is known (or None) whether it counts, and its complement does."""

    low: float
    high: float
    counts: tuple[bool | None, ...]
    not_counts: tuple[bool | None, ...]


def _halved(
    plain: Axis, fuzzification: Fuzzification, terms: Sequence[Term], universe: Universe, least: float
) -> tuple[Axis, dict[str, Literal]]:
    """Return an axis with smooth terms, in pieces on which it is known whether a term counts."""
    ends = [float(each.low) for each in plain.cells if each.is_point and each.low is not None]
    pieces: list[_Piece] = []
    for low, high in pairwise(ends):
        pieces += _pieces(terms, low, high, least)
    merged = [each for place, each in enumerate(pieces) if place == 0 or not _alike(pieces[place - 1], each)]
    cuts = {exact(each.low) for each in merged}
    refined = axis(
        plain.variable,
        fuzzification,
        universe.of(plain.variable),
        cuts,
        as_degree=None in plain.literals,
        reach=universe.of,
    )
    literals = {}
    for place, term in enumerate(terms):
        counts = [_told(pieces, each, place) for each in refined.cells]
        literals[term.name.casefold()] = Literal(
            _sure([own for own, _ in counts]), _sure([own for _, own in counts])
        )
    return refined, literals


def _alike(one: _Piece, other: _Piece) -> bool:
    return one.counts == other.counts and one.not_counts == other.not_counts


def _told(pieces: Sequence[_Piece], cell: Cell, place: int) -> tuple[bool | None, bool | None]:
    """Return what is known of a term in a cell; beyond the outermost turns of all terms nothing is."""
    if cell.low is None or cell.high is None:
        return None, None
    low, high = float(cell.low), float(cell.high)
    touching = (
        [each for each in pieces if each.low <= high and each.high >= low]
        if cell.is_point
        else [each for each in pieces if each.low < high and each.high > low]
    )
    return _common([each.counts[place] for each in touching]), _common(
        [each.not_counts[place] for each in touching]
    )


def _common(values: Sequence[bool | None]) -> bool | None:
    return values[0] if values and all(each is values[0] for each in values) else None


def _sure(values: Sequence[bool | None]) -> Sure:
    return Sure(np.array([each is True for each in values]), np.array([each is not False for each in values]))


def _pieces(terms: Sequence[Term], low: float, high: float, least: float) -> list[_Piece]:
    """Return pieces of a stretch in which no term turns, from below to above."""
    narrow = (high - low) * NARROW
    found = []
    waiting = [(low, high)]
    while waiting:
        left, right = waiting.pop()
        bounds = _bounds(terms, left, right)
        top_low, top_high = max(each for each, _ in bounds), max(each for _, each in bounds)
        counts = tuple(_side(own, (least * top_low, least * top_high)) for own in bounds)
        not_counts = tuple(_side((1.0 - up, 1.0 - down), (least, least)) for down, up in bounds)
        middle = 0.5 * (left + right)
        if right - left > narrow and left < middle < right and (None in counts or None in not_counts):
            waiting += [(middle, right), (left, middle)]
        else:
            found.append(_Piece(left, right, counts, not_counts))
    return found


def _side(own: tuple[float, float], bound: tuple[float, float]) -> bool | None:
    if own[0] >= bound[1] and own[1] > 0.0:
        return True
    return False if own[1] < bound[0] else None


def _bounds(terms: Sequence[Term], low: float, high: float) -> list[tuple[float, float]]:
    """Return the least and largest degree of each term over a stretch in which it is monotone."""
    found = []
    for each in terms:
        ends = [_at(each, x) for x in (low, high)]
        found.append((min(ends), max(ends)))
    return found


def _at(term: Term, x: float) -> float:
    match term.shape:
        case Points(points):
            xs, degrees = [float(each.x) for each in points], [each.degree for each in points]
            return float(np.interp(x, xs, degrees))
        case Curve() as curve:
            return float(degrees_at(curve, np.array([x]))[0])
    raise TypeError(term)
