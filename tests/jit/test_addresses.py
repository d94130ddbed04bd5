"""A buffer by its address is the array that it is taken from."""

import numpy as np
import pytest

from fcl_sim.jit import (
    address,
    bytes_at,
    doubles_at,
    entry,
    f8,
    i8,
    integers_at,
    part_at,
    signature,
    singles_at,
    u,
    void,
)

MAKERS = {np.int64: integers_at, np.float64: doubles_at, np.float32: singles_at, np.uint8: bytes_at}


@entry(signature(void, i8, i8, i8, i8))
def doubled(integers, doubles, singles, octets):
    for place in range(1, 3):
        integers_at(integers)[u(place)] *= 2
        doubles_at(doubles)[u(place)] *= 2
        singles_at(singles)[u(place)] *= 2
        bytes_at(octets)[u(place)] *= 2


@entry(signature(f8, i8))
def second(place):
    return doubles_at(place)[u(1)]


@entry(signature(f8, i8, i8))
def total(place, size):
    return part_at(place, size).sum()


def test_what_a_kernel_writes_by_an_address_is_in_the_array():
    arrays = [np.arange(3, 7).astype(kind) for kind in MAKERS]
    doubled(*map(address, arrays))
    assert [array.tolist() for array in arrays] == [[3, 8, 10, 6]] * 4


def test_a_row_of_an_array_has_an_address_of_its_own():
    rows = np.arange(6.0).reshape(2, 3)
    assert [second(address(row)) for row in rows] == [1.0, 4.0]


def test_a_part_has_a_size():
    numbers = np.arange(6.0)
    assert [total(address(numbers), size) for size in (0, 3, 6)] == [0.0, 3.0, 15.0]


def test_numbers_that_do_not_follow_one_another_have_no_address():
    with pytest.raises(ValueError, match="contiguous"):
        address(np.arange(6.0)[::2])
