"""FUZ_ATERM: all terms of a variable at once (pp. 49 to 58)."""

from dataclasses import replace
from math import isfinite
from typing import Any

from numpy.typing import NDArray

from fcl_sim.arithmetic.integer import FULL, scaled
from fcl_sim.arithmetic.operators import maximum, minimum
from fcl_sim.concept.declaration import STRUCTURE, TERM1, BlockType, Ints, Reals
from fcl_sim.concept.events import NOTHING, OUT_OF_RANGE, OVERFLOWN, TOO_MANY
from fcl_sim.jit import flat, inlined, u

MOST = 9


@inlined
def refused(words: NDArray[Any], count: int) -> int:
    """Return the event of points that are too many or do not rise."""
    if count > MOST:
        return TOO_MANY
    for i in range(1, count):
        if not words[u(i)] < words[u(i + 1)]:
            return OUT_OF_RANGE
    return NOTHING


@inlined
def segment_of(words: NDArray[Any], count: int) -> int:
    """Return which point, from 1, begins the segment that holds X; the first or last for X outside."""
    segment = 1
    while segment < count - 1 and words[u(0)] >= words[u(segment + 1)]:
        segment += 1
    return segment


@inlined
def rise(words: NDArray[Any], segment: int) -> tuple[Any, Any]:
    """Return how far X is past the segment's beginning, at most to its end, and the segment's length."""
    begin = words[u(segment)]
    end = words[u(segment + 1)]
    return maximum(begin, minimum(words[u(0)], end)) - begin, end - begin


@inlined
def spread(words: NDArray[Any], first: int, count: int, segment: int, up: Any, full: Any) -> None:
    """Write degrees from `first` on: `up` to the term where the segment ends, the rest to the one before."""
    for i in range(count):
        words[u(first + i)] = full - full
    words[u(first + segment - 1)] = full - up
    words[u(first + segment)] = up


@inlined
def degrees_int(inputs: Ints, count: int, outputs: Ints, first: int, cleared: int, rounding: int) -> int:
    """Fuzzify into `outputs` from `first` on, where `cleared` words are 0 for want of a term."""
    event = refused(inputs, count)
    if event == NOTHING:
        segment = segment_of(inputs, count)
        part, whole = rise(inputs, segment)
        spread(outputs, first, max(count, cleared), segment, scaled(part, FULL, whole, rounding), FULL)
    return event


@inlined
def degrees_real(inputs: Reals, count: int, outputs: Reals, first: int, cleared: int) -> int:
    """Fuzzify as `degrees_int`, in the precision of the words."""
    event = refused(inputs, count)
    if event == NOTHING:
        segment = segment_of(inputs, count)
        part, whole = rise(inputs, segment)
        if not isfinite(whole):
            return OVERFLOWN
        spread(outputs, first, max(count, cleared), segment, part / whole, inputs.dtype.type(1))
    return event


@flat
def aterm_int(inputs: Ints, count: int, outputs: Ints, rounding: int) -> int:
    """Kernel of FUZ_ATERM_INT; inputs X, S1 ..; outputs MD1 .. MD9."""
    return degrees_int(inputs, count, outputs, 0, MOST, rounding)


@flat
def aterm_real(inputs: Reals, count: int, outputs: Reals) -> int:
    """Kernel of FUZ_ATERM_REAL; inputs X, S1 ..; outputs MD1 .. MD9."""
    return degrees_real(inputs, count, outputs, 0, MOST)


@flat
def aterm_sti(inputs: Ints, count: int, outputs: Ints, rounding: int) -> int:
    """Kernel of FUZ_ATERM_STI; inputs X, S1 ..; output the structure, of which terms not there stay."""
    event = degrees_int(inputs, count, outputs, TERM1, 0, rounding)
    if event == NOTHING:
        outputs[u(0)] = count
    return event


@flat
def aterm_str(inputs: Reals, count: int, outputs: Reals) -> int:
    """Kernel of FUZ_ATERM_STR; inputs X, S1 ..; output the structure, of which terms not there stay."""
    event = degrees_real(inputs, count, outputs, TERM1, 0)
    if event == NOTHING:
        outputs[u(0)] = count
    return event


ATERM_INT = BlockType(
    name="FUZ_ATERM_INT",
    summary="fuzzification of all terms of a variable",
    equation=(
        "X in [S_i, S_i+1]: MD_i+1 = (X - S_i) / (S_i+1 - S_i), MD_i = 1 - MD_i+1, others 0; "
        "X before S1: MD1 = 1; X past S_n: MD_n = 1"
    ),
    source="Concept 2.6, FUZZY library, pp. 49-53",
    number="INT",
    leading=("X",),
    stem="S",
    least=2,
    most=MOST,
    outputs=tuple(f"MD{i}" for i in range(1, MOST + 1)),
    kernel=aterm_int,
)

ATERM_REAL = replace(ATERM_INT, name="FUZ_ATERM_REAL", number="REAL", kernel=aterm_real)

ATERM_STI = replace(
    ATERM_INT,
    name="FUZ_ATERM_STI",
    summary="fuzzification of all terms of a variable, into a structure",
    equation=ATERM_INT.equation + "; n terms are written, the structure's others stay",
    source="Concept 2.6, FUZZY library, pp. 55-58",
    outputs=STRUCTURE,
    kernel=aterm_sti,
)

ATERM_STR = replace(ATERM_STI, name="FUZ_ATERM_STR", number="REAL", kernel=aterm_str)
