"""What Python calls: one evaluation, and many over arrays."""

from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.engine.infer import infer
from fcl_sim.engine.program import DEGREES, OUTPUTS
from fcl_sim.jit import F4, Entry, F, I, entry, i8, signature, u, void


@entry(signature(void, I, F, F))
def evaluate_one(ints: NDArray[int64], floats: NDArray[float64], memory: NDArray[float64]) -> None:
    """Evaluate a program once on an instance's memory; floats begin where its header says."""
    infer(ints, floats, 0, memory, 0)


evaluate_one_real = Entry(evaluate_one.function, signature(void, I, F4, F4))
"""`evaluate_one` in binary32."""

EVALUATE_ONE = {"LREAL": evaluate_one, "REAL": evaluate_one_real}
"""By arithmetic."""


@entry(signature(void, I, F, F, F, F, F, i8, i8))
def evaluate_many(
    ints: NDArray[int64],
    floats: NDArray[float64],
    memory: NDArray[float64],
    points: NDArray[float64],
    outputs: NDArray[float64],
    active: NDArray[float64],
    start: int,
    stop: int,
) -> None:
    """Evaluate points `start` to `stop`, each without the memory of another.

    `points` holds the inputs one after the other, all values of the first, all
    of the second and so on; `outputs` likewise the previous values, which NC
    keeps, and takes the new ones; `active` takes the flags.
    """
    n_out = ints[u(OUTPUTS)]
    n_in = ints[u(DEGREES)] - 2 * n_out
    size = outputs.size // max(1, n_out)
    for row in range(start, stop):
        for i in range(n_in):
            memory[u(i)] = points[u(i * size + row)]
        for i in range(n_out):
            memory[u(n_in + i)] = outputs[u(i * size + row)]
        infer(ints, floats, 0, memory, 0)
        for i in range(n_out):
            outputs[u(i * size + row)] = memory[u(n_in + i)]
            active[u(i * size + row)] = memory[u(n_in + n_out + i)]


evaluate_many_real = Entry(evaluate_many.function, signature(void, I, F4, F4, F4, F4, F4, i8, i8))
"""`evaluate_many` in binary32."""

EVALUATE_MANY = {"LREAL": evaluate_many, "REAL": evaluate_many_real}
"""By arithmetic."""
