"""Areas under norms of the Open Level: a polyline within 1e-6 of the accumulated membership function (S33).

The terms are swept from left to right. Between two places where one of them
has a point, or where an activation has a kink or a jump, every activated term
is smooth, and what they accumulate to is halved until it is straight enough:
within 1e-6, in binary32 within 1e-5.
"""

from math import inf

from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.arithmetic.operators import maximum
from fcl_sim.arithmetic.pairs import AND_DPROD, AND_NMIN
from fcl_sim.arithmetic.polyline import VERTEX_SIZE, join, put
from fcl_sim.engine.activated import (
    HELD_SIZE,
    begin_tracks,
    between_jumps,
    choose_pieces,
    degree_at_place,
    degree_within,
    hold,
    next_jump,
    next_kink,
    next_place,
    pass_place,
    reach,
)
from fcl_sim.engine.program import (
    AREA_LINE,
    AREA_PART,
    AREA_ROOM,
    CURVED_HELD,
    CURVED_KIND,
    CURVED_STACK,
    FLOATS,
    GROUP_MAX,
    TIE,
)
from fcl_sim.jit import apart, flat, u

Ints = NDArray[int64]
Floats = NDArray[float64]

TOLERANCE = 1e-6
"""Largest distance of the polyline from what it stands for, but for the place of a jump."""
TAKEN = 0.8 * TOLERANCE
"""What is allowed at the places that are looked at: between them it may be a little more. Degrees that were
rounded more coarsely are allowed what tells them apart."""
LOOKED = (0.2, 0.35, 0.5, 0.65, 0.8)
"""Those places, in parts of a stretch."""
DEPTH = 48
FINEST = 2.0**-DEPTH
"""Where halving ends: a kink that nothing tells of is found to this part of a stretch."""
SPARE = 8 * VERTEX_SIZE
"""Words that are looked for at once, before vertices are written where terms have points and kinks."""


Curved = int | None
"""CURVED, or None for programs without areas under norms of the Open Level: numba then compiles no sweep."""
CURVED = 1


@apart
def accumulate_curved(
    ints: Ints,
    floats: Floats,
    at: int,
    area: int,
    record: int,
    low: float,
    line: int,
    other: int,
    memory: Floats,
    base: int,
) -> tuple[int, int, int]:
    """Write a curved accumulation to `line` or `other`; return where it begins and ends, and the free one.

    It ends at 0 where the room is too short.
    """
    room = ints[u(area + AREA_ROOM)]
    part = base + ints[u(area + AREA_PART)]
    count = hold(ints, floats, at, record, memory, base)
    if ints[u(record + CURVED_KIND)] != GROUP_MAX:
        if count == 0:
            return line, line, other
        return line, sweep(ints, floats, at, record, 0, count, low, line, line + room, memory, base), other
    end = line
    for pair in range(count):
        target = line if pair == 0 else part
        limit = line + room if pair == 0 else base + ints[u(area + AREA_LINE)]
        reached = sweep(ints, floats, at, record, pair, pair + 1, low, target, limit, memory, base)
        if reached == 0:
            return line, 0, other
        if pair == 0:
            end = reached
        else:
            reached = join(memory, line, end, part, reached, other, other + room, 0)
            line, end, other = other, reached, line
    return line, end, other


@flat
def sweep(
    ints: Ints,
    floats: Floats,
    at: int,
    record: int,
    first: int,
    last: int,
    low: float,
    target: int,
    room: int,
    memory: Floats,
    base: int,
) -> int:
    """Write what the held pairs from `first` to before `last` accumulate to, to `memory[target]`.

    Return the end of the polyline, or 0 where it would go beyond `room`. `low`
    is the lower limit of the range.
    """
    kind = ints[u(record + CURVED_KIND)]
    tie = floats[u(ints[u(at + FLOATS)] + TIE)]
    stack = base + ints[u(record + CURVED_STACK)]
    held = base + ints[u(record + CURVED_HELD)]
    first, last = held + first * HELD_SIZE, held + last * HELD_SIZE
    begin_tracks(ints, record, first, last, memory, base)
    x = next_place(ints, floats, at, record, memory, base)
    end = target
    if low < x < inf:
        end = put(memory, end, x, 0.0)
    while x < inf:
        pass_place(ints, floats, at, record, x, memory, base)
        peak = degree_at_place(kind, first, last, memory)
        following = next_place(ints, floats, at, record, memory, base)
        if following == inf:
            return put_limits(memory, target, end, x, peak, 0.0)
        reach(ints, floats, at, record, following, memory, base)
        end = cross(kind, tie, stack, first, last, x, following, peak, target, end, room, memory)
        if end == 0:
            return 0
        x = following
    return end


