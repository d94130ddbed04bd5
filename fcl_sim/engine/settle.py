"""Outputs that are not CoGS of constant singletons: degrees given out, other singletons, areas."""

from math import inf

from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.arithmetic.operators import maximum, minimum
from fcl_sim.engine.areas import settle_area
from fcl_sim.engine.curved import Curved
from fcl_sim.engine.formulas import place_formulas
from fcl_sim.engine.moving import abscissa
from fcl_sim.engine.program import (
    BY_AREA,
    BY_DEGREE,
    FLOATS,
    METHOD_COG,
    METHOD_LM,
    METHOD_RM,
    METHOD_SUM,
    OUT_DEGREES,
    OUT_KIND,
    OUT_LIMITS,
    OUT_METHOD,
    OUT_MORE,
    OUT_TERMS,
    TIE,
)
from fcl_sim.jit import flat, u

Ints = NDArray[int64]
Floats = NDArray[float64]


@flat
def settle(
    ints: Ints, floats: Floats, at: int, output: int, memory: Floats, base: int, curved: Curved
) -> tuple[float, float]:
    """Return the value of an output, and a number that is 0 where no rule is active for it.

    `curved` is None where no area is under a norm of the Open Level.
    """
    value, weight = result(ints, floats, at, output, memory, base, curved)
    limits = ints[u(output + OUT_LIMITS)]
    if limits != 0:
        ends = ints[u(at + FLOATS)] + limits
        value = minimum(floats[u(ends + 1)], maximum(floats[u(ends)], value))
    return value, weight


@flat
def result(
    ints: Ints, floats: Floats, at: int, output: int, memory: Floats, base: int, curved: Curved
) -> tuple[float, float]:
    """Return the value of an output before its limits, and the number of `settle`."""
    kind = ints[u(output + OUT_KIND)]
    degrees = base + ints[u(output + OUT_DEGREES)]
    method = ints[u(output + OUT_METHOD)]
    more = at + ints[u(output + OUT_MORE)]
    if kind == BY_DEGREE:
        return memory[u(degrees)], memory[u(degrees)]
    if kind == BY_AREA:
        return settle_area(ints, floats, at, more, method, memory, base, curved)
    terms = ints[u(output + OUT_TERMS)]
    origin = ints[u(at + FLOATS)]
    total = top = 0.0
    for term in range(terms):
        total += memory[u(degrees + term)]
        top = maximum(top, memory[u(degrees + term)])
    if total == 0.0:
        return 0.0, 0.0
    place_formulas(ints, floats, origin, more + terms, memory, base)
    centre, added, left, right = 0.0, 0.0, inf, -inf
    for term in range(terms):
        degree = memory[u(degrees + term)]
        if degree == 0.0:  # what does not count may be no number
            continue
        place = abscissa(ints[u(more + term)], floats, origin, memory, base)
        centre += place * (degree / total)
        added += place * degree
        if degree >= floats[u(origin + TIE)] * top:
            left, right = minimum(left, place), maximum(right, place)
    if method == METHOD_COG:
        return centre, total
    if method == METHOD_SUM:
        return added, total
    both = 0.5 * left + 0.5 * right
    return left if method == METHOD_LM else right if method == METHOD_RM else both, total
