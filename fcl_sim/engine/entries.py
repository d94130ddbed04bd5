"""What Python calls: one evaluation, and many over arrays."""

from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.engine.infer import infer
from fcl_sim.jit import FF, F, I, entry, i8, signature, void


@entry(signature(void, I, F, F))
def evaluate_one(ints: NDArray[int64], floats: NDArray[float64], memory: NDArray[float64]) -> None:
    """Evaluate a program once on an instance's memory; floats begin where its header says."""
    infer(ints, floats, 0, memory, 0)


@entry(signature(void, I, F, F, FF, FF, FF, i8, i8))
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
    """Evaluate rows `start` to `stop` of `points` (n, inputs), each without the memory of another.

    `outputs` (n, outputs) holds the previous values, which NC keeps, and takes
    the new ones; `active` (n, outputs) takes the flags.
    """
    n_in = points.shape[1]
    n_out = outputs.shape[1]
    for row in range(start, stop):
        for i in range(n_in):
            memory[i] = points[row, i]
        for i in range(n_out):
            memory[n_in + i] = outputs[row, i]
        infer(ints, floats, 0, memory, 0)
        for i in range(n_out):
            outputs[row, i] = memory[n_in + i]
            active[row, i] = memory[n_in + n_out + i]
