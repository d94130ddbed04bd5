"""Where the terms of a variable lie, for the axes of pictures."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from fcl_sim.engine.smooth import degrees_at, sight, turns
from fcl_sim.engine.switches import spikes
from fcl_sim.fcl.write_expressions import expression
from fcl_sim.loop.trace import FuzzyRecord
from fcl_sim.model import Curve, Formula, FunctionBlock, Point, Points, Singleton, Singletons, Term
from fcl_sim.report.words import one_line

DRAWN = 65
"""Points of a smooth curve in a picture."""

Initials = Mapping[str, float]
"""Initial values of inputs by name, letter case folded: where variable points stand in a picture."""

REACH = 2.0
"""A run is followed so many spans of the terms outside them, and no further."""


def initials(block: FunctionBlock) -> Initials:
    """Return the initial value of each input and local variable, 0 where none is declared."""
    return {each.name.casefold(): each.initial or 0.0 for each in (*block.inputs, *block.variables)}


def moves(block: FunctionBlock) -> bool:
    """Return whether any term has points that inputs move (5.2.2)."""
    terms = [
        *(term for each in block.fuzzifications for term in each.terms),
        *(term for each in block.defuzzifications for term in each.terms),
    ]
    return any(isinstance(x, str) for term in terms for x in _written(term))


def as_seen(block: FunctionBlock, record: FuzzyRecord | None) -> FunctionBlock:
    """Return a block whose inputs begin with the medians of a run: there points that move are drawn."""
    if record is None:
        return block
    finite = [each[np.isfinite(each)] for each in record.inputs.T]
    names = [name.casefold() for name in record.input_names]
    medians = {name: float(np.median(each)) for name, each in zip(names, finite, strict=True) if len(each)}
    inputs = [replace(each, initial=medians.get(each.name.casefold(), each.initial)) for each in block.inputs]
    return replace(block, inputs=tuple(inputs))


def points_of(term: Term) -> tuple[Point, ...]:
    """Return the base points of a term that is neither a singleton nor a curve."""
    if not isinstance(term.shape, Points):
        raise TypeError(term)
    return term.shape.points


def abscissae(term: Term, start: Initials) -> list[float]:
    """Return the places of a term's points, or of its singleton."""
    if isinstance(term.shape, Singleton):
        return [_at(term.shape.value, start)]
    if isinstance(term.shape, Curve):
        return list(sight(_standing(term.shape, start)))
    if isinstance(term.shape, Singletons):
        return [_at(point.x, start) for point in term.shape.points]
    return [_at(point.x, start) for point in points_of(term)]


def calculated(term: Term) -> str:
    """Return what a term that is a formula is calculated by, else nothing."""
    if not isinstance(term.shape, Formula):
        return ""
    return f"{one_line(term.name)} = {one_line(expression(term.shape.expression))}"


def extent(terms: Sequence[Term], start: Initials) -> tuple[float, float]:
    """Return the least and the largest abscissa of terms; around a lone one, some room."""
    places = [x for term in terms for x in abscissae(term, start)] or [0.0]
    low, high = min(places), max(places)
    if low == high:
        return low - (abs(low) or 1.0), high + (abs(high) or 1.0)
    return low, high


def standing(term: Term, start: Initials) -> Term:
    """Return a term whose variable abscissae stand at their initial values, never falling (S22)."""
    shape = term.shape
    if isinstance(shape, Curve):
        return replace(term, shape=_standing(shape, start))
    if isinstance(shape, Singletons):
        values = tuple(Point(_at(point.x, start), point.degree) for point in shape.points)
        return replace(term, shape=Singletons(values))
    places = abscissae(term, start)
    if isinstance(shape, Singleton):
        return Term(term.name, Singleton(places[0]), term.span)
    points = [Point(max(places[: index + 1]), point.degree) for index, point in enumerate(points_of(term))]
    return Term(term.name, Points(tuple(points)), term.span)


def drawn(term: Term, ends: tuple[float, float] | None = None) -> Term:
    """Return a standing term as a singleton or points; a smooth curve becomes as many as a picture shows.

    `ends` are those of the axis, else of where the curve is to be seen.
    """
    if isinstance(term.shape, Curve):
        return replace(term, shape=_drawn(term.shape, ends))
    if isinstance(term.shape, Singletons):
        return replace(term, shape=spikes(term.shape))
    return term


def anchor(term: Term, low: float, high: float) -> float:
    """Return the middle of where the degree of a drawn term is largest, on an axis from `low` to `high`."""
    if isinstance(term.shape, Singleton):
        return float(term.shape.value)
    points = [(float(point.x), point.degree) for point in points_of(term)]
    peak = max(degree for _, degree in points)
    first = next(index for index, (_, degree) in enumerate(points) if degree == peak)
    last = len(points) - 1 - next(i for i, (_, degree) in enumerate(reversed(points)) if degree == peak)
    left = low if first == 0 else points[first][0]
    right = high if last == len(points) - 1 else points[last][0]
    return (left + right) / 2.0


def line_of(points: tuple[Point, ...], low: float, high: float) -> tuple[list[float], list[float]]:
    """Return a membership function from `low` to `high`, without the zeros at its ends."""
    first, last = points[0], points[-1]
    line = [
        (low, first.degree),
        *((float(point.x), point.degree) for point in points),
        (high, last.degree),
    ]
    while len(line) > 2 and line[0][1] == line[1][1] == 0.0:
        del line[0]
    while len(line) > 2 and line[-1][1] == line[-2][1] == 0.0:
        del line[-1]
    return [x for x, _ in line], [degree for _, degree in line]


def _standing(curve: Curve, start: Initials) -> Curve:
    """Return a curve whose variable parameters stand at their initial values."""
    return replace(curve, parameters=tuple(_at(each, start) for each in curve.parameters))


def _drawn(curve: Curve, ends: tuple[float, float] | None) -> Points:
    """Return a curve as points from end to end, most of them where it is to be seen."""
    low, high = ends or sight(curve)
    near = np.array([*np.linspace(*sight(curve), DRAWN), *turns(curve)])
    xs = np.unique(np.concatenate([np.linspace(low, high, DRAWN), near[(low < near) & (near < high)]]))
    pairs = zip(xs.tolist(), degrees_at(curve, xs).tolist(), strict=True)
    return Points(tuple(Point(x, degree) for x, degree in pairs))


def _written(term: Term) -> list[float | str]:
    """Return the places of a term as they are written: numbers, or names of inputs."""
    match term.shape:
        case Singleton(value=value):
            return [value]
        case Curve(parameters=parameters):
            return list(parameters)
        case Points(points=points) | Singletons(points=points):
            return [each.x for each in points]
        case _:
            return []


def _at(x: float | str, start: Initials) -> float:
    return start.get(x.casefold(), 0.0) if isinstance(x, str) else x
