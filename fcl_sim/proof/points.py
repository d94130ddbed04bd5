"""Points of the input space: witnesses with few digits, and what the terms are there."""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from math import floor, log10

import numpy as np

from fcl_sim.engine.grid import Base
from fcl_sim.engine.smooth import degrees_at
from fcl_sim.model import Curve, FunctionBlock, Fuzzification, Points, Term
from fcl_sim.proof.axes import Axis, is_constant
from fcl_sim.proof.coupled import whole
from fcl_sim.proof.space import Side
from fcl_sim.proof.universe import Universe
from fcl_sim.units import exact

Point = Mapping[str, Fraction]
"""By the declared name of each input."""


def within(side: Side, span: Fraction = Fraction(1)) -> Fraction:
    """Return a number of few digits within an interval; one without an end is gone into by `span`."""
    if side.low is None and side.high is None:
        return Fraction(0)
    low = side.high - span if side.low is None and side.high is not None else side.low
    high = side.low + span if side.high is None and side.low is not None else side.high
    if low is None or high is None:
        raise TypeError(side)
    if low == high:
        return low
    middle = (low + high) / 2
    step = Fraction(10) ** floor(log10(high - low))
    while True:
        found = Fraction(round(middle / step)) * step
        if low < found < high:
            return found
        step /= 10


def span_of(axis: Axis) -> Fraction:
    """Return a fifth of the way between an axis's breakpoints, at least something."""
    ends = [each.low for each in axis.cells if each.low is not None]
    return (ends[-1] - ends[0]) / 5 or Fraction(1) if ends else Fraction(1)


def witness(
    block: FunctionBlock, axes: Sequence[Axis], sides: Mapping[str, Side], universe: Universe
) -> dict[str, Fraction]:
    """Return a point of a box with a number for every input: inside, and of few digits."""
    own = {each.variable: each for each in axes}
    found = {}
    for each in block.inputs:
        axis = own.get(each.name)
        if axis is None:
            stretch = universe.of(each.name)
            found[each.name] = within(Side(*stretch)) if stretch else exact(each.initial or 0.0)
        elif each.name in sides:
            found[each.name] = within(sides[each.name], span_of(axis))
        else:
            found[each.name] = within(_inner(axis), span_of(axis))
    return found


def _inner(axis: Axis) -> Side:
    """Return the whole of an axis, or what lies between its breakpoints where it has no end."""
    side = whole(axis)
    ends = [each.low for each in axis.cells if each.low is not None]
    if ends and (side.low is None or side.high is None):
        return Side(ends[0], ends[-1])
    return side


def degree(term: Term, x: Fraction, point: Point | None = None) -> Fraction | None:
    """Return the degree of a term of an input at `x`, exact if it is straight.

    What moves it has its value at `point`; without one, None.
    """
    if not is_constant(term) and point is None:
        return None
    values = {name.casefold(): value for name, value in (point or {}).items()}
    match term.shape:
        case Points(points):
            base: list[tuple[Fraction, Fraction]] = []
            for each in points:
                own = values[each.x.casefold()] if isinstance(each.x, str) else exact(float(each.x))
                base.append((max(own, base[-1][0]) if base else own, exact(each.degree)))  # S22
            return membership(tuple(base), x)
        case Curve() as curve if is_constant(term):
            return Fraction(float(degrees_at(curve, np.array([float(x)]))[0]))
    return None


def membership(base: Base, x: Fraction) -> Fraction:
    """Return the degree of base points at `x`: the largest of those that lie there (S20, S21)."""
    here = [own for place, own in base if place == x]
    if here:
        return max(here)
    for (left, low), (right, high) in pairwise(base):
        if left < x < right:
            return low + (high - low) * (x - left) / (right - left)
    return base[0][1] if x < base[0][0] else base[-1][1]


def strongest(fuzzification: Fuzzification, x: Fraction, point: Point | None = None) -> Term | None:
    """Return the term of an input that has the largest degree at `x`, if any is above 0."""
    degrees = [(degree(each, x, point) or Fraction(0), each) for each in fuzzification.terms]
    largest = max((own for own, _ in degrees), default=Fraction(0))
    return next((each for own, each in degrees if own == largest), None) if largest > 0 else None
