"""What variables move: base points (figure 5, S22), curves and singletons."""

from math import inf

from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.arithmetic.curves import curve_degree
from fcl_sim.arithmetic.operators import maximum, minimum
from fcl_sim.arithmetic.polyline import POINT_SIZE
from fcl_sim.engine.program import (
    CURVE_HEIGHT,
    CURVE_PARAMETER,
    CURVE_SIZE,
    FLOATS,
    LIMIT,
    MOVE,
    MOVE_COUNT,
    MOVE_INPUT,
    MOVE_LOW,
    MOVE_NOT,
    MOVE_SLOT,
    MOVE_SPOTS,
    MOVED,
    SPOT_DEGREE,
    SPOT_SIZE,
    SPOT_X,
    TERM_AT,
    TERM_COUNT,
    TERM_END,
    TERM_SPOTS,
)
from fcl_sim.jit import flat, inlined, u

Ints = NDArray[int64]
Floats = NDArray[float64]


@inlined
def sourced(source: int, floats: Floats, origin: int, memory: Floats, base: int) -> float:
    """Return the number that a source means (program.py)."""
    if source == 0:
        return 1.0
    number: float = floats[u(origin + source)] if source > 0 else memory[u(base - 1 - source)]
    return number


@inlined
def abscissa(source: int, floats: Floats, origin: int, memory: Floats, base: int) -> float:
    """Return a place on the axis; a variable is taken no further than constants may lie."""
    limit: float = floats[u(origin + LIMIT)]
    return minimum(limit, maximum(-limit, sourced(source, floats, origin, memory, base)))


@flat
def fuzzify_curve(
    ints: Ints, floats: Floats, origin: int, record: int, x: float, memory: Floats, base: int
) -> tuple[float, float]:
    """Return the degree, and 1 minus it, of a term that is a smooth curve."""
    a = record + CURVE_PARAMETER
    limit = floats[u(origin + LIMIT)]
    return curve_degree(
        -1 - ints[u(record + MOVE_COUNT)],
        minimum(limit, maximum(-limit, x)),
        abscissa(ints[u(a)], floats, origin, memory, base),
        abscissa(ints[u(a + 1)], floats, origin, memory, base),
        abscissa(ints[u(a + 2)], floats, origin, memory, base),
        abscissa(ints[u(a + 3)], floats, origin, memory, base),
        sourced(ints[u(record + CURVE_HEIGHT)], floats, origin, memory, base),
    )


@flat
def fuzzify_moved(ints: Ints, floats: Floats, at: int, memory: Floats, base: int) -> None:
    """Write the degrees, and 1 minus them, of all terms of inputs with moved points or curves."""
    origin = ints[u(at + FLOATS)]
    record = at + ints[u(at + MOVE)]
    for _ in range(ints[u(at + MOVED)]):
        ends = origin + ints[u(record + MOVE_LOW)]
        x = memory[u(base + ints[u(record + MOVE_INPUT)])]
        x = minimum(floats[u(ends + 1)], maximum(floats[u(ends)], x))
        if ints[u(record + MOVE_COUNT)] < 0:
            degree, complement = fuzzify_curve(ints, floats, origin, record, x, memory, base)
            memory[u(base + ints[u(record + MOVE_SLOT)])] = degree
            memory[u(base + ints[u(record + MOVE_NOT)])] = complement
            record += CURVE_SIZE
            continue
        count = ints[u(record + MOVE_COUNT)]
        spots = record + MOVE_SPOTS
        before = after = -inf
        degree = following = floats[u(origin + ints[u(spots + SPOT_DEGREE)])]
        peak = -1.0
        for spot in range(spots, spots + SPOT_SIZE * count, SPOT_SIZE):
            after = maximum(after, abscissa(ints[u(spot + SPOT_X)], floats, origin, memory, base))
            following = floats[u(origin + ints[u(spot + SPOT_DEGREE)])]
            if after > x:
                break
            if after == x:
                peak = maximum(peak, following)
            before, degree = after, following
        complement = 1.0 - degree
        if peak >= 0.0:  # points at x itself: the larger degree (S21)
            degree, complement = peak, 1.0 - peak
        elif before == -inf:
            degree, complement = following, 1.0 - following
        elif after > x:
            part, rest = (x - before) / (after - before), (after - x) / (after - before)
            rising = following > degree
            low, height, way = (degree, following, part) if rising else (following, degree, rest)
            back = rest if rising else part
            degree = minimum(1.0, low + (height - low) * way)
            complement = minimum(1.0, (1.0 - height) + (height - low) * back)
        memory[u(base + ints[u(record + MOVE_SLOT)])] = degree
        memory[u(base + ints[u(record + MOVE_NOT)])] = complement
        record = spots + SPOT_SIZE * count


