"""Smallest and largest values of sliding windows, and the operator until, without a loop over samples.

Arrays are (k, n): k rows over n scans. All take time n log w for windows of
w scans, by doubling: the extreme of 2m samples is that of two times m.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fcl_sim.loop.trace import Values

Indices = NDArray[np.int64]
Pick = Callable[[Values, Values], Values]


@dataclass(frozen=True, slots=True, eq=False)
class Reach:
    """The scans `first` to `last` (n,) that a window reaches from each of n scans; n: beyond the end.

    `shift` are the two distances where they are the same from every scan.
    """

    first: Indices
    last: Indices
    shift: tuple[int, int] | None = None

    @property
    def at_once(self) -> bool:
        """Whether every window begins at its own scan."""
        return bool((self.first == np.arange(len(self.first))).all())


def reach(ticks: Indices, start: int, end: int | None) -> Reach:
    """Return what the window from `start` to `end` nanoseconds reaches; None is the end of the trace.

    It begins with the scan that holds at `start`: the last one not after it.
    """
    count, steps = len(ticks), np.diff(ticks)
    step = int(steps[0]) if count > 1 else 0
    last_tick = int(ticks[-1])
    if step and start % step == 0 == (end or 0) % step and (steps == step).all():
        scans = np.arange(count)
        one = min(start // step, count)
        other = count if end is None else min(end // step, count)
        first = np.minimum(scans + one, count)
        if end is None:
            return Reach(first, np.full(count, count - 1))
        return Reach(first, np.minimum(scans + other, count), (one, other))
    first = np.searchsorted(ticks, ticks + start, side="right") - 1
    first[ticks > last_tick - start] = count
    if end is None:
        return Reach(first, np.full(count, count - 1))
    last = np.searchsorted(ticks, ticks + end, side="right") - 1
    last[ticks > last_tick - end] = count
    return Reach(first, last)


def extreme(values: Values, beyond: Values, over: Reach, pick: Pick, neutral: float) -> Values:
    """Return (k, n): the extreme of each window, with `beyond` (k, 1) for what comes after the end.

    `pick` is np.minimum or np.maximum, `neutral` what it gives for an empty window.
    """
    if over.shift is not None:
        return _sliding(values, beyond, over.shift, pick)
    return anywhere(np.hstack([values, beyond]), over.first, over.last, pick, neutral)


def _sliding(values: Values, beyond: Values, shift: tuple[int, int], pick: Pick) -> Values:
    count, (first, last) = values.shape[1], shift
    width, size = last - first + 1, 1
    table = np.hstack([values[:, first:], np.repeat(beyond, min(first, count) + width - 1, axis=1)])
    while 2 * size <= width:
        table = pick(table[:, :-size], table[:, size:])
        size *= 2
    return pick(table[:, :count], table[:, width - size : width - size + count])


def anywhere(values: Values, first: Indices, last: Indices, pick: Pick, neutral: float) -> Values:
    """Return (k, m): the extreme of the columns `first` to `last` (m,); `neutral` where last < first."""
    found = np.full((len(values), len(first)), neutral)
    width = np.maximum(last - first + 1, 0)
    level = np.frexp(width.astype(np.float64))[1] - 1  # 2**level <= width; -1 where empty
    table, size = values, 1
    for at in range(int(level.max(initial=-1)) + 1):
        if at:
            table, size = pick(table[:, :-size], table[:, size:]), 2 * size
        here = np.flatnonzero(level == at)
        if len(here):
            found[:, here] = pick(table[:, first[here]], table[:, last[here] - size + 1])
    return found


def to_the_end(values: Values, beyond: Values, over: Reach, pick: np.ufunc) -> Values:
    """Return (k, n): the extreme from the first scan of each window to the end of the trace."""
    backwards = pick.accumulate(np.ascontiguousarray(values[:, ::-1]), axis=1)
    whole = np.hstack([backwards[:, ::-1], beyond])
    rows: Values = whole[:, over.first]
    return rows


def before(values: Values, over: Reach) -> Values:
    """Return (k, n): the smallest from each scan to the one before its window begins."""
    scans = np.arange(values.shape[1])
    shift = None if over.shift is None else (0, over.shift[0] - 1)
    nothing = np.full((len(values), 1), np.inf)  # its scans beyond the end are counted by the window itself
    return extreme(values, nothing, Reach(scans, over.first - 1, shift), np.minimum, np.inf)


def until(left: Values, right: Values, beyond: Values) -> Values:
    """Return (k, n): u_i = max(right_i, min(left_i, u_i+1)), with u_n = `beyond` (k, 1).

    Each step is a function u ↦ max(p, min(q, u)), and two of them make one of
    the same form, so that all are composed by doubling.
    """
    p, q, size = right.copy(), left.copy(), 1
    while size < p.shape[1]:
        p[:, :-size] = np.maximum(p[:, :-size], np.minimum(q[:, :-size], p[:, size:]))
        q[:, :-size] = np.minimum(q[:, :-size], q[:, size:])
        size *= 2
    found: Values = np.maximum(p, np.minimum(q, beyond))
    return found
