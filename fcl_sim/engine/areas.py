"""An output with areas: activation, weights, accumulation, and where its area lies."""

from math import nan

from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.arithmetic.defuzzify import centre_of_area, centre_of_gravity, extreme_maximum
from fcl_sim.arithmetic.operators import maximum, minimum
from fcl_sim.arithmetic.polyline import LEVEL_SIZE, VERTEX_SIZE, activate, bound, cut_off, highest, join
from fcl_sim.engine.curved import Curved, accumulate_curved
from fcl_sim.engine.moving import hull, place_terms, sourced
from fcl_sim.engine.program import (
    AREA_GROUP,
    AREA_GROUPS,
    AREA_HULL,
    AREA_LEVELS,
    AREA_LINE,
    AREA_LOW,
    AREA_MOVE,
    AREA_MOVED,
    AREA_PART,
    AREA_RESULT,
    AREA_ROOM,
    CURVED_KIND,
    FLOATS,
    GROUP_BSUM,
    GROUP_CURVED,
    GROUP_MAX,
    GROUP_NSUM,
    LIMIT,
    METHOD_COA,
    METHOD_COG,
    METHOD_LM,
    METHOD_RM,
    PART_END,
    PART_PAIR,
    PART_PAIRS,
    PART_TERM,
    TIE,
)
from fcl_sim.jit import flat, u

Ints = NDArray[int64]
Floats = NDArray[float64]


@flat
def settle_area(
    ints: Ints, floats: Floats, at: int, area: int, method: int, memory: Floats, base: int, curved: Curved
) -> tuple[float, float]:
    """Return the value of an output with areas, and its area, 0 where no rule is active (S30, S31).

    The value is NaN where there is no room for the polyline that S33 asks for.
    """
    origin = ints[u(at + FLOATS)]
    limits = origin + ints[u(area + AREA_LOW)]
    low, high = floats[u(limits)], floats[u(limits + 1)]
    moved = ints[u(area + AREA_MOVED)]
    if moved > 0:
        record = at + ints[u(area + AREA_MOVE)]
        if ints[u(area + AREA_HULL)] == 1:
            low, high = hull(ints, floats, origin, record, moved, memory, base)
        place_terms(ints, floats, origin, record, moved, memory, base, low, high)
    result = base + ints[u(area + AREA_RESULT)]
    memory[u(result)] = memory[u(result + 1)] = 0.0
    if not low < high:
        return low, 0.0
    first, end = accumulate_area(ints, floats, at, area, low, memory, base, curved)
    if end == 0:
        return nan, 1.0
    memory[u(result)] = first - base
    memory[u(result + 1)] = end - base
    if first == end:
        return low, 0.0
    scale = 1.0 / maximum(high - low, 1.0 / floats[u(origin + LIMIT)])
    content, distance = centre_of_gravity(memory, first, end, low, scale)
    value = low + distance
    if method != METHOD_COG and content > 0.0:
        top, tie = highest(memory, first, end), floats[u(origin + TIE)]
        if method == METHOD_COA:
            value = centre_of_area(memory, first, end, scale, top, tie)
        else:
            left = extreme_maximum(memory, first, end, top, tie, 1)
            right = extreme_maximum(memory, first, end, top, tie, -1)
            both = 0.5 * left + 0.5 * right
            value = left if method == METHOD_LM else right if method == METHOD_RM else both
    return minimum(high, maximum(low, value)), content


