"""The kernels of Concept's blocks as rows of a tape: words in, the block, words and ENO out.

Signals are binary64 in the loop's memory. A block's words, INT or binary32,
stand in its states, which are there for nothing else: they are filled anew at
each call, the outputs' with what the signals still hold.
"""

from math import fabs, floor, nan
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fcl_sim.arithmetic.integer import INT_LEAST, INT_MOST
from fcl_sim.concept.declaration import CEILING
from fcl_sim.concept.execute import run_int, run_real
from fcl_sim.concept.values import REAL_MOST
from fcl_sim.jit import flat, inlined, u
from fcl_sim.loop.layout import STATE
from fcl_sim.loop.row import Row, inputs, last, read, word, write

EN, PINS = 0, 1
"""Inputs of the row: EN, the leading pins, CEILING stretched ones, the members of a structure."""

ROUNDING, CODE, COUNT, TRUTHS, LEADING, MEMBERS, OUTPUTS = range(7)
"""Words of the row: of the pins that stretching adds those in use; of the leading ones first those that
are BOOL, then all, but for a structure; members of the structure; outputs besides ENO and event."""


@inlined
def is_int(value: float) -> bool:
    """Return whether a signal has a value that an INT can hold."""
    return INT_LEAST <= value <= INT_MOST and floor(value) == value


@inlined
def is_real(value: float) -> bool:
    """Return whether a signal has a value that a REAL can hold, rounded."""
    return fabs(value) <= REAL_MOST


@inlined
def pin(row: Row, i: int) -> float:
    """Return what word i of the block's inputs is to hold; members that are not wired are 0."""
    leading, members = word(row, LEADING), word(row, MEMBERS)
    if i < word(row, TRUTHS):
        return 1.0 if read(row, PINS + i) != 0.0 else 0.0
    if i < leading:
        return read(row, PINS + i)
    if i < leading + members:
        at = PINS + CEILING + i
        return read(row, at) if at < inputs(row) else 0.0
    return read(row, PINS + i - members)


@flat
def take_in(row: Row, words: NDArray[Any], count: int, first: int, past: int) -> bool:
    """Fill the words of the inputs; return whether each value is one of its type.

    That is INT from word `first` to the one before `past`, REAL elsewhere.
    """
    for i in range(count):
        value = pin(row, i)
        if not (is_int(value) if first <= i < past else is_real(value)):
            return False
        words[u(i)] = value
    return True


@flat
def give_out(row: Row, words: NDArray[Any], event: int) -> None:
    """Write the outputs, ENO and the event."""
    outputs = word(row, OUTPUTS)
    for i in range(outputs):
        write(row, i, words[u(i)])
    write(row, outputs, 0.0 if event > 0 else 1.0)
    write(row, outputs + 1, event)


@flat
def stay(row: Row) -> None:
    """Leave the outputs as they are; ENO is 0, and there is no event."""
    outputs = word(row, OUTPUTS)
    write(row, outputs, 0.0)
    write(row, outputs + 1, 0.0)


@flat
def refuse(row: Row) -> None:
    """Make all outputs NaN, which ends the run."""
    for i in range(word(row, OUTPUTS) + 2):
        write(row, i, nan)


@flat
def integer_block(row: Row) -> None:
    """Kernel of the blocks in INT, with the structure FUZ_MD_INT as well."""
    count, outputs = word(row, LEADING) + word(row, MEMBERS) + word(row, COUNT), word(row, OUTPUTS)
    at = row.ints[u(row.at + STATE)]
    words = row.memory[at : at + count].view(np.int64)
    given = row.memory[at + count : at + count + outputs].view(np.int64)
    if read(row, EN) == 0.0:
        stay(row)
    elif not take_in(row, words, count, 0, count):
        refuse(row)
    else:
        for i in range(outputs):
            given[u(i)] = last(row, i)
        event = run_int(word(row, CODE), words, word(row, COUNT), given, word(row, ROUNDING))
        give_out(row, given, event)


@flat
def real_block(row: Row) -> None:
    """Kernel of the blocks in REAL, with the structure FUZ_MD_REAL as well."""
    count, outputs = word(row, LEADING) + word(row, MEMBERS) + word(row, COUNT), word(row, OUTPUTS)
    at, terms = row.ints[u(row.at + STATE)], word(row, LEADING)
    words = row.memory[at : at + count].view(np.float32)
    given = row.memory[at + count : at + count + outputs].view(np.float32)
    if read(row, EN) == 0.0:
        stay(row)
    elif not take_in(row, words, count, terms, terms + min(1, word(row, MEMBERS))):
        refuse(row)
    else:
        for i in range(outputs):
            given[u(i)] = last(row, i)
        give_out(row, given, run_real(word(row, CODE), words, word(row, COUNT), given))
