"""The functions of a plant as a run calls them: with one address in place of five arrays.

A call through a first-class function costs as much as a small plant, and most
of that are the arrays. So the derivatives of a step are taken in one call, in
code that is compiled for each plant: there the plant's function is copied in,
and the number of states is known.
"""

from functools import lru_cache
from types import FunctionType
from typing import Any

from fcl_sim.jit import (
    Entry,
    copied,
    doubles_at,
    f8,
    function_type,
    i8,
    inlined,
    integers_at,
    part_at,
    scratch,
    shift_four,
    signature,
    stretch,
    u,
    void,
)
from fcl_sim.loop.layout import EVENTS, PLANT_INPUTS, PLANT_OUTPUTS, SCHEME_AT, STAGES
from fcl_sim.loop.stages import Shape, Step, chain, combine_rows, put_states
from fcl_sim.loop.work import (
    AT_FLOATS,
    AT_G,
    AT_HELD,
    AT_INTS,
    AT_P,
    AT_ROWS,
    AT_X,
    AT_Y,
    BASE_AT,
    P_SIZE,
    Called,
    Floats,
    errors_at,
    row_of,
)
from fcl_sim.plant.functions import PlantFunctions

STEP = (void, i8, f8, f8, i8, i8, i8)
OUTPUTS = (void, i8, f8, i8)
LOOK = (void, i8, i8, f8, i8)
STEP_TYPE, OUTPUTS_TYPE, LOOK_TYPE = (function_type(*each) for each in (STEP, OUTPUTS, LOOK))

TRUE_STATES, STATES, STAGE_COUNT = 1, 4, 4
"""Stand for the number of states of the plant, for that with the padding, a multiple of 4, and for the
number of stages of the scheme."""


def own(*_: Any) -> None:
    """Stand for the function of the plant."""


@inlined
def shift(
    trial: Floats, origin: Floats, origin_at: int, weight: float, rows: Floats, row: int, i: int, left: int
) -> None:
    """Set states of `trial`, from i on, to those of the origin plus a weight times a derivative.

    Four, or as many as are `left`: padding stays 0. What a plant has just
    written is read one by one: a processor that reads four numbers at once
    waits until those that were written singly have left it.
    """
    b = c = d = 0.0
    a = origin[u(origin_at + i)] + weight * rows[u(row + i)]
    if left > 1:
        b = origin[u(origin_at + i + 1)] + weight * rows[u(row + i + 1)]
    if left > 2:
        c = origin[u(origin_at + i + 2)] + weight * rows[u(row + i + 2)]
    if left > 3:
        d = origin[u(origin_at + i + 3)] + weight * rows[u(row + i + 3)]
    trial[u(i)] = a
    if left > 1:
        trial[u(i + 1)] = b
    if left > 2:
        trial[u(i + 2)] = c
    if left > 3:
        trial[u(i + 3)] = d


def step(at: int, t: float, h: float, first: int, last: int, mode: int) -> None:
    """Write the derivatives `first` to `last` of a step h from x, and the next point behind each, to `trial`.

    Derivative 0 is that at x; where a step begins with another, its row holds
    that. The point behind the last row of the scheme is the solution. With
    `last` 0 no point is made: it is the derivative at x, and no more. Where the
    last is that at the solution, the base is left with their sums for the error
    estimate.
    """
    places = integers_at(at)
    ints, floats = integers_at(places[u(AT_INTS)]), doubles_at(places[u(AT_FLOATS)])
    x, trial = part_at(places[u(AT_X)], STATES), part_at(places[u(AT_X + 1)], STATES)
    held = part_at(places[u(AT_HELD)], ints[u(PLANT_INPUTS)])
    p, rows = part_at(places[u(AT_P)], places[u(P_SIZE)]), doubles_at(places[u(AT_ROWS)])
    stages, nodes = ints[u(STAGES)], ints[u(SCHEME_AT)]
    row = nodes + stages + 1
    if first > 0:
        for i in range(0, STATES, 4):
            shift(trial, x, 0, h * floats[u(row)], rows, row_of(0, STATES), i, TRUE_STATES - i)
    for stage in range(first, last + 1):
        row += stage
        if 0 < stage < stages:
            # All of the next point but the derivative to come: work that need not wait for it.
            combine_rows(rows, floats, row, STATES, stage)
            for i in range(0, STATES, 4):
                shift_four(rows, u(BASE_AT + i), x, u(i), h, rows, u(BASE_AT + i))
        found = row_of(stage, STATES)
        point = x if stage == 0 else trial
        own(t + floats[u(nodes + stage)] * h, point, held, p, mode, stretch(rows, u(found), u(STATES)))
        if stage < stages and last > 0:
            weight = h * floats[u(row + stage)]
            for i in range(0, STATES, 4):
                if stage == 0:
                    shift(trial, x, 0, weight, rows, found, i, TRUE_STATES - i)
                else:
                    shift(trial, rows, BASE_AT, weight, rows, found, i, TRUE_STATES - i)
    if last == stages:
        combine_rows(rows, floats, errors_at(nodes, stages), STATES, stages + 1)


