"""Where the terms of a variable lie, for the axes of pictures."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from fcl_sim.engine.smooth import degrees_at, sight
from fcl_sim.engine.switches import spikes
from fcl_sim.model import Curve, FunctionBlock, Point, Points, Singleton, Singletons, Term

DRAWN = 65
"""Points of a smooth curve in a picture."""

Initials = Mapping[str, float]
"""Initial values of inputs by name, letter case folded: where variable points stand in a picture."""

REACH = 2.0
"""A run is followed so many spans of the terms outside them, and no further."""


def initials(block: FunctionBlock) -> Initials:
    """Return the initial value of each input and local variable, 0 where none is declared."""
    return {each.name.casefold(): each.initial or 0.0 for each in (*block.inputs, *block.variables)}


def points_of(term: Term) -> tuple[Point, ...]:
    """Return the base points of a term that is neither a singleton nor a curve, settled or not."""
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


def extent(terms: Sequence[Term], start: Initials) -> tuple[float, float]:
    """Return the least and the largest abscissa of terms; around a lone one, some room."""
    places = [x for term in terms for x in abscissae(term, start)] or [0.0]
    low, high = min(places), max(places)
    if low == high:
        return low - (abs(low) or 1.0), high + (abs(high) or 1.0)
    return low, high


def settled(term: Term, start: Initials) -> Term:
    """Return a term whose variable abscissae stand at their initial values, never falling (S22).

    A smooth curve becomes as many points as a picture shows.
    """
    if isinstance(term.shape, Curve):
        return replace(term, shape=_drawn(_standing(term.shape, start)))
    if isinstance(term.shape, Singletons):
        values = tuple(Point(_at(point.x, start), point.degree) for point in term.shape.points)
        return replace(term, shape=spikes(Singletons(values)))
    places = abscissae(term, start)
    if isinstance(term.shape, Singleton):
        return Term(term.name, Singleton(places[0]), term.span)
    points = [Point(max(places[: index + 1]), point.degree) for index, point in enumerate(points_of(term))]
    return Term(term.name, Points(tuple(points)), term.span)


def _standing(curve: Curve, start: Initials) -> Curve:
    """Return a curve whose variable parameters stand at their initial values."""
    return replace(curve, parameters=tuple(_at(each, start) for each in curve.parameters))


def _drawn(curve: Curve) -> Points:
    """Return a curve as points, from end to end of where it is to be seen."""
    xs = np.linspace(*sight(curve), DRAWN)
    pairs = zip(xs.tolist(), degrees_at(curve, xs).tolist(), strict=True)
    return Points(tuple(Point(x, degree) for x, degree in pairs))


def _at(x: float | str, start: Initials) -> float:
    return start.get(x.casefold(), 0.0) if isinstance(x, str) else x
