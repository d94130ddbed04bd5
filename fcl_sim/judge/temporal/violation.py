"""Where a formula is first violated: the stretch of scans that makes it false, whatever the others are."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from fcl_sim.judge.temporal.evaluate import POSSIBLE, SURE, Course
from fcl_sim.judge.temporal.tree import Edge, Junction, Not, Until, Window

Stretch = tuple[int, int]
"""First and last scan."""


def violation(course: Course) -> Stretch:
    """Return the first stretch of scans that makes a formula false at the first scan; it must be so."""
    return _Reasons().why(course, 0, value=False)


class _Reasons:
    """Stretches that make parts of a formula true or false, each looked for once."""

    def __init__(self) -> None:
        self.found: dict[tuple[int, int, bool], Stretch] = {}

    def why(self, course: Course, scan: int, *, value: bool) -> Stretch:
        """Return the stretch that makes a part `value` at a scan: of several, the first."""
        key = (id(course), scan, value)
        if key not in self.found:
            self.found[key] = self._look(course, scan, value=value)
        return self.found[key]

    def _look(self, course: Course, scan: int, *, value: bool) -> Stretch:
        match course.node:
            case Not():
                return self.why(course.parts[0], scan, value=not value)
            case Edge(operator=operator):
                return self._edge(course.parts[0], scan, value, rise=operator == "rise")
            case Junction(operator=operator):
                return self._junction(operator, course, scan, value=value)
            case Window(operator=operator):
                whole = (operator == "always") == value
                return (self._all if whole else self._first)(course, scan, value=value)
            case Until():
                return self._until(course, scan, value=value)
            case _:
                return scan, scan

    def _edge(self, part: Course, scan: int, value: bool, *, rise: bool) -> Stretch:  # noqa: FBT001
        if scan == 0:
            return 0, 0
        reasons = [
            self.why(part, at, value=wanted == value)
            for at, wanted in ((scan - 1, not rise), (scan, rise))
            if _surely(part, value=wanted == value)[at]
        ]
        return _around(reasons) if value else min(reasons)

    def _junction(self, operator: str, course: Course, scan: int, *, value: bool) -> Stretch:
        wanted = (value != (operator == "implies"), value)
        reasons = [
            self.why(part, scan, value=want)
            for part, want in zip(course.parts, wanted, strict=True)
            if _surely(part, value=want)[scan]
        ]
        if operator == "implies" and not value and _is_trigger(course.parts[0]):
            return _around([(scan, scan), reasons[1]])
        return _around(reasons) if (operator == "and") == value else min(reasons)

    def _all(self, course: Course, scan: int, *, value: bool) -> Stretch:
        (part,) = course.parts
        first, last = _within(course, scan)
        if _is_state(part):
            return first, last
        return _around(self.why(part, at, value=value) for at in range(first, last + 1))

    def _first(self, course: Course, scan: int, *, value: bool) -> Stretch:
        """Return the first stretch of a window over which its part is `value`."""
        (part,) = course.parts
        first, last = _within(course, scan)
        so = _surely(part, value=value)[first : last + 1]
        begin = first + int(np.argmax(so))
        rest = so[begin - first :]
        end = begin + (len(rest) if rest.all() else int(np.argmin(rest))) - 1
        return _around((self.why(part, begin, value=value), self.why(part, end, value=value)))

    def _until(self, course: Course, scan: int, *, value: bool) -> Stretch:
        left, right = course.parts
        if value:
            return self._kept(course, scan)
        first, last = int(course.over.first[scan]), int(course.over.last[scan])
        gone = np.flatnonzero(_surely(left, value=False)[scan : max(first, last)])
        stop = scan + int(gone[0]) if len(gone) else last
        reasons = [self.why(right, at, value=False) for at in range(first, stop + 1)]
        if len(gone):
            reasons.append(self.why(left, stop, value=False))
        return _around(reasons)

    def _kept(self, course: Course, scan: int) -> Stretch:
        """Return the stretch that makes an until true."""
        left, right = course.parts
        first, last = _within(course, scan)
        come = first + int(np.argmax(_surely(right, value=True)[first : last + 1]))
        held = [self.why(left, at, value=True) for at in range(scan, come)]
        return _around([*held, self.why(right, come, value=True)])


def _surely(course: Course, *, value: bool) -> NDArray[np.bool_]:
    found: NDArray[np.bool_] = course.rows[SURE] > 0 if value else course.rows[POSSIBLE] < 0
    return found


def _is_state(course: Course) -> bool:
    """Return whether a part looks at its own scan alone."""
    return not isinstance(course.node, Edge | Window | Until) and all(map(_is_state, course.parts))


def _is_trigger(course: Course) -> bool:
    """Return whether a part is a state, or the edge of one: it is told by the scan at which it comes."""
    return _is_state(course) or (isinstance(course.node, Edge) and _is_state(course.parts[0]))


def _within(course: Course, scan: int) -> Stretch:
    """Return the scans of a window, as far as the trace goes."""
    count = course.rows.shape[1] - 1
    return min(int(course.over.first[scan]), count), min(int(course.over.last[scan]), count)


def _around(reasons: Iterable[Stretch]) -> Stretch:
    told = list(reasons)
    return min(each[0] for each in told), max(each[1] for each in told)
