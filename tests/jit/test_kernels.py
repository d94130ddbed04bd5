"""Kernels are compiled once for each type that they are called with."""

from fcl_sim.jit import entry, f8, kernel, signature


@kernel
def times(number, factor):
    return factor * number


@entry(signature(f8, f8))
def fourteen_fold(number):
    return times(number, 2) + times(number, 3) + times(number, 9)


def test_a_constant_that_is_passed_is_no_reason_to_compile_a_kernel_anew():
    assert fourteen_fold(0.5) == 7.0
    assert len(getattr(times, "overloads", [None])) == 1
