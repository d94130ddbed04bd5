"""What Python calls: one evaluation, and many over arrays.

Buffers go in by their addresses (`jit.addresses`).
"""

import numpy as np
from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.engine.batch import (
    GAP,
    PATTERNS,
    TOGETHER_AT_MOST,
    bring_rows,
    by_pattern,
    defuzzify_rows,
    fuzzify_rows,
    give_rows,
    take_rows,
    visit_rows,
)
from fcl_sim.engine.curved import CURVED, Curved
from fcl_sim.engine.infer import accumulate, defuzzify, infer, infer_curved
from fcl_sim.engine.joint import infer_jointly
from fcl_sim.engine.precision import LREAL, REAL
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
from fcl_sim.jit import (
    F4,
    Entry,
    F,
    I,
    address,
    b1,
    doubles_at,
    entry,
    f8,
    i8,
    inlined,
    integers_at,
    kernel,
    signature,
    singles_at,
    u,
)

Ints = NDArray[int64]
Floats = NDArray[float64]

WITH_THE_CALL = 4
"""So many inputs can go in with the call itself."""
NOTHING = (0.0,) * WITH_THE_CALL
"""What goes in where no input does."""
LARGEST, LARGEST_REAL = LREAL.largest, REAL.largest
ONE = signature(b1, f8, f8, f8, f8, i8)


@inlined
def written(memory: Floats, given: int, a: float, b: float, c: float, d: float, largest: float) -> bool:
    """Write the first `given` of four numbers, if none is beyond `largest`; those not given are 0."""
    if not (abs(a) <= largest and abs(b) <= largest and abs(c) <= largest and abs(d) <= largest):
        return False
    if given > 0:
        memory[u(0)] = a
    if given > 1:
        memory[u(1)] = b
    if given > 2:
        memory[u(2)] = c
    if given > 3:
        memory[u(3)] = d
    return True


@entry(ONE)
def one_plain(a: float, b: float, c: float, d: float, places: int) -> bool:
    """Write inputs and evaluate a program once; return whether the inputs were fit.

    `places` is the address of what `placed` returns.
    """
    at = integers_at(places)
    ints, floats, memory = integers_at(at[u(0)]), doubles_at(at[u(1)]), doubles_at(at[u(2)])
    taken = written(memory, at[u(3)], a, b, c, d, LARGEST)
    if taken:
        infer(ints, floats, 0, memory, 0)
    return taken


@entry(ONE)
def one_joint(a: float, b: float, c: float, d: float, places: int) -> bool:
    """`one_plain` of programs with a table of joint cells."""
    at = integers_at(places)
    ints, floats, memory = integers_at(at[u(0)]), doubles_at(at[u(1)]), doubles_at(at[u(2)])
    taken = written(memory, at[u(3)], a, b, c, d, LARGEST)
    if taken:
        infer_jointly(ints, floats, 0, memory, 0)
    return taken


@entry(ONE)
def one_curved(a: float, b: float, c: float, d: float, places: int) -> bool:
    """`one_plain` of programs with areas under norms of the Open Level."""
    at = integers_at(places)
    ints, floats, memory = integers_at(at[u(0)]), doubles_at(at[u(1)]), doubles_at(at[u(2)])
    taken = written(memory, at[u(3)], a, b, c, d, LARGEST)
    if taken:
        infer_curved(ints, floats, 0, memory, 0)
    return taken


@entry(ONE)
def one_plain_real(a: float, b: float, c: float, d: float, places: int) -> bool:
    """`one_plain` in binary32."""
    at = integers_at(places)
    ints, floats, memory = integers_at(at[u(0)]), singles_at(at[u(1)]), singles_at(at[u(2)])
    taken = written(memory, at[u(3)], a, b, c, d, LARGEST_REAL)
    if taken:
        infer(ints, floats, 0, memory, 0)
    return taken


@entry(ONE)
def one_joint_real(a: float, b: float, c: float, d: float, places: int) -> bool:
    """`one_joint` in binary32."""
    at = integers_at(places)
    ints, floats, memory = integers_at(at[u(0)]), singles_at(at[u(1)]), singles_at(at[u(2)])
    taken = written(memory, at[u(3)], a, b, c, d, LARGEST_REAL)
    if taken:
        infer_jointly(ints, floats, 0, memory, 0)
    return taken


@entry(ONE)
def one_curved_real(a: float, b: float, c: float, d: float, places: int) -> bool:
    """`one_curved` in binary32."""
    at = integers_at(places)
    ints, floats, memory = integers_at(at[u(0)]), singles_at(at[u(1)]), singles_at(at[u(2)])
    taken = written(memory, at[u(3)], a, b, c, d, LARGEST_REAL)
    if taken:
        infer_curved(ints, floats, 0, memory, 0)
    return taken