@flat
def accumulate_area(
    ints: Ints, floats: Floats, at: int, area: int, low: float, memory: Floats, base: int, curved: Curved
) -> tuple[int, int]:
    """Return where the accumulated polyline begins and ends; where nothing is active they are one.

    `low` is the lower limit of the range. It ends at 0 where the room is too short.
    """
    room = ints[u(area + AREA_ROOM)]
    other = base + ints[u(area + AREA_LINE)]
    line, whole = other + room, other + 2 * room
    whole_end = whole
    part = at + ints[u(area + AREA_GROUP)]
    groups = ints[u(area + AREA_GROUPS)]
    line_end = line
    for _ in range(groups):
        kind = ints[u(part)]
        count = ints[u(part + 1)]
        part += 2
        line_end = line
        if kind == GROUP_CURVED:
            record = at + count
            kind = ints[u(record + CURVED_KIND)]
            if curved is None:
                return line, 0
            line, line_end, other = accumulate_curved(
                ints, floats, at, area, record, low, line, other, memory, base
            )
            if line_end == 0:
                return line, 0
            count = 0
        for _ in range(count):
            target = line if line_end == line else base + ints[u(area + AREA_PART)]
            end = activate_part(ints, floats, at, area, part, target, memory, base)
            if target == line:
                line_end = end
            elif end > target:
                adding = int(kind != GROUP_MAX)
                end = join(memory, line, line_end, target, end, other, other + room, adding)
                line, line_end, other = other, end, line
            part += PART_PAIR + 2 * ints[u(part + PART_PAIRS)]
        top = highest(memory, line, line_end) if kind != GROUP_MAX else 0.0
        if kind == GROUP_BSUM and top > 1.0:
            end = bound(memory, line, line_end, other)
            line, line_end, other = other, end, line
        if kind == GROUP_NSUM and top > 1.0:
            for vertex in range(line, line_end, VERTEX_SIZE):
                memory[u(vertex + 1)] /= top
        if groups > 1:
            if whole_end == whole:
                whole, whole_end, line = line, line_end, whole
            elif line_end > line:
                end = join(memory, whole, whole_end, line, line_end, other, other + room, 0)
                whole, whole_end, other = other, end, whole
    return (whole, whole_end) if groups > 1 else (line, line_end)


@flat
def activate_part(
    ints: Ints, floats: Floats, at: int, area: int, part: int, target: int, memory: Floats, base: int
) -> int:
    """Write one activated and weighted term to `memory[target]`; return its end, `target` where it is 0."""
    origin = ints[u(at + FLOATS)]
    first = base + ints[u(area + AREA_LEVELS)]
    pairs = part + PART_PAIR
    source = ints[u(part + PART_TERM)]
    end = ints[u(part + PART_END)]
    if ints[u(part + PART_PAIRS)] == 1 and source > 0:
        cut = sourced(ints[u(pairs)], floats, origin, memory, base)
        factor = sourced(ints[u(pairs + 1)], floats, origin, memory, base)
        if not (cut > 0.0 and factor > 0.0):
            return target
        return cut_off(floats, origin + source, -1 - end, memory, cut, factor, target)
    count = 0
    for pair in range(pairs, pairs + 2 * ints[u(part + PART_PAIRS)], 2):
        cut = sourced(ints[u(pair)], floats, origin, memory, base)
        factor = sourced(ints[u(pair + 1)], floats, origin, memory, base)
        if cut > 0.0 and factor > 0.0:
            count += 1
            level = first + LEVEL_SIZE * count
            memory[u(level)] = cut
            memory[u(level + 1)] = factor
    if count == 0:
        return target
    if count > 1:
        sort_levels(memory, first + LEVEL_SIZE, count)
    value, slope = 0.0, 0.0
    for level in range(first + LEVEL_SIZE * count, first, -LEVEL_SIZE):
        memory[u(level + 2)] = slope
        slope += memory[u(level + 1)]
    memory[u(first)] = memory[u(first + 1)] = 0.0
    memory[u(first + 2)] = slope
    for level in range(first + LEVEL_SIZE, first + LEVEL_SIZE * (count + 1), LEVEL_SIZE):
        value += memory[u(level)] * memory[u(level + 1)]
        memory[u(level + 1)] = value
    if source > 0:
        return activate(floats, origin + source, -1 - end, memory, first, count, target)
    points = int(memory[u(base + end)])
    return activate(memory, base - 1 - source, points, memory, first, count, target)


@flat
def sort_levels(memory: Floats, first: int, count: int) -> None:
    """Sort levels by the degree where they begin (comb sort)."""
    gap = count
    swapped = True
    while gap > 1 or swapped:
        gap = max(1, gap * 10 // 13)
        swapped = False
        for left in range(first, first + LEVEL_SIZE * (count - gap), LEVEL_SIZE):
            right = left + LEVEL_SIZE * gap
            if memory[u(left)] > memory[u(right)]:
                begin, factor = memory[u(left)], memory[u(left + 1)]
                memory[u(left)], memory[u(left + 1)] = memory[u(right)], memory[u(right + 1)]
                memory[u(right)], memory[u(right + 1)] = begin, factor
                swapped = True
