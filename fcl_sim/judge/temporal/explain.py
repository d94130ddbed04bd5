"""What decides the verdict on a formula: the scans that matter, the comparison, the trigger."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fcl_sim.judge.temporal.evaluate import POSSIBLE, SURE, Course
from fcl_sim.judge.temporal.tree import Comparison, Edge, Junction, Until, Window

Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Look:
    """A part of a formula, and the scans (n,) at which the whole looks at it."""

    course: Course
    where: Mask


def looks(course: Course, where: Mask) -> Iterator[Look]:
    """Yield every part of a formula with the scans at which it matters.

    What follows `implies` matters where its left side can be true.
    """
    yield Look(course, where)
    node = course.node
    match node:
        case Window():
            yield from looks(course.parts[0], _reached(course, where))
        case Until():
            yield from looks(course.parts[0], _reached(course, where, before=True))
            yield from looks(course.parts[1], _reached(course, where))
        case Edge():
            (part,) = course.parts
            yield from looks(part, where | np.append(where[1:], False))
        case Junction(operator="implies"):
            left, right = course.parts
            yield from looks(left, where)
            yield from looks(right, where & (left.rows[POSSIBLE] > 0))
        case _:
            for part in course.parts:
                yield from looks(part, where)


def _reached(course: Course, where: Mask, *, before: bool = False) -> Mask:
    """Return the scans that the windows of `where` reach; of until's left side, those before their last."""
    count, over = len(where), course.over
    starts, stops = over.first[where], over.last[where] + 1
    if before:
        starts, stops = np.flatnonzero(where), np.maximum(starts, stops - 1)
    starts = np.minimum(starts, count)
    stops = np.clip(stops, starts, count)
    change = np.bincount(starts, minlength=count + 1) - np.bincount(stops, minlength=count + 1)
    found: Mask = np.cumsum(change)[:count] > 0
    return found


def broken(found: list[Look]) -> tuple[int, Comparison] | None:
    """Return the first scan at which a comparison that matters has no finite numbers, and which one."""
    at: list[tuple[int, Comparison]] = []
    for look in found:
        node = look.course.node
        if isinstance(node, Comparison):
            where = look.where & look.course.broken
            if where.any():
                at.append((int(np.argmax(where)), node))
    return min(at, key=lambda each: each[0], default=None)


def untested(found: list[Look]) -> Junction | None:
    """Return an `implies` whose left side is nowhere true where it matters, or None."""
    for look in found:
        node = look.course.node
        if isinstance(node, Junction) and node.operator == "implies":
            left = look.course.parts[0]
            if not (look.where & (left.rows[SURE] > 0)).any():
                return node
    return None


def deciding(
    found: list[Look], robustness: float, within: tuple[int, int] | None = None
) -> tuple[Comparison, int] | None:
    """Return the comparison, and its first scan, whose margin is the robustness of the whole.

    Of several scans that is the first `within` a stretch, from its first to its last, if any is.
    """
    first: tuple[Comparison, int] | None = None
    for look in found:
        node = look.course.node
        if isinstance(node, Comparison):
            here = np.flatnonzero(look.where & (np.abs(look.course.rows[0]) == abs(robustness)))
            inside = here[(here >= within[0]) & (here <= within[1])] if within else here
            if len(inside):
                return node, int(inside[0])
            if len(here) and first is None:
                first = node, int(here[0])
    return first
