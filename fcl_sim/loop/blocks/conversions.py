"""`to_int` and `from_int`: between a physical quantity and the counts of an INT."""

from collections.abc import Mapping
from math import nan

import numpy as np

from fcl_sim.arithmetic.integer import INT_LEAST, INT_MOST
from fcl_sim.jit import inlined
from fcl_sim.loop.blocks.concept_row import is_int
from fcl_sim.loop.blocks.declaration import BlockInput, BlockOutput, BlockParameter, BlockType, Like
from fcl_sim.loop.row import Row, number, read, word, write

INT = f"INT, a whole number from {INT_LEAST} to {INT_MOST}"

STEP, OFFSET = 0, 1
NEAREST = 0
OUT, OVERFLOW = 0, 1


@inlined
def to_int(row: Row) -> None:
    """Kernel of `to_int`."""
    counts = (read(row, 0) - number(row, OFFSET)) / number(row, STEP)
    whole = np.rint(counts) if word(row, 0) == NEAREST else np.trunc(counts)
    held = min(max(whole, float(INT_LEAST)), float(INT_MOST))
    write(row, OUT, held + 0.0)  # no -0 among the whole numbers
    write(row, OVERFLOW, 0.0 if held == whole else 1.0)


@inlined
def from_int(row: Row) -> None:
    """Kernel of `from_int`."""
    counts = read(row, 0)
    write(row, 0, number(row, OFFSET) + number(row, STEP) * counts if is_int(counts) else nan)


def _refusal(values: Mapping[str, float]) -> tuple[str, str] | None:
    return None if is_int(values["input"]) else ("input", INT)


TO_INT = BlockType(
    name="to_int",
    summary="a quantity in counts, as a PLC's INT holds it",
    equation=(
        "OUT = (u - offset)/step, as a whole number, held between -32768 and 32767; "
        "nearest: halves to the even one; truncate: towards 0; overflow = 1 where it is held; no memory"
    ),
    source="IEC 61131-3 6.6.2.5.2, REAL_TO_INT and TRUNC, which leave overflow open",
    kernel=to_int,
    inputs=(BlockInput(name="input", meaning="u"),),
    parameters=(
        BlockParameter(
            name="step", unit=Like("input"), default=1.0, above=0.0, meaning="what a count is worth"
        ),
        BlockParameter(name="offset", unit=Like("input"), default=0.0, meaning="where the counts begin"),
        BlockParameter(
            name="rounding",
            kind="choice",
            choices=("nearest", "truncate"),
            default="nearest",
            meaning="which whole number is taken",
        ),
    ),
    outputs=(
        BlockOutput(name="OUT", meaning="the counts"),
        BlockOutput(name="overflow", meaning="1 where it does not fit into an INT"),
    ),
)

FROM_INT = BlockType(
    name="from_int",
    summary="counts of an INT as a quantity",
    equation="y = offset + step u; no memory",
    source="IEC 61131-3 6.6.2.5.2, INT_TO_REAL, scaled",
    kernel=from_int,
    inputs=(BlockInput(name="input", meaning="u, the counts", unit=""),),
    parameters=(
        BlockParameter(name="step", unit=None, default=1.0, meaning="what a count is worth, with its unit"),
        BlockParameter(name="offset", unit=Like("step"), default=0.0, meaning="where the counts begin"),
    ),
    outputs=(BlockOutput(unit=Like("step"), told_by="step"),),
    refusal=_refusal,
)
