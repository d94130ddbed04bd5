"""Defuzzification (Tables 1 and 2)."""

from numpy import float64
from numpy.typing import NDArray

from fcl_sim.jit import inlined, u


@inlined
def moments_of_singletons(
    places: NDArray[float64], place: int, degrees: NDArray[float64], degree: int, count: int
) -> tuple[float, float]:
    """Return the two sums of CoGS (Table 2): of place times degree, and of the degrees.

    The places are `places[place : place + count]`, the degrees likewise;
    `count` is even, which shortens the chain of sums.
    """
    moment = 0.0
    total = 0.0
    for index in range(0, count, 2):
        first = degrees[u(degree + index)]
        second = degrees[u(degree + index + 1)]
        moment += places[u(place + index)] * first + places[u(place + index + 1)] * second
        total += first + second
    return moment, total
