"""Piecewise linear functions in a buffer: activation and accumulation of areas, exactly (Tables 4 and 5).

A polyline is a row of vertices (x, degree), x never falling, and 0 outside of
them. Two vertices at one x are a vertical edge; one between two others is the
degree at x itself where that is larger (S21).
"""

from math import inf

from numpy import float64
from numpy.typing import NDArray

from fcl_sim.arithmetic.operators import maximum, minimum
from fcl_sim.jit import flat, inlined, u

Floats = NDArray[float64]

VERTEX_SIZE = 2
POINT_SIZE = 3
"""A point of a term: x, degree, and the run to the next: the distance over which the degree rises by 1."""
LEVEL_SIZE = 3
"""A level of an activation: the degree where it begins, and its line: value and slope over the degree."""


@inlined
def put(memory: Floats, end: int, x: float, degree: float) -> int:
    """Append a vertex at `end`; return the new end."""
    memory[u(end)] = x
    memory[u(end + 1)] = degree
    return end + VERTEX_SIZE


@inlined
def crossing(points: Floats, point: int, degree: float) -> float:
    """Return where a term passes a degree between a point and the next; measured from the lower end."""
    x, following = points[u(point)], points[u(point + POINT_SIZE)]
    low, high = points[u(point + 1)], points[u(point + POINT_SIZE + 1)]
    run = points[u(point + 2)]
    at = x + (degree - low) * run if low < high else following + (degree - high) * run
    return minimum(following, maximum(x, at))


@flat
def activate(
    points: Floats, point: int, count: int, memory: Floats, level: int, levels: int, target: int
) -> int:
    """Write an activated term to `memory[target]`; return the end of its polyline.

    The term has `count` points at `points[point]`. What it becomes is a concave
    function of its degree, straight between levels: that at `memory[level]`
    holds below the first of `levels` others, which begin at rising degrees;
    above the last one it is constant.
    """
    end = target
    above = 0
    top = memory[u(level + LEVEL_SIZE * levels)]
    for place in range(count):
        degree = points[u(point + 1)]
        while above < levels and memory[u(level + LEVEL_SIZE * (above + 1))] <= degree:
            begin = memory[u(level + LEVEL_SIZE * (above + 1))]
            above += 1
            if place > 0 and begin < degree and begin > points[u(point - POINT_SIZE + 1)]:
                line = level + LEVEL_SIZE * above
                value = memory[u(line + 1)] + memory[u(line + 2)] * begin
                end = put(memory, end, crossing(points, point - POINT_SIZE, begin), value)
        while above > 0 and memory[u(level + LEVEL_SIZE * above)] > degree:
            line = level + LEVEL_SIZE * above
            begin = memory[u(line)]
            if begin < points[u(point - POINT_SIZE + 1)]:
                value = memory[u(line + 1)] + memory[u(line + 2)] * begin
                end = put(memory, end, crossing(points, point - POINT_SIZE, begin), value)
            above -= 1
        if degree <= top or place == 0 or place == count - 1:
            line = level + LEVEL_SIZE * above
            value = memory[u(line + 1)] + memory[u(line + 2)] * degree
            end = put(memory, end, points[u(point)], value)
        point += POINT_SIZE
    return end


@flat
def cut_off(
    points: Floats, point: int, count: int, memory: Floats, cut: float, factor: float, target: int
) -> int:
    """Write a term that is cut off at a degree, times a factor, as `activate` does by one level."""
    end = target
    last = point + POINT_SIZE * (count - 1)
    first, before, top = point, cut, factor * cut
    while point <= last:
        degree = points[u(point + 1)]
        if point > first and minimum(before, degree) < cut < maximum(before, degree):
            end = put(memory, end, crossing(points, point - POINT_SIZE, cut), top)
        if degree <= cut:
            end = put(memory, end, points[u(point)], factor * degree)
        elif point in (first, last):
            end = put(memory, end, points[u(point)], top)
        before = degree
        point += POINT_SIZE
    return end


