"""Cells → few boxes, each as large as it can be, that together are all of them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, permutations

import numpy as np
from numpy.typing import NDArray

from fcl_sim.proof.axes import Flags
from fcl_sim.proof.space import Run, Space

Corner = tuple[int, ...]

POINT = 1e-9
"""The width that a point counts for beside runs that have one: a ridge comes after what has an area."""
ORDERS = 24
"""Orders of the axes in which a box is grown."""


@dataclass(frozen=True, slots=True)
class CellBox:
    """A box of runs from `low` to `high`, both included."""

    low: Corner
    high: Corner


def boxes_of(space: Space, cells: Flags, free: Flags | None = None) -> Iterator[CellBox]:
    """Yield boxes that cover `cells`, the largest that grow from what is left; they may overlap.

    A box takes in `free` cells too, where that makes it larger.
    """
    widths = [np.array([_width(run, runs) for run in runs]) for runs in space.runs]
    room = cells if free is None else cells | free
    left = cells.copy()
    sizes = _sizes(widths)
    while left.any():
        seed = np.unravel_index(int(np.argmax(np.where(left, sizes, -1.0))), left.shape)
        found = _largest(room, tuple(int(each) for each in seed), widths)
        yield found
        left[_slices(found)] = False


def _width(run: Run, runs: Sequence[Run]) -> float:
    if run.width is None:
        inner = [float(each.width) for each in runs if each.width is not None]
        return max(1.0, sum(inner))
    return float(run.width) or POINT


def _sizes(widths: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    sizes = np.ones(())
    for each in widths:
        sizes = np.multiply.outer(sizes, each)
    return sizes


def _largest(room: Flags, seed: Corner, widths: Sequence[NDArray[np.float64]]) -> CellBox:
    """Return the largest box around `seed` of those that grow along one axis after the other."""
    orders = islice(permutations(range(len(seed))), ORDERS)
    grown = [_grown(room, seed, order) for order in orders]
    return max(grown, key=lambda each: _size(each, widths))


def _size(box: CellBox, widths: Sequence[NDArray[np.float64]]) -> float:
    size = 1.0
    for own, low, high in zip(widths, box.low, box.high, strict=True):
        size *= float(own[low : high + 1].sum())
    return size


def _grown(room: Flags, seed: Corner, order: Sequence[int]) -> CellBox:
    low, high = list(seed), list(seed)
    for axis in order:
        lines: NDArray[np.bool_] = np.moveaxis(room, axis, 0)
        others = tuple(slice(low[each], high[each] + 1) for each in range(room.ndim) if each != axis)
        slices = lines[(slice(None), *others)].reshape(room.shape[axis], -1)
        whole = [bool(each.all()) for each in slices]
        while low[axis] > 0 and whole[low[axis] - 1]:
            low[axis] -= 1
        while high[axis] < room.shape[axis] - 1 and whole[high[axis] + 1]:
            high[axis] += 1
    return CellBox(tuple(low), tuple(high))


def _slices(box: CellBox) -> tuple[slice, ...]:
    return tuple(slice(low, high + 1) for low, high in zip(box.low, box.high, strict=True))
