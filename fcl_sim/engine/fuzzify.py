"""Fuzzification: the degrees of all input terms with constant points, each term once (5.2.2)."""

from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.arithmetic.membership import PAIR_SIZE, cell_of, degrees_on_pair
from fcl_sim.engine.program import (
    ALL,
    EDGES_SIZE,
    FLOATS,
    GRID,
    GRID_CELL,
    GRID_CELLS,
    GRID_COUNT,
    GRID_INPUT,
    GRID_KNOTS,
    GRID_MASK,
    GRID_MORE,
    GRID_PIECES,
    GRID_ROW_SIZE,
    GRID_ROWS,
    GRID_SIZE,
    GRID_WIDTH,
    GRIDS,
)
from fcl_sim.jit import inlined, u

Ints = NDArray[int64]
Floats = NDArray[float64]


@inlined
def fuzzify(ints: Ints, floats: Floats, at: int, memory: Floats, base: int) -> int:
    """Write the degrees of all input terms; return the mask of rules that can fire, if it is one word.

    In a loop, a variable is seldom in another cell than at the last evaluation:
    a processor goes on with that one while it still compares.
    """
    origin = ints[u(at + FLOATS)]
    first = int(ints[u(at + ints[u(at + ALL)])])
    grid = at + ints[u(at + GRID)]
    for _ in range(ints[u(at + GRIDS)]):
        x = memory[u(base + ints[u(grid + GRID_INPUT)])]
        held = base + ints[u(grid + GRID_CELL)]
        cells = origin + ints[u(grid + GRID_CELLS)]
        pieces = ints[u(grid + GRID_PIECES)]
        cell = int(memory[u(held)])
        edge = cells + cell * pieces
        if not (floats[u(edge)] <= x <= floats[u(edge + 1)]):
            cell = cell_of(x, floats, origin + ints[u(grid + GRID_KNOTS)], ints[u(grid + GRID_COUNT)])
            memory[u(held)] = cell
            edge = cells + cell * pieces
        row = at + ints[u(grid + GRID_ROWS)] + cell * ints[u(grid + GRID_ROW_SIZE)]
        segment = edge + EDGES_SIZE
        first &= int(ints[u(row)])
        one, other = degrees_on_pair(x, floats, segment)
        memory[u(base + ints[u(row + 1)])] = one
        memory[u(base + ints[u(row + 2)])] = other
        if ints[u(grid + GRID_MORE)] != 0:
            fuzzify_more(ints, floats, at, grid, row, segment, x, memory, base)
        grid += GRID_SIZE
    return first


@inlined
def fuzzify_more(
    ints: Ints,
    floats: Floats,
    at: int,
    grid: int,
    row: int,
    segment: int,
    x: float,
    memory: Floats,
    base: int,
) -> None:
    """Write the degrees of the terms of a cell but two, and of masks of many words where the row's begins."""
    width = ints[u(grid + GRID_WIDTH)]
    for place in range(2, width, 2):
        segment += PAIR_SIZE
        one, other = degrees_on_pair(x, floats, segment)
        memory[u(base + ints[u(row + 1 + place)])] = one
        memory[u(base + ints[u(row + 2 + place)])] = other
    if ints[u(grid + GRID_MASK)] != 0:
        memory[u(base + ints[u(grid + GRID_MASK)])] = row + 1 + width - at
