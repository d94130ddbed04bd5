"""An example of an undefined output where it is not known in general: tried at points, in fractions."""

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import islice, product

import numpy as np

from fcl_sim.engine.explain import Origin
from fcl_sim.model import FunctionBlock, Fuzzification, Points
from fcl_sim.proof.axes import Axis, Flags, is_constant
from fcl_sim.proof.exact import exactly
from fcl_sim.proof.points import Point
from fcl_sim.proof.rationals import NotExact
from fcl_sim.proof.space import Space
from fcl_sim.proof.universe import Universe
from fcl_sim.proof.witnesses import Witnesses

CELLS = 12
"""Cells that are tried, spread over all that are in doubt."""
TRIED = 60
"""Ways in which points are moved that are tried in each."""


def undefined_in(
    block: FunctionBlock, axes: Sequence[Axis], universe: Universe, output: str, space: Space, cells: Flags
) -> Point | None:
    """Return a point in some cells of a space at which no rule is active for an output, if one is found."""
    points = Witnesses(block, axes, universe)
    places = np.argwhere(cells)
    for at in places[np.unique(np.linspace(0, len(places) - 1, CELLS).astype(np.int64))]:
        sides = {
            name: runs[run].to(runs[run])
            for name, runs, run in zip(space.variables, space.runs, at.tolist(), strict=True)
        }
        start = points.inside(sides)
        for point in islice(_moved(block, universe, start), TRIED) if start else ():
            if _is_undefined(block, output, point):
                return point
    return None


def _is_undefined(block: FunctionBlock, output: str, point: Point) -> bool:
    try:
        found = exactly(block, point).outputs
    except NotExact:
        return False
    return any(
        each.variable.casefold() == output.casefold() and each.origin is not Origin.RULES for each in found
    )


def _moved(block: FunctionBlock, universe: Universe, start: Point) -> Iterator[Point]:
    """Yield a point with what moves points of terms at the ends of its range, or beside what is moved."""
    movers: dict[str, set[Fraction]] = {}
    for each in block.fuzzifications:
        for name in _names(each):
            own = next(value for key, value in start.items() if key.casefold() == each.variable.casefold())
            stretch = universe.of(name)
            movers.setdefault(name, set()).update(stretch or (own - 1, own, own + 1))
    names = {key.casefold(): key for key in start}
    for values in product(*(sorted(each) for each in movers.values())):
        yield {**start, **{names[name]: value for name, value in zip(movers, values, strict=True)}}


def _names(fuzzification: Fuzzification) -> Iterator[str]:
    for term in fuzzification.terms:
        if isinstance(term.shape, Points) and not is_constant(term):
            yield from (each.x.casefold() for each in term.shape.points if isinstance(each.x, str))
