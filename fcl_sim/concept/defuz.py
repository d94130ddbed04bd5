"""DEFUZ: a number from singletons and their degrees (pp. 39 to 48)."""

from dataclasses import replace
from math import isfinite
from typing import Any

from numpy.typing import NDArray

from fcl_sim.arithmetic.integer import FULL, fits_dint, quotient
from fcl_sim.concept.declaration import STRUCTURE, TERM1, BlockType, Ints, Reals
from fcl_sim.concept.events import (
    NOTHING,
    OUT_OF_RANGE,
    OVERFLOWN,
    TOO_MANY,
    WARNED_WRONG_NUMBER,
    WRONG_NUMBER,
)
from fcl_sim.jit import flat, inlined, u

MOST = 9
"""Singletons."""

PAIRS = 1
"""Where the pairs of degree and place begin in the words of DEFUZ_INT and DEFUZ_REAL."""

TERMS = 1 + TERM1
PLACES = 1 + len(STRUCTURE)
"""Where the structure's terms and the places begin in the words of DEFUZ_STI and DEFUZ_STR."""


@inlined
def all_degrees(words: NDArray[Any], first: int, step: int, terms: int, full: Any) -> bool:
    """Return whether the terms' words lie in 0 .. `full`."""
    for i in range(terms):
        degree = words[u(first + i * step)]
        if not (full - full <= degree <= full):
            return False
    return True


@inlined
def mean_int(words: Ints, first: int, place: int, step: int, terms: int, outputs: Ints, rounding: int) -> int:
    """Write the mean of places weighted by degrees, in sums of 32 bits; ZERO_Y is the first word."""
    if not all_degrees(words, first, step, terms, FULL):
        return OUT_OF_RANGE
    moment = 0
    total = 0
    for i in range(terms):
        degree = words[u(first + i * step)]
        moment += degree * words[u(place + i * step)]
        total += degree
        if not fits_dint(moment):
            return OVERFLOWN
    if total > 0:
        outputs[u(0)] = quotient(moment, total, rounding)
    elif words[u(0)] != 0:
        outputs[u(0)] = 0
    return NOTHING


@inlined
def mean_real(words: Reals, first: int, place: int, step: int, terms: int, outputs: Reals) -> int:
    """Write the mean as `mean_int`, in the precision of the words."""
    one = words.dtype.type(1)
    if not all_degrees(words, first, step, terms, one):
        return OUT_OF_RANGE
    moment = total = one - one
    for i in range(terms):
        degree = words[u(first + i * step)]
        moment += degree * words[u(place + i * step)]
        total += degree
        if not isfinite(moment):
            return OVERFLOWN
    if total > 0:
        outputs[u(0)] = moment / total
    elif words[u(0)] != 0:
        outputs[u(0)] = 0
    return NOTHING


@inlined
def refused_pairs(count: int) -> int:
    """Return the event of a number of inputs MDiSi."""
    if count > 2 * MOST:
        return TOO_MANY
    return WRONG_NUMBER if count % 2 else NOTHING


@flat
def defuz_int(inputs: Ints, count: int, outputs: Ints, rounding: int) -> int:
    """Kernel of DEFUZ_INT; inputs ZERO_Y, then degree and place of each singleton; output Y."""
    event = refused_pairs(count)
    if event == NOTHING:
        event = mean_int(inputs, PAIRS, PAIRS + 1, 2, count // 2, outputs, rounding)
    return event


@flat
def defuz_real(inputs: Reals, count: int, outputs: Reals) -> int:
    """Kernel of DEFUZ_REAL; inputs ZERO_Y, then degree and place of each singleton; output Y."""
    event = refused_pairs(count)
    if event == NOTHING:
        event = mean_real(inputs, PAIRS, PAIRS + 1, 2, count // 2, outputs)
    return event


@flat
def defuz_sti(inputs: Ints, count: int, outputs: Ints, rounding: int) -> int:
    """Kernel of DEFUZ_STI; inputs ZERO_Y, the structure, S1 ..; output Y."""
    if count > MOST:
        return TOO_MANY
    terms = inputs[u(1)]
    event = mean_int(inputs, TERMS, PLACES, 1, min(terms, count), outputs, rounding)
    return WARNED_WRONG_NUMBER if event == NOTHING and terms != count else event


@flat
def defuz_str(inputs: Reals, count: int, outputs: Reals) -> int:
    """Kernel of DEFUZ_STR; inputs ZERO_Y, the structure, S1 ..; output Y."""
    if count > MOST:
        return TOO_MANY
    terms = int(inputs[u(1)])
    event = mean_real(inputs, TERMS, PLACES, 1, min(terms, count), outputs)
    return WARNED_WRONG_NUMBER if event == NOTHING and terms != count else event


DEFUZ_INT = BlockType(
    name="DEFUZ_INT",
    summary="defuzzification with singletons",
    equation="Y = sum of MD_i S_i / sum of MD_i; all MD_i = 0: Y = 0 if ZERO_Y, else the last Y",
    source="Concept 2.6, FUZZY library, pp. 39-43",
    number="INT",
    leading=("ZERO_Y",),
    stem="MDiSi",
    least=4,
    most=2 * MOST,
    outputs=("Y",),
    kernel=defuz_int,
)

DEFUZ_REAL = replace(DEFUZ_INT, name="DEFUZ_REAL", number="REAL", kernel=defuz_real)

DEFUZ_STI = replace(
    DEFUZ_INT,
    name="DEFUZ_STI",
    summary="defuzzification with singletons, degrees from a structure",
    source="Concept 2.6, FUZZY library, pp. 45-48",
    leading=("ZERO_Y", *STRUCTURE),
    stem="S",
    least=2,
    most=MOST,
    kernel=defuz_sti,
)

DEFUZ_STR = replace(DEFUZ_STI, name="DEFUZ_STR", number="REAL", kernel=defuz_str)
