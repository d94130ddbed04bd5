"""Fuzzification on a merged grid of knots (5.2.2)."""

from numpy import float64
from numpy.typing import NDArray

from fcl_sim.arithmetic.operators import minimum
from fcl_sim.jit import inlined, two_ramps, u

FEW = 8
"""So many knots are halved three times; of more, a quarter is left by each three comparisons."""


@inlined
def passed(x: float, floats: NDArray[float64], at: int) -> int:
    """Return how many of the four knots at `at` lie below `x`, plus how many lie below or at it."""
    below = int(floats[u(at)] < x) + int(floats[u(at + 1)] < x)
    below += int(floats[u(at + 2)] < x) + int(floats[u(at + 3)] < x)
    reached = int(floats[u(at)] <= x) + int(floats[u(at + 1)] <= x)
    reached += int(floats[u(at + 2)] <= x) + int(floats[u(at + 3)] <= x)
    return below + reached


@inlined
def cell_of(x: float, floats: NDArray[float64], knots: int, count: int) -> int:
    """Return the cell of `x` on the rising knots at `floats[knots]`.

    Cell 2 k is the open interval before knot k, cell 2 k + 1 is knot k itself,
    so that a vertical edge is a value in its knot's cell (S21). `count` is 8 or
    a power of 4, and above the number of knots; NaN fills the knots up.
    """
    if count == FEW:
        low = int(floats[u(knots + 3)] < x) << 2
        low += int(floats[u(knots + low + 1)] < x) << 1
        low += int(floats[u(knots + low)] < x)
        return 2 * low + int(floats[u(knots + low)] <= x)
    below = knots
    step = count >> 2
    while step > 0:
        quarters = int(floats[u(below + step - 1)] < x) + int(floats[u(below + 2 * step - 1)] < x)
        below += step * (quarters + int(floats[u(below + 3 * step - 1)] < x))
        step >>= 2
    return 2 * (below - knots) + int(floats[u(below)] <= x)


@inlined
def cell_of_many(x: float, floats: NDArray[float64], knots: int, count: int) -> int:
    """Return `cell_of` by comparing with each of few knots: for many x at a time, in vector instructions."""
    if count == FEW:
        return passed(x, floats, knots) + passed(x, floats, knots + 4)
    return cell_of(x, floats, knots, count)


PAIR_SIZE = 6
"""Numbers of a pair of segments: two origins, two values, two runs."""


@inlined
def degree_on(x: float, floats: NDArray[float64], pairs: int, number: int) -> float:
    """Return the degree of `x` on one of the segments whose pairs begin at `floats[pairs]`.

    The origin is the end where the degree is lower: near zero the error is
    relative to the degree itself. The run is the signed distance over which
    the degree would rise by 1, infinite where it is constant: a quotient is
    as near to the true degree as a float can be, a product with a slope is not.
    """
    segment = pairs + PAIR_SIZE * (number >> 1) + (number & 1)
    rise = (x - floats[u(segment)]) / floats[u(segment + 4)]
    return minimum(1.0, floats[u(segment + 2)] + rise)


@inlined
def degrees_on_pair(x: float, floats: NDArray[float64], pair: int) -> tuple[float, float]:
    """Return the degrees of `x` on the pair of segments at `floats[pair]`, as `degree_on` does."""
    return two_ramps(x, floats, u(pair))
