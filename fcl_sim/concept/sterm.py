"""FUZ_STERM: one term, of two to four points (pp. 67 to 74)."""

from dataclasses import replace
from math import isfinite
from typing import Any

from numpy.typing import NDArray

from fcl_sim.arithmetic.integer import FULL, scaled
from fcl_sim.arithmetic.operators import maximum
from fcl_sim.concept.declaration import BlockType, Ints, Reals
from fcl_sim.concept.events import NOTHING, OVERFLOWN, TOO_MANY
from fcl_sim.jit import flat, inlined, u

MOST = 4


@inlined
def height(words: NDArray[Any], count: int, one: Any) -> tuple[Any, Any]:
    """Return the degree of X as a part and a whole, the whole positive.

    All shapes of pp. 71 to 74 are one: up from `foot` to `top`, down from
    `brink` to `end`, and a side whose points are the other way round is not
    there. Two points are S1, S2, S2, S1, three are S1, S2, S2, S3.
    """
    x = words[u(0)]
    foot = words[u(1)]
    top = words[u(2)]
    brink = maximum(top, words[u(3)]) if count == MOST else top
    end = foot if count == 2 else words[u(count)]
    part = whole = one
    if foot <= top and x < top:
        part = x - foot
        whole = top - foot
    elif brink <= end and x > brink:
        part = end - x
        whole = end - brink
    if part > one - one:
        return part, whole
    return one - one, one


@flat
def sterm_int(inputs: Ints, count: int, outputs: Ints, rounding: int) -> int:
    """Kernel of FUZ_STERM_INT; inputs X, S1 ..; output MD."""
    if count > MOST:
        return TOO_MANY
    part, whole = height(inputs, count, inputs.dtype.type(1))
    outputs[u(0)] = scaled(part, FULL, whole, rounding)
    return NOTHING


@flat
def sterm_real(inputs: Reals, count: int, outputs: Reals) -> int:
    """Kernel of FUZ_STERM_REAL; inputs X, S1 ..; output MD."""
    if count > MOST:
        return TOO_MANY
    part, whole = height(inputs, count, inputs.dtype.type(1))
    if not isfinite(whole):
        return OVERFLOWN
    outputs[u(0)] = part / whole
    return NOTHING


STERM_INT = BlockType(
    name="FUZ_STERM_INT",
    summary="fuzzification of one term",
    equation=(
        "up from S1 to S2, down from max(S2, S3) to S4; no side up where S1 > S2, none down where "
        "S4 < max(S2, S3); 3 points: S1, S2, S2, S3; 2 points: S1, S2, S2, S1; "
        "at a vertical side the larger degree"
    ),
    source="Concept 2.6, FUZZY library, pp. 67-74",
    number="INT",
    leading=("X",),
    stem="S",
    least=2,
    most=MOST,
    outputs=("MD",),
    kernel=sterm_int,
)

STERM_REAL = replace(STERM_INT, name="FUZ_STERM_REAL", number="REAL", kernel=sterm_real)
