"""A block's row of the tape, as its kernel sees it: inputs, numbers, words, states, outputs."""

from typing import NamedTuple

from fcl_sim.jit import inlined, u
from fcl_sim.loop.layout import FIRST_INPUT, INPUTS, OUTPUT, PARAMETERS, STATE
from fcl_sim.loop.work import Floats, Ints


class Row(NamedTuple):
    """The row that begins at `at` of the tape, in the scan that has number `scan`.

    `cycle` is the cycle time and `time` the start of the scan, both in seconds.
    """

    ints: Ints
    floats: Floats
    memory: Floats
    at: int
    cycle: float
    time: float
    scan: int


@inlined
def inputs(row: Row) -> int:
    """Return the number of inputs."""
    found: int = row.ints[u(row.at + INPUTS)]
    return found


@inlined
def read(row: Row, i: int) -> float:
    """Return input i, its sign or gain included."""
    slot = row.ints[u(row.at + FIRST_INPUT + i)]
    found: float = row.floats[u(row.ints[u(row.at + PARAMETERS)] + i)] * row.memory[u(slot)]
    return found


@inlined
def number(row: Row, i: int) -> float:
    """Return number i: the quantities among the parameters that are no ports, then what was prepared."""
    found: float = row.floats[u(row.ints[u(row.at + PARAMETERS)] + inputs(row) + i)]
    return found


@inlined
def word(row: Row, i: int) -> int:
    """Return word i: the counts, choices and truths among the parameters, then what was prepared."""
    found: int = row.ints[u(row.at + FIRST_INPUT + inputs(row) + i)]
    return found


@inlined
def recall(row: Row, i: int) -> float:
    """Return state i."""
    found: float = row.memory[u(row.ints[u(row.at + STATE)] + i)]
    return found


@inlined
def keep(row: Row, i: int, value: float) -> None:
    """Set state i."""
    row.memory[u(row.ints[u(row.at + STATE)] + i)] = value


@inlined
def last(row: Row, i: int) -> float:
    """Return output i as the last scan left it, 0 before the first."""
    found: float = row.memory[u(row.ints[u(row.at + OUTPUT)] + i)]
    return found


@inlined
def write(row: Row, i: int, value: float) -> None:
    """Set output i."""
    row.memory[u(row.ints[u(row.at + OUTPUT)] + i)] = value