@flat
def hull(
    ints: Ints, floats: Floats, origin: int, record: int, terms: int, memory: Floats, base: int
) -> tuple[float, float]:
    """Return the least and the largest abscissa of the points of all terms (S32)."""
    low, high = inf, -inf
    for _ in range(terms):
        count = ints[u(record + TERM_COUNT)]
        largest = -inf
        for spot in range(record + TERM_SPOTS, record + TERM_SPOTS + SPOT_SIZE * count, SPOT_SIZE):
            x = abscissa(ints[u(spot + SPOT_X)], floats, origin, memory, base)
            largest = maximum(largest, x)
            low = minimum(low, largest)
        high = maximum(high, largest)
        record += TERM_SPOTS + SPOT_SIZE * count
    return low, high


@flat
def place_terms(
    ints: Ints,
    floats: Floats,
    origin: int,
    record: int,
    terms: int,
    memory: Floats,
    base: int,
    low: float,
    high: float,
) -> None:
    """Write the points of all terms from limit to limit, each abscissa the largest so far (S22)."""
    for _ in range(terms):
        count = ints[u(record + TERM_COUNT)]
        first = end = base + ints[u(record + TERM_AT)]
        spots = record + TERM_SPOTS
        x, degree = -inf, floats[u(origin + ints[u(spots + SPOT_DEGREE)])]
        for spot in range(spots, spots + SPOT_SIZE * count, SPOT_SIZE):
            following = maximum(x, abscissa(ints[u(spot + SPOT_X)], floats, origin, memory, base))
            next_degree = floats[u(origin + ints[u(spot + SPOT_DEGREE)])]
            if following > low and x < low:
                end = put_point(memory, first, end, low, between(x, degree, following, next_degree, low))
            if following > high and x < high:
                end = put_point(memory, first, end, high, between(x, degree, following, next_degree, high))
            if low <= following <= high:
                end = put_point(memory, first, end, following, next_degree)
            x, degree = following, next_degree
        if x < low:
            end = put_point(memory, first, end, low, degree)
        if x < high:
            end = put_point(memory, first, end, high, degree)
        memory[u(base + ints[u(record + TERM_END)])] = (end - first) // POINT_SIZE
        record = spots + SPOT_SIZE * count


@inlined
def between(left: float, low: float, right: float, high: float, x: float) -> float:
    """Return the degree at `x` on the line between two points, the left one perhaps at minus infinity."""
    if left == -inf:
        return high
    if low < high:
        return low + (high - low) * ((x - left) / (right - left))
    return high + (low - high) * ((right - x) / (right - left))


@inlined
def put_point(memory: Floats, first: int, end: int, x: float, degree: float) -> int:
    """Append a point, and tell the one before its run; return the new end."""
    if end > first:
        rise = degree - memory[u(end - POINT_SIZE + 1)]
        memory[u(end - POINT_SIZE + 2)] = (x - memory[u(end - POINT_SIZE)]) / rise if rise != 0.0 else 0.0
    memory[u(end)] = x
    memory[u(end + 1)] = degree
    memory[u(end + 2)] = 0.0
    return end + POINT_SIZE
