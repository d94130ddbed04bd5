"""Which cells of a space couplings leave, and a point of a box that keeps to them."""

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations
from math import inf, lcm
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fcl_sim.proof.axes import Axis, End, Flags
from fcl_sim.proof.space import Side, Space
from fcl_sim.proof.universe import Coupling, Universe

Numbers = NDArray[Any]


def whole(axis: Axis) -> Side:
    """Return the interval over which an axis goes."""
    low, high = axis.cells[0].low, axis.cells[-1].high
    return Side(low, high, low is not None, high is not None)


def possible(space: Space, axes: Sequence[Axis], universe: Universe) -> Flags | None:
    """Return the cells in which every coupling has a point, each for itself; None where there is none."""
    if not universe.couplings:
        return None
    found = np.ones(space.shape, np.bool_)
    for each in universe.couplings:
        found &= _reached(each, space, axes)
    return found


def are_apart(couplings: Sequence[Coupling]) -> bool:
    """Return whether no two couplings are of one variable, so that what each allows they all do."""
    return not any(one.factors.keys() & other.factors.keys() for one, other in combinations(couplings, 2))


def _reached(coupling: Coupling, space: Space, axes: Sequence[Axis]) -> Flags:
    scale = lcm(*(each.denominator for each in _numbers(coupling, space, axes)))
    least, most = (_ends(coupling, space, axes, scale, upper=upper) for upper in (False, True))
    value = int(coupling.value * scale)
    from_below = (least[0] < value) | ((least[0] == value) & least[1])
    from_above = (most[0] > value) | ((most[0] == value) & most[1])
    match coupling.relation:
        case "<=":
            found = from_below
        case ">=":
            found = from_above
        case _:
            found = from_below & from_above
    return np.asarray(found, np.bool_)


def _numbers(coupling: Coupling, space: Space, axes: Sequence[Axis]) -> Iterator[Fraction]:
    yield coupling.value
    for name, factor, sides in _parts(coupling, space, axes):
        del name
        for each in sides:
            yield from (factor * end for end in (each.low, each.high) if end is not None)


def _parts(
    coupling: Coupling, space: Space, axes: Sequence[Axis]
) -> Iterator[tuple[int | None, Fraction, list[Side]]]:
    """Yield for each variable of a coupling its place in the space, its factor, and its runs or its whole."""
    places = {name.casefold(): place for place, name in enumerate(space.variables)}
    wholes = {each.variable.casefold(): whole(each) for each in axes}
    for name, factor in coupling.factors.items():
        place = places.get(name)
        if place is None:
            yield None, factor, [wholes.get(name, Side(None, None, False, False))]  # noqa: FBT003  as a literal
        else:
            yield place, factor, [each.to(each) for each in space.runs[place]]


def _ends(
    coupling: Coupling, space: Space, axes: Sequence[Axis], scale: int, *, upper: bool
) -> tuple[Numbers, Flags]:
    """Return the least or largest sum of each cell, times `scale`, and whether it is reached."""
    total: Numbers = np.zeros((1,) * len(space.shape), object)
    reached = np.ones((1,) * len(space.shape), np.bool_)
    for place, factor, sides in _parts(coupling, space, axes):
        ends = [_end(each, factor, scale, upper=upper) for each in sides]
        shape = [1] * len(space.shape)
        if place is not None:
            shape[place] = len(sides)
        total = total + np.array([end for end, _ in ends], object).reshape(shape)
        reached = reached & np.array([closed for _, closed in ends]).reshape(shape)
    return np.broadcast_to(total, space.shape), np.broadcast_to(reached, space.shape)


def _end(side: Side, factor: Fraction, scale: int, *, upper: bool) -> tuple[float | int, bool]:
    if factor == 0:
        return 0, True
    high = upper == (factor > 0)
    end, closed = (side.high, side.high_closed) if high else (side.low, side.low_closed)
    if end is None:
        return (inf if upper else -inf), False
    return int(factor * end * scale), closed


def kept(
    point: Mapping[str, Fraction], room: Mapping[str, Side], couplings: Sequence[Coupling]
) -> dict[str, Fraction] | None:
    """Return a point of `room` that keeps to the couplings, from one that may not; None if that fails."""
    found = dict(point)
    for each in couplings:
        names = {name.casefold(): name for name in found}
        own = {names[name]: factor for name, factor in each.factors.items()}
        found |= _moved(found, room, own, each)
    return found if all(_keeps(found, each) for each in couplings) else None


def _moved(
    point: Mapping[str, Fraction],
    room: Mapping[str, Side],
    factors: Mapping[str, Fraction],
    coupling: Coupling,
) -> dict[str, Fraction]:
    now = sum((factor * point[name] for name, factor in factors.items()), Fraction(0))
    short = coupling.value - now
    if short == 0 or (coupling.relation == "<=" and short > 0) or (coupling.relation == ">=" and short < 0):
        return {}
    ways = {
        name: _way(point[name], room[name], factor, short) for name, factor in factors.items() if factor != 0
    }
    gain = sum((factors[name] * way for name, way in ways.items()), Fraction(0))
    if gain == 0:
        return {}
    return {name: point[name] + short / gain * way for name, way in ways.items()}


def _way(start: Fraction, side: Side, factor: Fraction, short: Fraction) -> Fraction:
    """Return how far a variable may go in the direction that makes up for what the sum is short of."""
    end: End = side.high if (factor > 0) == (short > 0) else side.low
    return short / factor if end is None else end - start


def _keeps(point: Mapping[str, Fraction], coupling: Coupling) -> bool:
    names = {name.casefold(): value for name, value in point.items()}
    total = sum((factor * names[name] for name, factor in coupling.factors.items()), Fraction(0))
    match coupling.relation:
        case "<=":
            return total <= coupling.value
        case ">=":
            return total >= coupling.value
    return total == coupling.value