_ONE = {
    ("LREAL", "plain"): one_plain,
    ("LREAL", "joint"): one_joint,
    ("LREAL", "curved"): one_curved,
    ("REAL", "plain"): one_plain_real,
    ("REAL", "joint"): one_joint_real,
    ("REAL", "curved"): one_curved_real,
}


def one_for(program: Program) -> Entry:
    """Return what evaluates a program once, on WITH_THE_CALL numbers and the address of what is `placed`.

    It returns whether the inputs were fit; else nothing is done.
    """
    return _ONE[program.arithmetic, program.form]


def placed(program: Program, memory: NDArray[np.floating], given: int) -> Ints:
    """Return where a program and an instance's memory are, and how many inputs go in with the call.

    All three have to outlive its use.
    """
    return np.array([*map(address, (program.ints, program.floats, memory)), given], np.int64)


def evaluate_once(program: Program, memory: NDArray[np.floating]) -> None:
    """Evaluate a program once, on an instance's memory with the inputs in it."""
    at = placed(program, memory, 0)
    one_for(program)(*NOTHING, address(at))


@kernel
def evaluate_points(
    ints: Ints,
    floats: Floats,
    memory: Floats,
    columns: Ints,
    largest: float,
    start: int,
    stop: int,
    curved: Curved,
) -> int:
    """Evaluate points as `evaluate_many`; `curved` is None without areas under norms of the Open Level."""
    head = ints[u(DEGREES)]
    outputs = ints[u(OUTPUTS)]
    given = head - outputs
    how = ints[u(TOGETHER)]
    first, last = head + ints[u(RULES)], ints[u(CLAMPS)]
    width = min(TOGETHER_AT_MOST, stop - start) + GAP
    rows = np.empty((head if how == ONE_BY_ONE else last + 2) * width, memory.dtype)
    cells = np.zeros(width, np.int64)
    order = np.empty(width + PATTERNS, np.int64)
    for row in range(start, stop, TOGETHER_AT_MOST):
        count = min(TOGETHER_AT_MOST, stop - row)
        if not take_rows(columns, given, row, rows, width, count, largest):
            return row
        if how != ONE_BY_ONE:
            for place in range(first * width, last * width):
                rows[u(place)] = 0.0
            fuzzify_rows(ints, floats, rows, width, cells, count)
            bring_rows(ints, rows, width, count)
            visit_rows(ints, floats, rows, width, cells, count)
        if how == ALL_TOGETHER:
            defuzzify_rows(ints, floats, rows, width, count)
        else:
            by_pattern(cells, order, count)
            for place in range(count):
                point = order[u(place)]
                for word in range(given):
                    memory[u(word)] = rows[u(word * width + point)]
                if how == ONE_BY_ONE:
                    accumulate(ints, floats, 0, memory, 0)
                else:
                    for word in range(first, last):
                        memory[u(word)] = rows[u(word * width + point)]
                defuzzify(ints, floats, 0, memory, 0, curved)
                for word in range(given - outputs, head):
                    rows[u(word * width + point)] = memory[u(word)]
        give_rows(columns, given, outputs, row, rows, width, count)
    return -1


@entry(signature(i8, I, F, F, I, f8, i8, i8))
def evaluate_many(
    ints: Ints, floats: Floats, memory: Floats, columns: Ints, largest: float, start: int, stop: int
) -> int:
    """Evaluate points `start` to `stop`, each without the memory of another; return -1.

    `columns` has for each input, then for each output's previous value, which
    NC keeps, where its float64 numbers are, and their kind (batch.py); then for
    each output, where its numbers go and where its flags, bytes of 0 or 1.
    Returns a row from which on at most TOGETHER_AT_MOST rows one has an input
    beyond `largest` or NaN.
    """
    return evaluate_points(ints, floats, memory, columns, largest, start, stop, None)


@entry(signature(i8, I, F, F, I, f8, i8, i8))
def evaluate_many_curved(
    ints: Ints, floats: Floats, memory: Floats, columns: Ints, largest: float, start: int, stop: int
) -> int:
    """`evaluate_many` of programs with areas under norms of the Open Level."""
    return evaluate_points(ints, floats, memory, columns, largest, start, stop, CURVED)


_REAL = signature(i8, I, F4, F4, I, f8, i8, i8)
_MANY = {
    ("LREAL", False): evaluate_many,
    ("LREAL", True): evaluate_many_curved,
    ("REAL", False): Entry(evaluate_many.function, _REAL),
    ("REAL", True): Entry(evaluate_many_curved.function, _REAL),
}
"""By arithmetic, and whether there are areas under norms of the Open Level."""


def many_for(program: Program) -> Entry:
    """Return what evaluates a program over arrays."""
    return _MANY[program.arithmetic, program.curved]


def entries_in(arithmetic: str) -> list[Entry]:
    """Return all that evaluates programs in an arithmetic."""
    return [own for table in (_MANY, _ONE) for (name, _), own in table.items() if name == arithmetic]
