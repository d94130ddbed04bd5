"""Evaluation by joint cells: what there is to do is listed beforehand for every way in which cells meet.

Few rules can fire where a cell of one input meets a cell of another, and which
ones is known as soon as a program is made. In a loop, the inputs are seldom in
other cells than at the last evaluation: then nothing is searched, nothing has
to be cleared, and a degree goes through its rules to the sums of CoGS at once.
It is the arithmetic of `infer`, in its order, to the last bit.
"""

from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.arithmetic.membership import PAIR_SIZE, cell_of, degrees_on_pair
from fcl_sim.arithmetic.operators import maximum, minimum
from fcl_sim.engine.clear import clear
from fcl_sim.engine.program import (
    EDGES_SIZE,
    FIRED_DEGREE,
    FIRED_RULES,
    FIRED_SIZE,
    FIRED_TERM,
    FLOATS,
    GRID,
    GRID_COUNT,
    GRID_INPUT,
    GRID_KNOTS,
    GRID_SIZE,
    GRID_STRIDE,
    GRIDS,
    JOINT,
    JOINT_HELD,
    JOINT_PAIRS,
    MET_CELL,
    MET_INPUT,
    MET_SLOTS,
    OUT_ACTIVE,
    OUT_DEGREES,
    OUT_KEEP,
    OUT_PLACES,
    OUT_TERMS,
    OUT_VALUE,
    OUTPUT,
    OUTPUT_SIZE,
    OUTPUTS,
)
from fcl_sim.jit import inlined, u

Ints = NDArray[int64]
Floats = NDArray[float64]

NOT_THERE = -1


@inlined
def fuzzify_in(ints: Ints, floats: Floats, at: int, joint: int, found: int, memory: Floats, base: int) -> int:
    """Write the degrees of all input terms in a joint cell; return where its list begins, or NOT_THERE.

    One that was `found` (1, else 0) is not doubted: NaN is in none.
    """
    origin = ints[u(at + FLOATS)]
    for _ in range(ints[u(at + GRIDS)]):
        x = memory[u(base + ints[u(joint + MET_INPUT)])]
        cell = origin + ints[u(joint + MET_CELL)]
        if not (floats[u(cell)] <= x <= floats[u(cell + 1)]) and found == 0:
            return NOT_THERE
        joint += MET_SLOTS
        cell += EDGES_SIZE
        for _ in range(ints[u(at + JOINT_PAIRS)]):
            first, second = degrees_on_pair(x, floats, cell)
            memory[u(base + ints[u(joint)])] = first
            memory[u(base + ints[u(joint + 1)])] = second
            joint += 2
            cell += PAIR_SIZE
    return joint


@inlined
def moved_on(ints: Ints, floats: Floats, at: int, memory: Floats, base: int) -> int:
    """Clear what the joint cell before has left; return where the record of the present one begins."""
    clear(ints, at, memory, base)
    origin = ints[u(at + FLOATS)]
    number = 0
    grid = at + ints[u(at + GRID)]
    for _ in range(ints[u(at + GRIDS)]):
        x = memory[u(base + ints[u(grid + GRID_INPUT)])]
        cell = cell_of(x, floats, origin + ints[u(grid + GRID_KNOTS)], ints[u(grid + GRID_COUNT)])
        number += cell * ints[u(grid + GRID_STRIDE)]
        grid += GRID_SIZE
    joint = int(ints[u(at + ints[u(at + JOINT)] + number)])
    memory[u(base + ints[u(at + JOINT_HELD)])] = joint
    return at + joint


@inlined
def fired(ints: Ints, entry: int, memory: Floats, base: int) -> tuple[float, int]:
    """Return the degree of firing of a rule of a list, which is kept, and where the rule ends."""
    degree: float = minimum(memory[u(base + ints[u(entry)])], memory[u(base + ints[u(entry + 1)])])
    entry += 2
    word = ints[u(entry)]
    while word >= 0:
        degree = minimum(degree, memory[u(base + word)])
        entry += 1
        word = ints[u(entry)]
    memory[u(base + FIRED_DEGREE - word)] = degree
    return degree, entry + 1


@inlined
def concluded(ints: Ints, entry: int, memory: Floats, base: int) -> tuple[float, int]:
    """Return the accumulated degree of a term of a list, and where the rules that conclude it end."""
    rules = ints[u(entry + FIRED_RULES)]
    degree, entry = fired(ints, entry + FIRED_SIZE, memory, base)
    while rules > 1:
        other, entry = fired(ints, entry, memory, base)
        degree = maximum(degree, other)
        rules -= 1
    return degree, entry


@inlined
def infer_jointly(ints: Ints, floats: Floats, at: int, memory: Floats, base: int) -> None:
    """Evaluate a program with a table of joint cells, as `infer` does."""
    joint = at + int(memory[u(base + ints[u(at + JOINT_HELD)])])
    entry = NOT_THERE
    for found in range(2):
        entry = fuzzify_in(ints, floats, at, joint, found, memory, base)
        if entry != NOT_THERE:
            break
        joint = moved_on(ints, floats, at, memory, base)
    origin = ints[u(at + FLOATS)]
    output = at + ints[u(at + OUTPUT)]
    for _ in range(ints[u(at + OUTPUTS)]):
        places = origin + ints[u(output + OUT_PLACES)]
        degrees = base + ints[u(output + OUT_DEGREES)]
        terms = ints[u(entry)]
        entry += 1
        moment = total = 0.0
        if terms > 0:
            term = ints[u(entry + FIRED_TERM)]
            total, entry = concluded(ints, entry, memory, base)
            memory[u(degrees + term)] = total
            moment = floats[u(places + term)] * total
            while terms > 1:
                term = ints[u(entry + FIRED_TERM)]
                degree, entry = concluded(ints, entry, memory, base)
                memory[u(degrees + term)] = degree
                moment += floats[u(places + term)] * degree
                total += degree
                terms -= 1
        if total == 0.0:
            memory[u(base + ints[u(output + OUT_ACTIVE)])] = 0.0
            if ints[u(output + OUT_KEEP)] == 0:
                value = floats[u(places + ints[u(output + OUT_TERMS)])]
                memory[u(base + ints[u(output + OUT_VALUE)])] = value
        else:
            memory[u(base + ints[u(output + OUT_ACTIVE)])] = 1.0
            memory[u(base + ints[u(output + OUT_VALUE)])] = moment / total
        output += OUTPUT_SIZE