@flat
def cross(
    kind: int,
    tie: float,
    stack: int,
    first: int,
    last: int,
    x: float,
    following: float,
    peak: float,
    target: int,
    end: int,
    room: int,
    memory: Floats,
) -> int:
    """Append the vertices of a stretch, from kink to kink; return the end, or 0.

    `peak` is the degree at `x` itself.
    """
    taken = maximum(TAKEN, 1.0 - tie)
    begin = 0.0
    while begin < 1.0:
        if end + SPARE > room:
            return 0
        stop = next_kink(first, last, begin, memory)
        live, bent = choose_pieces(first, last, 0.5 * (begin + stop), memory)
        own = kind
        if kind == AND_NMIN:
            stop = next_jump(first, last, begin, stop, tie, memory)
            own = between_jumps(first, last, 0.5 * (begin + stop), tie, memory)
        left = degree_within(own, first, last, begin, memory)
        right = degree_within(own, first, last, stop, memory)
        end = put_limits(memory, target, end, x + (following - x) * begin, peak, left)
        if bent > 0 or (own < 0 and own != AND_DPROD and live > 1):
            end = refine(
                own, taken, stack, first, last, x, following, begin, left, stop, right, end, room, memory
            )
            if end == 0:
                return 0
        end = put(memory, end, x + (following - x) * stop, right)
        begin, peak = stop, 0.0
    return end


@flat
def put_limits(memory: Floats, target: int, end: int, x: float, peak: float, after: float) -> int:
    """Append what there is at `x` besides the limit from the left: a peak, the limit from the right."""
    before = memory[u(end - 1)] if end > target else 0.0
    spike = peak > before and peak > after
    if spike:
        end = put(memory, end, x, peak)
    if spike or after != before or end == target:
        end = put(memory, end, x, after)
    return end


@flat
def refine(
    kind: int,
    taken: float,
    stack: int,
    first: int,
    last: int,
    x: float,
    following: float,
    begin: float,
    degree: float,
    stop: float,
    stop_degree: float,
    end: int,
    room: int,
    memory: Floats,
) -> int:
    """Append the vertices between two places, halving while the line is bent; return the end, or 0.

    `begin` and `stop` are parts of the stretch from `x` to `following`, with
    their degrees.
    """
    memory[u(stack)] = stop
    memory[u(stack + 1)] = stop_degree
    top = stack
    while top >= stack:
        right, right_degree = memory[u(top)], memory[u(top + 1)]
        middle = 0.5 * (begin + right)
        if (
            right - begin > FINEST
            and begin < middle < right
            and is_bent(kind, taken, first, last, begin, degree, right, right_degree, memory)
        ):
            top += VERTEX_SIZE
            memory[u(top)] = middle
            memory[u(top + 1)] = degree_within(kind, first, last, middle, memory)
        else:
            begin, degree = right, right_degree
            top -= VERTEX_SIZE
            if top >= stack:
                if end + SPARE > room:
                    return 0
                end = put(memory, end, x + (following - x) * begin, degree)
    return end


@flat
def is_bent(
    kind: int,
    taken: float,
    first: int,
    last: int,
    begin: float,
    degree: float,
    right: float,
    right_degree: float,
    memory: Floats,
) -> bool:
    """Return whether the degrees between two places leave the straight line by more than is taken."""
    for part in LOOKED:
        found = degree_within(kind, first, last, begin + (right - begin) * part, memory)
        if abs(found - (degree + (right_degree - degree) * part)) > taken:
            return True
    return False
