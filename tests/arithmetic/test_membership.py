from math import inf, nan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.arithmetic.membership import PAIR_SIZE, cell_of, cell_of_many, degree_on, degrees_on_pair
from fcl_sim.jit import F4, Entry, F, entry, f8, i8, signature, u, void

BEFORE = 3
"""Floats before the knots, to be left alone."""


@entry(signature(i8, f8, F, i8, i8))
def cell(x, floats, knots, count):
    return cell_of(x, floats, knots, count)


@entry(signature(i8, f8, F, i8, i8))
def cell_for_many(x, floats, knots, count):
    return cell_of_many(x, floats, knots, count)


@entry(signature(f8, f8, F, i8, i8))
def degree(x, floats, pairs, number):
    return degree_on(x, floats, pairs, number)


@entry(signature(void, F, F, i8, F))
def pair_of_degrees(xs, floats, pair, found):
    for i in range(xs.size):
        found[u(2 * i)], found[u(2 * i + 1)] = degrees_on_pair(xs[u(i)], floats, pair)


pair_of_singles = Entry(pair_of_degrees.function, signature(void, F4, F4, i8, F4))


def located(x, knots):
    """Return the cell of `x` as both ways find it, with the knots filled up as they want them."""
    count = next(size for size in (8, 16, 64, 256) if len(knots) < size)
    floats = np.full(BEFORE + count, nan)
    floats[:BEFORE] = -inf
    floats[BEFORE : BEFORE + len(knots)] = knots
    found = cell(float(x), floats, BEFORE, count)
    assert cell_for_many(float(x), floats, BEFORE, count) == found
    return found


KNOTS = st.lists(st.integers(-300, 300), min_size=1, max_size=150, unique=True).map(sorted)


@given(KNOTS, st.integers(-310, 310), st.sampled_from((0.0, 0.5)))
def test_a_cell_counts_the_knots_below_and_the_knots_reached(knots, whole, half):
    x = whole + half
    assert located(x, knots) == sum(knot < x for knot in knots) + sum(knot <= x for knot in knots)


@given(KNOTS)
def test_nothing_lies_outside_the_cells(knots):
    assert located(-inf, knots) == 0
    assert located(inf, knots) == 2 * len(knots)
    assert located(nan, knots) == 0


def test_knots_one_bit_apart_are_told_apart():
    knots = [1.0, np.nextafter(1.0, 2.0)]
    assert [located(x, knots) for x in (np.nextafter(1.0, 0.0), *knots, np.nextafter(knots[1], 2.0))] == [
        0,
        1,
        3,
        4,
    ]


def test_a_degree_near_0_is_exact_to_its_own_digits():
    falling = np.array([22.0, 0.0, 0.0, 0.0, -12.0, inf])
    assert degree(22.0 - 2.0**-40, falling, 0, 0) == 2.0**-40 / 12


def test_a_degree_never_exceeds_1():
    steep = np.array([0.0, 0.0, 0.0, 0.0, inf, 1.0 - 2.0**-40])
    assert degree(1.0, steep, 0, 1) == 1.0


@pytest.mark.parametrize(("dtype", "both"), [(np.float64, pair_of_degrees), (np.float32, pair_of_singles)])
def test_two_degrees_at_once_are_those_of_one_after_the_other(dtype, both):
    random = np.random.default_rng(1)
    xs = np.array([*random.uniform(-3, 3, 200), 0.0, -0.0, 1e300, -1e300, nan]).astype(np.float64)
    xs = np.clip(xs, np.finfo(dtype).min, np.finfo(dtype).max).astype(dtype)
    segments = random.uniform(-2, 2, BEFORE + 2 * PAIR_SIZE).astype(dtype)
    segments[-1] = inf
    found = np.empty(2 * xs.size, dtype)
    both(xs, segments, BEFORE + PAIR_SIZE, found)
    with np.errstate(over="ignore", invalid="ignore"):
        expected = [degree_on(x, segments, BEFORE, number) for x in xs for number in (2, 3)]
    assert found.tobytes() == np.array(expected, dtype).tobytes()
