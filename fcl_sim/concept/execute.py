"""`execute_int` and `execute_real`: run a block by its opcode, its row in TABLE.

Opcodes are even for INT, odd for REAL: a block's two arithmetics stand together.
"""

from numpy import float32
from numpy.typing import NDArray

from fcl_sim.concept.aterm import (
    ATERM_INT,
    ATERM_REAL,
    ATERM_STI,
    ATERM_STR,
    aterm_int,
    aterm_real,
    aterm_sti,
    aterm_str,
)
from fcl_sim.concept.declaration import BlockType, Ints
from fcl_sim.concept.defuz import (
    DEFUZ_INT,
    DEFUZ_REAL,
    DEFUZ_STI,
    DEFUZ_STR,
    defuz_int,
    defuz_real,
    defuz_sti,
    defuz_str,
)
from fcl_sim.concept.operators import (
    MAX_INT,
    MAX_REAL,
    MIN_INT,
    MIN_REAL,
    PROD_INT,
    PROD_REAL,
    SUM_INT,
    SUM_REAL,
    max_int,
    max_real,
    min_int,
    min_real,
    prod_int,
    prod_real,
    sum_int,
    sum_real,
)
from fcl_sim.concept.sterm import STERM_INT, STERM_REAL, sterm_int, sterm_real
from fcl_sim.jit import F4, I, entry, flat, i8, signature

TABLE: tuple[BlockType, ...] = (
    ATERM_INT, ATERM_REAL, ATERM_STI, ATERM_STR, STERM_INT, STERM_REAL,
    MIN_INT, MIN_REAL, MAX_INT, MAX_REAL, PROD_INT, PROD_REAL, SUM_INT, SUM_REAL,
    DEFUZ_INT, DEFUZ_REAL, DEFUZ_STI, DEFUZ_STR,
)  # fmt: skip
"""Block types by opcode."""


@flat
def run_int(opcode: int, inputs: Ints, count: int, outputs: Ints, rounding: int) -> int:
    """Run a block in INT arithmetic; return its event's number."""
    if opcode == 0:
        event = aterm_int(inputs, count, outputs, rounding)
    elif opcode == 2:
        event = aterm_sti(inputs, count, outputs, rounding)
    elif opcode == 4:
        event = sterm_int(inputs, count, outputs, rounding)
    elif opcode == 6:
        event = min_int(inputs, count, outputs, rounding)
    elif opcode == 8:
        event = max_int(inputs, count, outputs, rounding)
    elif opcode == 10:
        event = prod_int(inputs, count, outputs, rounding)
    elif opcode == 12:
        event = sum_int(inputs, count, outputs, rounding)
    elif opcode == 14:
        event = defuz_int(inputs, count, outputs, rounding)
    else:
        event = defuz_sti(inputs, count, outputs, rounding)
    return event


@entry(signature(i8, i8, I, i8, I, i8))
def execute_int(opcode: int, inputs: Ints, count: int, outputs: Ints, rounding: int) -> int:
    """Run a block as `run_int`."""
    return run_int(opcode, inputs, count, outputs, rounding)


@flat
def run_real(opcode: int, inputs: NDArray[float32], count: int, outputs: NDArray[float32]) -> int:
    """Run a block in REAL arithmetic, which is binary32; return its event's number."""
    if opcode == 1:
        event = aterm_real(inputs, count, outputs)
    elif opcode == 3:
        event = aterm_str(inputs, count, outputs)
    elif opcode == 5:
        event = sterm_real(inputs, count, outputs)
    elif opcode == 7:
        event = min_real(inputs, count, outputs)
    elif opcode == 9:
        event = max_real(inputs, count, outputs)
    elif opcode == 11:
        event = prod_real(inputs, count, outputs)
    elif opcode == 13:
        event = sum_real(inputs, count, outputs)
    elif opcode == 15:
        event = defuz_real(inputs, count, outputs)
    else:
        event = defuz_str(inputs, count, outputs)
    return event


@entry(signature(i8, i8, F4, i8, F4))
def execute_real(opcode: int, inputs: NDArray[float32], count: int, outputs: NDArray[float32]) -> int:
    """Run a block as `run_real`."""
    return run_real(opcode, inputs, count, outputs)
