"""Points at which an evaluation shows what a finding says: where a rule fires, where a term is high."""

from collections.abc import Mapping, Sequence
from fractions import Fraction

import numpy as np

from fcl_sim.engine.switches import switched
from fcl_sim.model import FunctionBlock
from fcl_sim.proof.axes import Axis, Cell, Flags
from fcl_sim.proof.coupled import kept, whole
from fcl_sim.proof.cubes import Cubes, firings
from fcl_sim.proof.exact import exactly
from fcl_sim.proof.points import Point, witness
from fcl_sim.proof.rationals import NotExact
from fcl_sim.proof.space import Side
from fcl_sim.proof.universe import Universe

MOST = 20
"""Parts of where a rule may fire that are looked into."""


class Witnesses:
    """Points of a universe, with a number for every input of a block."""

    def __init__(self, block: FunctionBlock, axes: Sequence[Axis], universe: Universe) -> None:
        self._block, self._axes, self._universe = block, axes, universe
        self._known: dict[bool, Mapping[int, Cubes]] = {}

    def inside(self, sides: Mapping[str, Side]) -> Point | None:
        """Return a point of a box, of few digits, that keeps to the couplings; None where that fails."""
        point = witness(self._block, self._axes, sides, self._universe)
        room = {each.variable: sides.get(each.variable, whole(each)) for each in self._axes}
        room |= {name: Side(value, value) for name, value in point.items() if name not in room}
        return kept(point, room, self._universe.couplings)

    def at(self, variable: str, value: Fraction) -> Point | None:
        """Return a point at which an input has a value."""
        return self.inside({self._named(variable): Side(value, value)})

    def term(self, axis: Axis, term: str) -> Point | None:
        """Return a point at which a term of an input is as high as it gets."""
        lows, highs = axis.lows[term.casefold()], axis.highs[term.casefold()]
        top = max(highs)
        reached = [cell for cell, low in zip(axis.cells, lows, strict=True) if low == top]
        near = [cell for cell, high in zip(axis.cells, highs, strict=True) if high == top]
        return self.inside({axis.variable: _side(_widest(reached or near))}) if top > 0 else None

    def rule(self, place: int) -> Point | None:
        """Return a point at which a rule surely fires, its weight aside; rules count through the text."""
        for certain in (True, False):
            for cube in self._fires(certain=certain).get(place, ()):
                sides = {self._axes[axis].variable: self._widest(axis, flags) for axis, flags in cube.items()}
                point = self.inside(sides)
                if point is not None and (certain or self._shows(point, place)):
                    return point
        return None

    def _fires(self, *, certain: bool) -> Mapping[int, Cubes]:
        if certain not in self._known:
            found = firings(switched(self._block), self._axes, certain=certain, least=-1.0)
            self._known[certain] = {each.rule: each.cubes[:MOST] for each in found}
        return self._known[certain]

    def _shows(self, point: Point, place: int) -> bool:
        """Return whether a rule fires at a point."""
        try:
            return exactly(self._block, point).rules[place][1] > 0
        except NotExact:
            return False

    def _named(self, variable: str) -> str:
        return next(each.variable for each in self._axes if each.variable.casefold() == variable.casefold())

    def _widest(self, axis: int, flags: Flags) -> Side:
        return _side(_widest([self._axes[axis].cells[place] for place in np.flatnonzero(flags)]))


def _widest(cells: Sequence[Cell]) -> Cell:
    """Return the widest of some cells, one without end only where there is no other."""
    return max(cells, key=lambda each: Fraction(-1) if each.width is None else each.width)


def _side(cell: Cell) -> Side:
    return Side(cell.low, cell.high, cell.is_point, cell.is_point)
