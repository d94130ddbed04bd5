"""Polylines against what they mean, point by point."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.arithmetic.defuzzify import centre_of_area, centre_of_gravity, extreme_maximum
from fcl_sim.arithmetic.polyline import activate, bound, join
from fcl_sim.jit import F, entry, f8, i8, signature

TIE = 1.0 - 2.0**-44
ROOM = 400
"""Words for each polyline of a test."""


@entry(signature(i8, F, i8, i8, F, i8, i8, i8))
def activated(points, point, count, memory, level, levels, target):  # noqa: PLR0917  as the kernel
    return activate(points, point, count, memory, level, levels, target)


@entry(signature(i8, F, i8, i8, i8, i8, i8, i8, i8))
def joined(memory, first, first_end, second, second_end, target, room, adding):  # noqa: PLR0917
    return join(memory, first, first_end, second, second_end, target, room, adding)


@entry(signature(i8, F, i8, i8, i8))
def bounded(memory, first, end, target):
    return bound(memory, first, end, target)


@entry(signature(f8, F, i8, i8, f8, f8))
def gravity(memory, first, end, low, scale):
    return centre_of_gravity(memory, first, end, low, scale)[1]


@entry(signature(f8, F, i8, i8, f8, f8))
def bisector(memory, first, end, scale, top):
    return centre_of_area(memory, first, end, scale, top, TIE)


@entry(signature(f8, F, i8, i8, f8, i8))
def extreme(memory, first, end, top, direction):
    return extreme_maximum(memory, first, end, top, TIE, direction)


def value_at(vertices, x):
    """Return the limits of a polyline at `x` from the left and from the right, and the degree at x itself."""
    here = [degree for at, degree in vertices if at == x]
    if not vertices or x < vertices[0][0] or x > vertices[-1][0]:
        return 0, 0, 0
    if here:
        left = here[0] if x > vertices[0][0] else 0
        right = here[-1] if x < vertices[-1][0] else 0
        return left, right, max(here)
    (a, low), (b, high) = next((p, q) for p, q in pairwise(vertices) if p[0] < x < q[0])
    value = Fraction(low) + (Fraction(high) - Fraction(low)) * (Fraction(x) - Fraction(a)) / (
        Fraction(b) - Fraction(a)
    )
    return value, value, value


@st.composite
def polylines(draw):
    """Return vertices on a coarse grid within 0 .. 8, many of them sharing an abscissa; 0 at both ends."""
    xs = sorted(draw(st.lists(st.integers(0, 16), min_size=1, max_size=6)))
    degrees = [draw(st.integers(0, 8)) / 8 for _ in xs]
    middle = [(x / 2, degree) for x, degree in zip(xs, degrees, strict=True)]
    return [(middle[0][0], 0.0), *middle, (middle[-1][0], 0.0)]


def written(memory, at, vertices):
    flat = [number for vertex in vertices for number in vertex]
    memory[at : at + len(flat)] = flat
    return at + len(flat)


def read(memory, first, end):
    return [tuple(vertex) for vertex in memory[first:end].reshape(-1, 2).tolist()]


PLACES = [n / 8 for n in range(-2, 70)]


def near(ours, theirs):
    return all(abs(float(a) - float(b)) <= 1e-14 for a, b in zip(ours, theirs, strict=True))


@given(polylines(), polylines(), st.booleans())
def test_two_joined_are_at_every_place_the_larger_or_the_sum(one, other, adding):
    memory = np.zeros(3 * ROOM)
    ends = written(memory, 0, one), written(memory, ROOM, other)
    end = joined(memory, 0, ends[0], ROOM, ends[1], 2 * ROOM, 3 * ROOM, int(adding))
    result = read(memory, 2 * ROOM, end)
    assert all(a[0] <= b[0] for a, b in pairwise(result))
    for x in PLACES:
        pairs = zip(value_at(one, x), value_at(other, x), strict=True)
        expected = [a + b if adding else max(a, b) for a, b in pairs]
        assert near(value_at(result, x), expected)


def test_what_does_not_fit_is_not_written():
    memory = np.full(100, -1.0)
    zigzag = [(float(n), float(n % 2)) for n in range(9)]
    ends = written(memory, 0, zigzag), written(memory, 20, [(x + 0.5, y) for x, y in zigzag])
    end = joined(memory, 0, ends[0], 20, ends[1], 40, 60, 0)
    assert end <= 60
    assert (memory[60:] == -1.0).all()


@given(polylines(), st.lists(st.tuples(st.integers(1, 8), st.integers(1, 4)), min_size=1, max_size=4))
def test_an_activated_term_is_the_sum_of_what_its_levels_cut_off(vertices, pairs):
    levels = sorted((cut / 8, factor / 4) for cut, factor in pairs)
    memory = np.zeros(3 * ROOM)
    table = [(0.0, 0.0, sum(factor for _, factor in levels))]
    for n, (cut, _) in enumerate(levels):
        value = sum(c * f for c, f in levels[: n + 1])
        table.append((cut, value, sum(f for _, f in levels[n + 1 :])))
    memory[: 3 * len(table)] = np.ravel(table)
    rows = []
    for (x, degree), (following, next_degree) in zip(vertices, [*vertices[1:], vertices[-1]], strict=True):
        rows.append((x, degree, (following - x) / (next_degree - degree) if next_degree != degree else 0.0))
    end = activated(np.ravel(rows), 0, len(rows), memory, 0, len(levels), ROOM)
    result = read(memory, ROOM, end)
    assert len(result) <= len(vertices) * (1 + len(levels))
    for x in PLACES:
        expected = [sum(f * min(c, float(mu)) for c, f in levels) for mu in value_at(vertices, x)]
        assert near(value_at(result, x), expected)


@given(polylines(), st.integers(1, 3))
def test_a_bounded_one_is_nowhere_above_1(vertices, factor):
    tall = [(x, factor * degree) for x, degree in vertices]
    memory = np.zeros(2 * ROOM)
    end = bounded(memory, 0, written(memory, 0, tall), ROOM)
    for x in PLACES:
        assert near(value_at(read(memory, ROOM, end), x), [min(1.0, each) for each in value_at(tall, x)])


@given(polylines(), st.integers(-40, 40))
def test_all_methods_move_with_the_area_and_mirror_with_it(vertices, shift):
    content = sum((b - a) * (low + high) for (a, low), (b, high) in pairwise(vertices))
    top = max(degree for _, degree in vertices)
    if content == 0.0:
        return
    memory = np.zeros(3 * ROOM)
    scale = 1 / 8
    ends = (
        written(memory, 0, vertices),
        written(memory, ROOM, [(x + shift, degree) for x, degree in vertices]),
        written(memory, 2 * ROOM, [(-x, degree) for x, degree in reversed(vertices)]),
    )
    methods = {
        "CoG": lambda first, end, low: low + gravity(memory, first, end, low, scale),
        "CoA": lambda first, end, low: bisector(memory, first, end, scale, top),
    }
    for method in methods.values():
        here = method(0, ends[0], 0.0)
        assert abs(method(ROOM, ends[1], float(shift)) - shift - here) <= 1e-13
        assert abs(method(2 * ROOM, ends[2], -8.0) + here) <= 1e-13
    assert extreme(memory, 0, ends[0], top, 1) == -extreme(memory, 2 * ROOM, ends[2], top, -1)
