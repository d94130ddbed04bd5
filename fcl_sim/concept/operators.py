"""FUZ_MIN, FUZ_MAX, FUZ_PROD, FUZ_SUM: degrees joined (pp. 59 to 66, 75 to 77)."""

from dataclasses import replace
from math import isfinite
from typing import Any

from numpy.typing import NDArray

from fcl_sim.arithmetic.integer import FULL, fits_dint, fits_int, scaled
from fcl_sim.arithmetic.operators import maximum, minimum
from fcl_sim.concept.declaration import CEILING, BlockType, Ints, Reals
from fcl_sim.concept.events import NOTHING, OVERFLOWN
from fcl_sim.jit import flat, inlined, u


@inlined
def least_of(words: NDArray[Any], count: int, full: Any) -> Any:
    """Return the least of `full` and `count` words."""
    least = full
    for i in range(count):
        least = minimum(least, words[u(i)])
    return least


@inlined
def greatest_of(words: NDArray[Any], count: int, zero: Any) -> Any:
    """Return the greatest of `zero` and `count` words."""
    greatest = zero
    for i in range(count):
        greatest = maximum(greatest, words[u(i)])
    return greatest


@inlined
def bounded_sum_of(words: NDArray[Any], count: int, full: Any) -> Any:
    """Return the sum of `count` words, in their order, at most `full`."""
    total = words[u(0)]
    for i in range(1, count):
        total += words[u(i)]
    return minimum(full, total)


@flat
def min_int(inputs: Ints, count: int, outputs: Ints, rounding: int) -> int:  # noqa: ARG001  all take it
    """Kernel of FUZ_MIN_INT."""
    outputs[u(0)] = least_of(inputs, count, inputs.dtype.type(FULL))
    return NOTHING


@flat
def min_real(inputs: Reals, count: int, outputs: Reals) -> int:
    """Kernel of FUZ_MIN_REAL."""
    outputs[u(0)] = least_of(inputs, count, inputs.dtype.type(1))
    return NOTHING


@flat
def max_int(inputs: Ints, count: int, outputs: Ints, rounding: int) -> int:  # noqa: ARG001
    """Kernel of FUZ_MAX_INT."""
    outputs[u(0)] = greatest_of(inputs, count, inputs.dtype.type(0))
    return NOTHING


@flat
def max_real(inputs: Reals, count: int, outputs: Reals) -> int:
    """Kernel of FUZ_MAX_REAL."""
    outputs[u(0)] = greatest_of(inputs, count, inputs.dtype.type(0))
    return NOTHING


@flat
def prod_int(inputs: Ints, count: int, outputs: Ints, rounding: int) -> int:
    """Kernel of FUZ_PROD_INT: one factor after another, each product divided by 10000."""
    product = inputs[u(0)]
    for i in range(1, count):
        if not fits_dint(product * inputs[u(i)]):
            return OVERFLOWN
        product = scaled(product, inputs[u(i)], FULL, rounding)
    if not fits_int(product):
        return OVERFLOWN
    outputs[u(0)] = product
    return NOTHING


@flat
def prod_real(inputs: Reals, count: int, outputs: Reals) -> int:
    """Kernel of FUZ_PROD_REAL."""
    product = inputs[u(0)]
    for i in range(1, count):
        product *= inputs[u(i)]
    if not isfinite(product):
        return OVERFLOWN
    outputs[u(0)] = product
    return NOTHING


@flat
def sum_int(inputs: Ints, count: int, outputs: Ints, rounding: int) -> int:  # noqa: ARG001
    """Kernel of FUZ_SUM_INT."""
    total = bounded_sum_of(inputs, count, inputs.dtype.type(FULL))
    if not fits_int(total):
        return OVERFLOWN
    outputs[u(0)] = total
    return NOTHING


@flat
def sum_real(inputs: Reals, count: int, outputs: Reals) -> int:
    """Kernel of FUZ_SUM_REAL."""
    total = bounded_sum_of(inputs, count, inputs.dtype.type(1))
    if not isfinite(total):
        return OVERFLOWN
    outputs[u(0)] = total
    return NOTHING


MIN_INT = BlockType(
    name="FUZ_MIN_INT",
    summary="AND: the least degree",
    equation="OUT = min(1, IN1, .., INn)",
    source="Concept 2.6, FUZZY library, pp. 61-62",
    number="INT",
    leading=(),
    stem="IN",
    least=2,
    most=CEILING,
    outputs=("OUT",),
    kernel=min_int,
)
MIN_REAL = replace(MIN_INT, name="FUZ_MIN_REAL", number="REAL", kernel=min_real)

MAX_INT = replace(
    MIN_INT,
    name="FUZ_MAX_INT",
    summary="OR: the greatest degree",
    equation="OUT = max(0, IN1, .., INn)",
    source="Concept 2.6, FUZZY library, pp. 59-60",
    kernel=max_int,
)
MAX_REAL = replace(MAX_INT, name="FUZ_MAX_REAL", number="REAL", kernel=max_real)

PROD_INT = replace(
    MIN_INT,
    name="FUZ_PROD_INT",
    summary="AND, or the weight of a rule: the product of degrees",
    equation="MD = MD1 MD2 .. MDx",
    source="Concept 2.6, FUZZY library, pp. 63-65",
    stem="MD",
    outputs=("MD",),
    kernel=prod_int,
)
PROD_REAL = replace(PROD_INT, name="FUZ_PROD_REAL", number="REAL", kernel=prod_real)

SUM_INT = replace(
    PROD_INT,
    name="FUZ_SUM_INT",
    summary="OR: the bounded sum of degrees",
    equation="MD = min(1, MD1 + .. + MDx)",
    source="Concept 2.6, FUZZY library, pp. 75-77",
    kernel=sum_int,
)
SUM_REAL = replace(SUM_INT, name="FUZ_SUM_REAL", number="REAL", kernel=sum_real)
