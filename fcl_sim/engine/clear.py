"""Clearing: all degrees are 0 before those are computed that are not."""

from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.engine.program import CLEAR, CLEARED, CLEARED_TOGETHER
from fcl_sim.jit import clear_eight, inlined, u

Ints = NDArray[int64]
Floats = NDArray[float64]


@inlined
def clear(ints: Ints, at: int, memory: Floats, base: int) -> None:
    """Set all degrees to 0.

    Of a plain loop the compiler makes a call of memset, or one that prepares
    for a long way: for a few dozen words both take longer than the stores.
    """
    word = base + ints[u(at + CLEAR)]
    while word < base + ints[u(at + CLEARED)]:
        clear_eight(memory, u(word))
        word += CLEARED_TOGETHER
