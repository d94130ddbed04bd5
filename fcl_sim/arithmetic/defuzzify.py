"""Defuzzification (Tables 1 and 2)."""

from numpy import float64
from numpy.typing import NDArray

from fcl_sim.arithmetic.functions import sqrt
from fcl_sim.arithmetic.operators import maximum, minimum
from fcl_sim.arithmetic.polyline import VERTEX_SIZE
from fcl_sim.jit import flat, inlined, u

Floats = NDArray[float64]


@inlined
def moments_of_singletons(
    places: Floats, place: int, degrees: Floats, degree: int, count: int
) -> tuple[float, float]:
    """Return the two sums of CoGS (Table 2): of place times degree, and of the degrees.

    The places are `places[place : place + count]`, the degrees likewise.
    """
    moment = 0.0
    total = 0.0
    for term in range(count):
        moment += places[u(place + term)] * degrees[u(degree + term)]
        total += degrees[u(degree + term)]
    return moment, total


@flat
def centre_of_gravity(memory: Floats, first: int, end: int, low: float, scale: float) -> tuple[float, float]:
    """Return twice the area of a polyline times `scale`, and CoG (Table 2) as its distance from `low`.

    Lengths are multiplied by `scale`, so that products of them neither
    overflow nor vanish. Every summand is positive: nothing cancels. The
    distance is 0 where there is no area.
    """
    area = 0.0
    moment = 0.0
    x = memory[u(first)]
    degree = memory[u(first + 1)]
    arm = (x - low) * scale
    for vertex in range(first + VERTEX_SIZE, end, VERTEX_SIZE):
        following = memory[u(vertex)]
        next_degree = memory[u(vertex + 1)]
        next_arm = (following - low) * scale
        width = (following - x) * scale
        both = degree + next_degree
        area += width * both
        moment += width * (arm * (both + degree) + next_arm * (both + next_degree))
        x, degree, arm = following, next_degree, next_arm
    return area, moment / (3.0 * area) / scale if area > 0.0 else 0.0


@flat
def centre_of_area(memory: Floats, first: int, end: int, scale: float, top: float, tie: float) -> float:
    """Return CoA (Table 2): half the area lies on each side; the middle of a gap there (S33a).

    `top` is the largest degree; degrees count relative to it. Areas whose ratio
    lies between `tie` and 1 are equal: they were rounded.
    """
    whole = 0.0
    for vertex in range(first + VERTEX_SIZE, end, VERTEX_SIZE):
        width = (memory[u(vertex)] - memory[u(vertex - 2)]) * scale
        whole += width * (memory[u(vertex - 1)] / top + memory[u(vertex + 1)] / top)
    half = 0.5 * whole
    before = 0.0  # twice the area, as whole is
    gap: float = memory[u(first)]
    solution = gap
    held = False
    for vertex in range(first + VERTEX_SIZE, end, VERTEX_SIZE):
        x = memory[u(vertex - 2)]
        following = memory[u(vertex)]
        degree = memory[u(vertex - 1)] / top
        next_degree = memory[u(vertex + 1)] / top
        width = (following - x) * scale
        own = width * (degree + next_degree)
        if own > 0.0:
            if before >= tie * half and (x > gap or degree == 0.0):
                middle: float = 0.5 * gap + 0.5 * x
                return middle
            if held:
                break
            if before + own > half:
                rest = maximum(0.0, half - before)
                root = sqrt(maximum(0.0, degree * degree + (next_degree - degree) / width * rest))
                solution = minimum(following, x + rest / (degree + root) / scale)
                if tie * (before + own) > half:
                    break
                held = True  # a gap may begin where this piece ends
            gap = following
        before += own
    return solution


@flat
def extreme_maximum(memory: Floats, first: int, end: int, top: float, tie: float, direction: int) -> float:
    """Return the vertex farthest left (`direction` 1) or right (-1) that reaches `top`: LM, RM (S34).

    Degrees whose ratio lies between `tie` and 1 are equal: they were rounded.
    """
    vertex = first if direction > 0 else end - VERTEX_SIZE
    while memory[u(vertex + 1)] < tie * top:
        vertex += direction * VERTEX_SIZE
    x: float = memory[u(vertex)]
    return x
