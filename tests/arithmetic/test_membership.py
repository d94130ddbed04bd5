from math import inf, nan

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.arithmetic.membership import cell_of, cell_of_many, degree_on
from fcl_sim.jit import F, entry, f8, i8, signature

BEFORE = 3
"""Floats before the knots, to be left alone."""


@entry(signature(i8, f8, F, i8, i8))
def cell(x, floats, knots, count):
    return cell_of(x, floats, knots, count)


@entry(signature(i8, f8, F, i8, i8))
def cell_for_many(x, floats, knots, count):
    return cell_of_many(x, floats, knots, count)


@entry(signature(f8, f8, F, i8))
def degree(x, floats, segment):
    return degree_on(x, floats, segment)


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
    falling = np.array([22.0, 0.0, -12.0])
    assert degree(22.0 - 2.0**-40, falling, 0) == 2.0**-40 / 12


def test_a_degree_never_exceeds_1():
    steep = np.array([0.0, 0.0, 1.0 - 2.0**-40])
    assert degree(1.0, steep, 0) == 1.0
