"""A table of rising places with a value each: checked, laid down for a kernel, and looked up."""

from collections.abc import Iterator, Sequence
from math import nan
from typing import Any

from fcl_sim.jit import flat
from fcl_sim.loop.blocks.declaration import Misfit, Prepared
from fcl_sim.loop.row import Row, number

LINEAR, HELD = 0, 1
BETWEEN = ("linear", "hold")
"""How a value between two places is found: on the straight line, or that of the place before."""


@flat
def segment(row: Row, first: int, count: int, at: float) -> int:
    """Return the last of the places, numbers from `first` on, that is not beyond `at`; -1 where all are."""
    low, high = -1, count
    while high - low > 1:
        middle = (low + high) >> 1
        if number(row, first + middle) <= at:
            low = middle
        else:
            high = middle
    return low


@flat
def looked_up(row: Row, first: int, count: int, at: float, between: int) -> float:
    """Return the value at a place; before the first and behind the last they are held. NaN for NaN."""
    if at != at:  # noqa: PLR0124  NaN is not itself
        return nan
    i = segment(row, first, count, at)
    if i < 0:
        return number(row, first + count)
    if i == count - 1 or between == HELD:
        return number(row, first + count + i)
    return on_line(row, first, count, at, i)


@flat
def on_line(row: Row, first: int, count: int, at: float, i: int) -> float:
    """Return the value on the straight line through place `i` and the next one."""
    left, right = number(row, first + i), number(row, first + i + 1)
    low, high = number(row, first + count + i), number(row, first + count + i + 1)
    value: float = low + (at - left) / (right - left) * (high - low)
    return value


def laid_down(points: Any) -> Prepared:
    """Return what the kernels above need of an array (n, 2): the places, the values, their number."""
    return Prepared(numbers=[*points[:, 0].tolist(), *points[:, 1].tolist()], words=(len(points),))


def rising(parameter: str, places: Sequence[float], shown: str) -> Iterator[Misfit]:
    """Yield what is wrong where places do not rise strictly; `shown` is what they are called."""
    for i in range(1, len(places)):
        if not places[i] > places[i - 1]:
            told = f"{shown} {i + 1} of `{parameter}`, {places[i]:.9g}, is not beyond {places[i - 1]:.9g}"
            hint = f"each {shown} lies beyond the one before"
            yield Misfit(parameter=parameter, message=told, hint=hint)
            return
