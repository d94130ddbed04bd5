"""Cells of which the signs of degrees do not tell whether a rule fires, looked into by half-spaces."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import prod

import numpy as np

from fcl_sim.model import FunctionBlock
from fcl_sim.proof.axes import Axis, Cell, Flags
from fcl_sim.proof.halfspaces import HalfSpaces, NotLinear
from fcl_sim.proof.space import Space

MOST = 1000
"""Cells that are looked into."""


@dataclass(frozen=True, slots=True)
class Parted:
    """The cells of a space in a part of which no rule fires, and a place in one of them, by variable."""

    cells: Flags
    place: dict[str, Fraction]


def parted(
    block: FunctionBlock, axes: Sequence[Axis], output: str, space: Space, doubtful: Flags
) -> Parted | None:
    """Return which of the doubtful cells of a space have a place without a rule; None where that is open.

    The space is that of the axes, condensed; its cells are looked into in all cells of all axes.
    """
    places = np.argwhere(doubtful)
    parts = [[_cells(axis, space, at.tolist()) for axis in axes] for at in places]
    if sum(prod(map(len, own)) for own in parts) > MOST:
        return None
    half = HalfSpaces(block, axes, output)
    found, shown = np.zeros_like(doubtful), None
    try:
        for at, own in zip(places, parts, strict=True):
            place = next(_undefined(half, own), None)
            if place is not None:
                found[tuple(at)] = True
                shown = shown or place
    except NotLinear:
        return None
    names = [each.variable for each in axes]
    return Parted(found, dict(zip(names, shown or [], strict=False)))


def _undefined(half: HalfSpaces, parts: Sequence[Sequence[Cell]]) -> Iterator[list[Fraction]]:
    for cells in product(*parts):
        place = half.undefined(cells)
        if place is not None:
            yield place


def _cells(axis: Axis, space: Space, at: Sequence[int]) -> Sequence[Cell]:
    """Return the cells of an axis in a cell of a space: all where the space does not depend on it."""
    if axis.variable not in space.variables:
        return axis.cells
    place = space.variables.index(axis.variable)
    run = space.runs[place][at[place]]
    return axis.cells[axis.cells.index(run.first) : axis.cells.index(run.last) + 1]
