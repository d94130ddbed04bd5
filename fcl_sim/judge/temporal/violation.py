"""Where a formula is first violated: the stretch of scans that makes it false, whatever the others are.

For every part of a formula, and every scan at which it is surely true or surely
false, there is the stretch that makes it so: rows with its first and its last
scan, (2, n), inf where the part is not so. They are found for all scans at once.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from fcl_sim.judge.temporal import windows
from fcl_sim.judge.temporal.evaluate import POSSIBLE, SURE, Course
from fcl_sim.judge.temporal.tree import Comparison, Edge, Junction, Not, Until, Window, signals
from fcl_sim.loop.trace import Values

Mask = NDArray[np.bool_]
Indices = NDArray[np.int64]

NOWHERE = np.full((1, 1), np.inf)


def violation(course: Course) -> tuple[int, int]:
    """Return first and last scan of the first stretch that makes a formula false at its first scan."""
    first, last = _Reasons(course.rows.shape[1]).why(course, value=False)[:, 0]
    return int(first), int(last)


def blamed(course: Course, first: int, last: int) -> tuple[str, ...]:
    """Return the signals, each once, of the comparisons that make a formula false from one scan to another.

    What an implication waits for is not to blame; all of it is where no comparison is found.
    """
    found = _at_fault(course, slice(first, last + 1), value=False)
    return tuple(dict.fromkeys(found)) or tuple(dict.fromkeys(signals(course.node)))


def _at_fault(course: Course, scans: slice, *, value: bool) -> Iterator[str]:
    node, parts = course.node, course.parts
    match node:
        case Comparison() if _surely(course, value=value)[scans].any():
            yield from signals(node)
        case Not():
            yield from _at_fault(parts[0], scans, value=not value)
        case Edge():
            yield from signals(node)
        case Junction(operator="implies"):
            if value:
                yield from _at_fault(parts[0], scans, value=False)
            yield from _at_fault(parts[1], scans, value=value)
        case Junction() | Window() | Until():
            for part in parts:
                yield from _at_fault(part, scans, value=value)


class _Reasons:
    """The stretches of a formula's parts over `count` scans, each looked for once."""

    def __init__(self, count: int) -> None:
        self.scans = np.arange(count)
        self.found: dict[tuple[int, bool], Values] = {}

    def why(self, course: Course, *, value: bool) -> Values:
        """Return the stretches that make a part `value`: of several, the first."""
        key = (id(course), value)
        if key not in self.found:
            rows = self._look(course, value=value)
            rows[:, ~_surely(course, value=value)] = np.inf
            self.found[key] = rows
        return self.found[key]

    def _look(self, course: Course, *, value: bool) -> Values:
        match course.node:
            case Not():
                return self.why(course.parts[0], value=not value).copy()
            case Edge(operator=operator):
                return self._edge(course.parts[0], rise=operator == "rise", value=value)
            case Junction(operator=operator):
                return self._junction(operator, course, value=value)
            case Window(operator=operator):
                whole = self._at_last if _lasts(course.parts[0]) else self._whole
                return (whole if (operator == "always") == value else self._first)(course, value=value)
            case Until():
                return self._kept(course) if value else self._broken(course)
            case _:
                return self._at_once()

    def _at_once(self) -> Values:
        return np.array([self.scans, self.scans], dtype=np.float64)

    def _edge(self, part: Course, *, rise: bool, value: bool) -> Values:
        now = self.why(part, value=rise == value)
        before = np.full_like(now, np.inf)
        before[:, 1:] = self.why(part, value=rise != value)[:, :-1]
        rows = _around(now, before) if value else _earlier(now, before)
        rows[:, 0] = 0.0
        return rows

    def _junction(self, operator: str, course: Course, *, value: bool) -> Values:
        left, right = course.parts
        implies = operator == "implies"
        why_right = self.why(right, value=value)
        if implies and not value and _is_trigger(left):
            return _around(self._at_once(), why_right)
        why_left = self.why(left, value=value != implies)
        if (operator == "and") == value or (implies and not value):
            return _around(why_left, why_right)
        return _earlier(why_left, why_right)

    def _whole(self, course: Course, *, value: bool) -> Values:
        """Return from the first to the last reason in a window all of which is `value`."""
        first, last = np.vsplit(self.why(course.parts[0], value=value), 2)
        if isinstance(course.node, Window) and course.node.interval.end is None:
            starts = windows.to_the_end(first, NOWHERE, course.over, np.minimum)
            stops = windows.to_the_end(last, NOWHERE, course.over, np.maximum)
        else:
            starts = windows.extreme(first, NOWHERE, course.over, np.minimum, np.inf)
            stops = windows.extreme(last, NOWHERE, course.over, np.maximum, -np.inf)
        return np.vstack([starts, stops])

    def _at_last(self, course: Course, *, value: bool) -> Values:
        """Return why what lasts to the end is `value` at the last scan of a window: it is so all along.

        `within 3 s P for good` is missed by the first scan from 3 s on that has no P, whatever is before.
        """
        last = np.minimum(course.over.last, len(self.scans) - 1)
        return self.why(course.parts[0], value=value)[:, last]

    def _first(self, course: Course, *, value: bool) -> Values:
        """Return the first stretch of a window over which its part is `value`."""
        (part,) = course.parts
        so, count = _surely(part, value=value), len(self.scans)
        begin = np.minimum(self._next(so).take(course.over.first), count - 1)
        end = np.minimum(self._next(~so).take(begin) - 1, np.minimum(course.over.last, count - 1))
        why = self.why(part, value=value)
        return _around(why.take(begin, axis=1), why.take(np.maximum(end, begin), axis=1))

    def _broken(self, course: Course) -> Values:
        """Return why an until is false: its right side up to where the left one goes, or all of it."""
        left, right = course.parts
        over, count = course.over, len(self.scans)
        goes = self._next(_surely(left, value=False))[:-1]
        gone = goes < np.maximum(over.first, over.last)
        stop = np.minimum(np.where(gone, goes, over.last), count - 1)
        rows = self._between(right, over.first, stop, value=False)
        why = self.why(left, value=False)[:, stop]
        return np.where(gone, _around(rows, why), rows)

    def _kept(self, course: Course) -> Values:
        """Return why an until is true: its right side where it first is, its left side up to there."""
        left, right = course.parts
        come = self._next(_surely(right, value=True))[course.over.first]
        come = np.minimum(come, len(self.scans) - 1)
        held = self._between(left, self.scans, come - 1, value=True)
        return _around(held, self.why(right, value=True)[:, come])

    def _between(self, part: Course, first: Indices, last: Indices, *, value: bool) -> Values:
        starts, stops = np.vsplit(self.why(part, value=value), 2)
        first = np.minimum(first, len(self.scans))
        return np.vstack(
            [
                windows.anywhere(starts, first, last, np.minimum, np.inf),
                windows.anywhere(stops, first, last, np.maximum, -np.inf),
            ]
        )

    def _next(self, so: Mask) -> Indices:
        """Return (n + 1,) for each scan the next one, itself included, that is `so`; n where none is."""
        count = len(self.scans)
        ahead = np.where(so, self.scans, count)[::-1]
        return np.append(np.minimum.accumulate(ahead)[::-1], count)


def _surely(course: Course, *, value: bool) -> Mask:
    found: Mask = course.rows[SURE] > 0 if value else course.rows[POSSIBLE] < 0
    return found


def _lasts(course: Course) -> bool:
    """Return whether a part looks at all scans from some distance on: what it sees later it sees earlier."""
    return isinstance(course.node, Window) and course.node.interval.end is None


def _is_trigger(course: Course) -> bool:
    """Return whether a part is a state, or the edge of one: it is told by the scan at which it comes."""
    return _is_state(course) or (isinstance(course.node, Edge) and _is_state(course.parts[0]))


def _is_state(course: Course) -> bool:
    """Return whether a part looks at its own scan alone."""
    return not isinstance(course.node, Edge | Window | Until) and all(map(_is_state, course.parts))


def _around(one: Values, other: Values) -> Values:
    return np.vstack([np.minimum(one[0], other[0]), np.maximum(one[1], other[1])])


def _earlier(one: Values, other: Values) -> Values:
    first = (one[0] < other[0]) | ((one[0] == other[0]) & (one[1] <= other[1]))
    return np.where(first, one, other)