@inlined
def value_before(memory: Floats, first: int, vertex: int, end: int, x: float) -> float:
    """Return the limit from the left, at `x`, of a polyline whose next vertex is at `vertex`."""
    if vertex == end:
        return 0.0
    right: float = memory[u(vertex)]
    degree: float = memory[u(vertex + 1)]
    if right == x:
        return degree
    if vertex == first:
        return 0.0
    left: float = memory[u(vertex - VERTEX_SIZE)]
    before: float = memory[u(vertex - VERTEX_SIZE + 1)]
    return before + (degree - before) * ((x - left) / (right - left))


@flat
def join(
    memory: Floats,
    first: int,
    first_end: int,
    second: int,
    second_end: int,
    target: int,
    room: int,
    adding: int,
) -> int:
    """Write the larger of two polylines, or with `adding` their sum, to `memory[target]`; return its end.

    Each must begin at the lower limit of the range or with degree 0, and end
    so. Where two lines cross there is a vertex more. Nothing is written at
    `room` or beyond.
    """
    a, b, end = first, second, target
    x, value_a, value_b = 0.0, 0.0, 0.0
    while (a < first_end or b < second_end) and end + 4 * VERTEX_SIZE <= room:
        x_a = memory[u(a)] if a < first_end else inf
        x_b = memory[u(b)] if b < second_end else inf
        here = minimum(x_a, x_b)
        left_a = value_before(memory, first, a, first_end, here)
        left_b = value_before(memory, second, b, second_end, here)
        before, after = value_a - value_b, left_a - left_b
        if adding == 0 and ((before < 0.0 and after > 0.0) or (before > 0.0 and after < 0.0)):
            part = before / (before - after)
            end = put(memory, end, x + (here - x) * part, value_a + (left_a - value_a) * part)
        x, value_a, value_b = here, left_a, left_b
        peak_a, peak_b = left_a, left_b
        while a < first_end and memory[u(a)] == here:
            value_a = memory[u(a + 1)]
            peak_a = maximum(peak_a, value_a)
            a += VERTEX_SIZE
        while b < second_end and memory[u(b)] == here:
            value_b = memory[u(b + 1)]
            peak_b = maximum(peak_b, value_b)
            b += VERTEX_SIZE
        if adding == 0 and ((x_a != here and left_a > peak_b) or (x_b != here and left_b > peak_a)):
            continue  # a vertex below the other's line
        left = left_a + left_b if adding else maximum(left_a, left_b)
        peak = peak_a + peak_b if adding else maximum(peak_a, peak_b)
        right = value_a + value_b if adding else maximum(value_a, value_b)
        end = put(memory, end, here, left)
        spike = peak > left and peak > right
        if spike:
            end = put(memory, end, here, peak)
        if spike or right != left:
            end = put(memory, end, here, right)
    return end


@flat
def bound(memory: Floats, first: int, end: int, target: int) -> int:
    """Write the smaller of a polyline and 1 to `memory[target]` (BSUM); return its end."""
    result = target
    for vertex in range(first, end, VERTEX_SIZE):
        x = memory[u(vertex)]
        degree = memory[u(vertex + 1)]
        if vertex > first:
            left = memory[u(vertex - VERTEX_SIZE)]
            before = memory[u(vertex - VERTEX_SIZE + 1)]
            if (before < 1.0 and degree > 1.0) or (before > 1.0 and degree < 1.0):
                part = (1.0 - before) / (degree - before)
                result = put(memory, result, left + (x - left) * part, 1.0)
        result = put(memory, result, x, minimum(1.0, degree))
    return result


@flat
def highest(memory: Floats, first: int, end: int) -> float:
    """Return the largest degree of a polyline."""
    top = 0.0
    for vertex in range(first, end, VERTEX_SIZE):
        top = maximum(top, memory[u(vertex + 1)])
    return top