def step_of_few(at: int, t: float, h: float, first: int, last: int, mode: int) -> None:
    """`step` of a plant with few states, its stages each in code of its own (`loop.stages`)."""
    places = integers_at(at)
    ints, floats = integers_at(places[u(AT_INTS)]), doubles_at(places[u(AT_FLOATS)])
    x, trial = part_at(places[u(AT_X)], STATES), part_at(places[u(AT_X + 1)], STATES)
    held = part_at(places[u(AT_HELD)], ints[u(PLANT_INPUTS)])
    p, rows = part_at(places[u(AT_P)], places[u(P_SIZE)]), doubles_at(places[u(AT_ROWS)])
    nodes = ints[u(SCHEME_AT)]
    weights = nodes + STAGE_COUNT + 1
    point, slope, base = scratch(STATES), scratch(STATES), scratch(STATES)
    for i in range(TRUE_STATES):
        point[u(i)] = base[u(i)] = x[u(i)]
    if first > 0:
        weight = h * floats[u(weights)]
        for i in range(TRUE_STATES):
            slope[u(i)] = rows[u(row_of(0, STATES) + i)]
            point[u(i)] = x[u(i)] + weight * slope[u(i)]
    own(Step(x, held, p, point, slope, base, rows, floats, nodes, weights, t, h, mode), first, last)
    if last > 0:
        for i in range(0, STATES, 4):
            put_states(trial, i, point, i)
    if last == STAGE_COUNT:
        errors = errors_at(nodes, STAGE_COUNT)
        combine_rows(rows, floats, errors, STATES, STAGE_COUNT)
        for i in range(TRUE_STATES):
            rows[u(BASE_AT + i)] = rows[u(BASE_AT + i)] + floats[u(errors + STAGE_COUNT)] * slope[u(i)]


def outputs(at: int, t: float, mode: int) -> None:
    """Write the plant's outputs at x."""
    places = integers_at(at)
    ints = integers_at(places[u(AT_INTS)])
    x, y = part_at(places[u(AT_X)], STATES), part_at(places[u(AT_Y)], ints[u(PLANT_OUTPUTS)])
    held, p = part_at(places[u(AT_HELD)], ints[u(PLANT_INPUTS)]), part_at(places[u(AT_P)], places[u(P_SIZE)])
    own(t, x, held, p, mode, y)


def look(at: int, which: int, t: float, mode: int) -> None:
    """Write the events' functions: at x (0), at the end of a step (1), in its middle (2)."""
    places = integers_at(at)
    ints = integers_at(places[u(AT_INTS)])
    x, g = part_at(places[u(AT_X + which)], STATES), part_at(places[u(AT_G + which)], ints[u(EVENTS)])
    held, p = part_at(places[u(AT_HELD)], ints[u(PLANT_INPUTS)]), part_at(places[u(AT_P)], places[u(P_SIZE)])
    own(t, x, held, p, mode, g)


FEW = 16
"""States that are so few that they may stay in registers."""

_CALLED = {
    "dynamics": (step, STEP),
    "outputs": (outputs, OUTPUTS),
    "events": (look, LOOK),
}


@lru_cache(maxsize=256)
def called(plant: PlantFunctions, part: str, shape: Shape) -> Entry:
    """Return what a run calls for `part` of a plant.

    It is the function above with the plant's own in the place of `own`, in
    globals of its own: what numba finds there is part of the code.
    """
    entry: Entry = getattr(plant, part)
    (function, parts), own = _CALLED[part], copied(entry.function)
    name = f"{function.__name__}_{shape.true}_{shape.states}"
    if part == "dynamics" and shape.states <= FEW:
        function, own = step_of_few, chain(own, shape)
        name = f"{function.__name__}_{shape.true}_{shape.states}_{shape.stages}_{shape.adaptive}"
    sizes = {"TRUE_STATES": shape.true, "STATES": shape.states, "STAGE_COUNT": shape.stages}
    made = FunctionType(function.__code__, {**function.__globals__, "own": own, **sizes}, function.__name__)
    made.__qualname__ = f"{name}_{plant.path.stem}_{entry.salt[:16]}"
    return Entry(made, signature(*parts), entry.salt)


def ready(plant: PlantFunctions, shape: Shape) -> tuple[Called, ...]:
    """Return the three compiled; InputFault for plant code that cannot be."""
    return tuple(_compiled(plant, part, shape) for part in ("dynamics", "outputs", "events"))


def _compiled(plant: PlantFunctions, part: str, shape: Shape) -> Called:
    try:
        return called(plant, part, shape).compile()
    except Exception:
        plant.compiled(part)  # what is wrong with it is said of it alone
        raise
