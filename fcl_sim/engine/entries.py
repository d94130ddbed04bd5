"""What Python calls: one evaluation, and many over arrays."""

import numpy as np
from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.engine.batch import (
    GAP,
    TOGETHER_AT_MOST,
    bring_rows,
    defuzzify_rows,
    fuzzify_rows,
    visit_rows,
)
from fcl_sim.engine.curved import CURVED, Curved
from fcl_sim.engine.infer import accumulate, defuzzify, infer, infer_curved
from fcl_sim.engine.joint import infer_jointly
from fcl_sim.engine.program import (
    ALL_TOGETHER,
    CLAMPS,
    DEGREES,
    ONE_BY_ONE,
    OUTPUTS,
    RULES,
    TOGETHER,
    Program,
)
from fcl_sim.jit import F4, Entry, F, I, entry, i8, kernel, signature, u, void


@entry(signature(void, I, F, F))
def evaluate_one(ints: NDArray[int64], floats: NDArray[float64], memory: NDArray[float64]) -> None:
    """Evaluate a program once on an instance's memory; floats begin where its header says."""
    infer(ints, floats, 0, memory, 0)


evaluate_one_real = Entry(evaluate_one.function, signature(void, I, F4, F4))
"""`evaluate_one` in binary32."""


@entry(signature(void, I, F, F))
def evaluate_one_jointly(ints: NDArray[int64], floats: NDArray[float64], memory: NDArray[float64]) -> None:
    """`evaluate_one` of programs with a table of joint cells."""
    infer_jointly(ints, floats, 0, memory, 0)


@entry(signature(void, I, F, F))
def evaluate_one_curved(ints: NDArray[int64], floats: NDArray[float64], memory: NDArray[float64]) -> None:
    """`evaluate_one` of programs with areas under norms of the Open Level."""
    infer_curved(ints, floats, 0, memory, 0)


_ONE = {
    ("LREAL", "plain"): evaluate_one,
    ("LREAL", "joint"): evaluate_one_jointly,
    ("LREAL", "curved"): evaluate_one_curved,
    ("REAL", "plain"): evaluate_one_real,
    ("REAL", "joint"): Entry(evaluate_one_jointly.function, signature(void, I, F4, F4)),
    ("REAL", "curved"): Entry(evaluate_one_curved.function, signature(void, I, F4, F4)),
}


def one_for(program: Program) -> Entry:
    """Return what evaluates a program once."""
    return _ONE[program.arithmetic, program.form]


@kernel
def evaluate_points(
    ints: NDArray[int64],
    floats: NDArray[float64],
    memory: NDArray[float64],
    points: NDArray[float64],
    start: int,
    stop: int,
    curved: Curved,
) -> None:
    """Evaluate points as `evaluate_many`; `curved` is None without areas under norms of the Open Level."""
    head = ints[u(DEGREES)]
    given = head - ints[u(OUTPUTS)]
    size = points.size // max(1, head)
    how = ints[u(TOGETHER)]
    first, last = head + ints[u(RULES)], ints[u(CLAMPS)]
    step = TOGETHER_AT_MOST if how != ONE_BY_ONE else 1
    width = min(step, stop - start) + GAP
    rows = np.empty((last + 2) * width if how != ONE_BY_ONE else 0, memory.dtype)
    cells = np.empty(width, np.int64)
    for row in range(start, stop, step):
        count = min(step, stop - row)
        if how != ONE_BY_ONE:
            for place in range(first * width, last * width):
                rows[u(place)] = 0.0
            fuzzify_rows(ints, floats, points, size, row, rows, width, cells, count)
            bring_rows(ints, points, size, row, rows, width, count)
            visit_rows(ints, floats, rows, width, count)
        if how == ALL_TOGETHER:
            defuzzify_rows(ints, floats, rows, width, points, size, row, count)
            continue
        for point in range(count):
            for word in range(given):
                memory[u(word)] = points[u(word * size + row + point)]
            if how == ONE_BY_ONE:
                accumulate(ints, floats, 0, memory, 0)
            else:
                for word in range(first, last):
                    memory[u(word)] = rows[u(word * width + point)]
            defuzzify(ints, floats, 0, memory, 0, curved)
            for word in range(given - ints[u(OUTPUTS)], head):
                points[u(word * size + row + point)] = memory[u(word)]


@entry(signature(void, I, F, F, F, i8, i8))
def evaluate_many(
    ints: NDArray[int64],
    floats: NDArray[float64],
    memory: NDArray[float64],
    points: NDArray[float64],
    start: int,
    stop: int,
) -> None:
    """Evaluate points `start` to `stop`, each without the memory of another.

    `points` holds the inputs one after the other, all values of the first, all
    of the second and so on; likewise the previous values of the outputs, which
    NC keeps, and takes the new ones; likewise it takes the flags.
    """
    evaluate_points(ints, floats, memory, points, start, stop, None)


@entry(signature(void, I, F, F, F, i8, i8))
def evaluate_many_curved(
    ints: NDArray[int64],
    floats: NDArray[float64],
    memory: NDArray[float64],
    points: NDArray[float64],
    start: int,
    stop: int,
) -> None:
    """`evaluate_many` of programs with areas under norms of the Open Level."""
    evaluate_points(ints, floats, memory, points, start, stop, CURVED)


evaluate_many_real = Entry(evaluate_many.function, signature(void, I, F4, F4, F4, i8, i8))
"""`evaluate_many` in binary32."""

EVALUATE_MANY = {"LREAL": evaluate_many, "REAL": evaluate_many_real}
"""By arithmetic."""

_MANY_CURVED = {
    "LREAL": evaluate_many_curved,
    "REAL": Entry(evaluate_many_curved.function, signature(void, I, F4, F4, F4, i8, i8)),
}


def many_for(program: Program) -> Entry:
    """Return what evaluates a program over arrays."""
    return (_MANY_CURVED if program.curved else EVALUATE_MANY)[program.arithmetic]
