"""Several numbers in one instruction are, bit for bit, what they are one by one."""

import numpy as np
import pytest

from fcl_sim.jit import (
    F4,
    Entry,
    F,
    clear_eight,
    combine_four,
    copy_four,
    copy_two,
    entry,
    f8,
    i8,
    put_four,
    scratch,
    shift_four,
    signature,
    stretch,
    u,
    void,
)

BEHIND = 3
"""A place that is no multiple of the lanes."""


@entry(signature(void, F, f8, f8))
def put(memory, a, b):
    put_four(memory, u(BEHIND), a, b, b, a)


@entry(signature(f8, F))
def summed_aside(memory):
    own = scratch(4)
    total = own[u(0)]
    for i in range(4):
        own[u(i)] += memory[u(i)]
    for i in range(4):
        total += own[u(3 - i)]
    return total


@entry(signature(void, F))
def cleared(memory):
    clear_eight(memory, u(BEHIND))


@entry(signature(void, F, F))
def copied(target, source):
    copy_four(target, u(BEHIND), source, u(1))


@entry(signature(void, F, F))
def two_copied(target, source):
    copy_two(target, u(BEHIND), source, u(1))


@entry(signature(void, F, F, f8, F))
def shifted(target, origin, weight, way):
    shift_four(target, u(BEHIND), origin, u(1), weight, way, u(2))


@entry(signature(void, F, F, F, i8))
def combined(target, weights, rows, count):
    combine_four(target, u(BEHIND), weights, u(2), rows, u(1), u(5), u(count))


@entry(signature(void, F, i8, i8, f8), flat=True)
def filled(buffer, at, size, value):
    part = stretch(buffer, u(at), u(size))
    for place in range(part.size):
        part[u(place)] = value


@pytest.fixture
def random():
    return np.random.default_rng(7)


def buffer(random, dtype=np.float64):
    """Return numbers of all sizes, which sum differently in another order."""
    return (random.uniform(-1, 1, 64) * 10.0 ** random.integers(-12, 12, 64)).astype(dtype)


def test_eight_numbers_are_cleared_and_their_neighbours_are_not(random):
    memory = buffer(random)
    expected = memory.copy()
    expected[BEHIND : BEHIND + 8] = 0.0
    cleared(memory)
    assert memory.tobytes() == expected.tobytes()


@pytest.mark.parametrize(("copy", "count"), [(copied, 4), (two_copied, 2)])
def test_numbers_are_copied_and_their_neighbours_are_not(random, copy, count):
    target, source = buffer(random), buffer(random)
    expected = target.copy()
    expected[BEHIND : BEHIND + count] = source[1 : 1 + count]
    copy(target, source)
    assert target.tobytes() == expected.tobytes()


def test_a_shift_rounds_the_product_and_then_the_sum(random):
    for _ in range(50):
        target, origin, way, weight = buffer(random), buffer(random), buffer(random), random.uniform(-2, 2)
        expected = target.copy()
        expected[BEHIND : BEHIND + 4] = [origin[1 + i] + float(weight * way[2 + i]) for i in range(4)]
        shifted(target, origin, weight, way)
        assert target.tobytes() == expected.tobytes()


@pytest.mark.parametrize("count", range(8))
def test_a_combination_is_summed_in_the_order_of_the_rows(random, count):
    target, weights, rows = buffer(random), buffer(random), buffer(random)
    expected = target.copy()
    for lane in range(4):
        total = 0.0
        for row in range(count):
            total += weights[2 + row] * rows[1 + 5 * row + lane]
        expected[BEHIND + lane] = total
    combined(target, weights, rows, count)
    assert target.tobytes() == expected.tobytes()


def test_a_combination_may_go_into_the_buffer_of_its_rows(random):
    rows, weights = buffer(random), buffer(random)
    apart = rows.copy()
    combined(rows, weights, rows, 6)
    expected = np.zeros(64)
    combined(expected, weights, apart, 6)
    assert rows[BEHIND : BEHIND + 4].tobytes() == expected[BEHIND : BEHIND + 4].tobytes()


def test_binary32_numbers_are_taken_likewise(random):
    memory = buffer(random, np.float32)
    expected = memory.copy()
    expected[BEHIND : BEHIND + 8] = 0.0
    Entry(cleared.function, signature(void, F4))(memory)
    assert memory.tobytes() == expected.tobytes()


def test_what_is_written_into_a_stretch_stands_in_the_buffer(random):
    memory = buffer(random)
    expected = memory.copy()
    expected[BEHIND : BEHIND + 5] = 2.5
    filled(memory, BEHIND, 5, 2.5)
    assert memory.tobytes() == expected.tobytes()


def test_four_numbers_are_put_at_once_and_nothing_else_is_touched():
    memory = np.arange(12.0)
    put(memory, 0.5, -7.0)
    assert memory.tolist() == [0.0, 1.0, 2.0, 0.5, -7.0, -7.0, 0.5, 7.0, 8.0, 9.0, 10.0, 11.0]


def test_numbers_of_a_kernels_own_are_0_at_each_call_and_touch_nobody_elses():
    memory = np.array([1.0, 2.0, 4.0, 8.0])
    assert [summed_aside(memory), summed_aside(memory)] == [15.0, 15.0]
    assert memory.tolist() == [1.0, 2.0, 4.0, 8.0]
