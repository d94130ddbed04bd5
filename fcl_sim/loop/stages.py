"""The stages of a step of a plant with few states, each in code of its own.

There the number of the stage is known, so that its sums have no loop, and the
point and the derivative stay in registers: each stage waits for the one
before, and would wait for memory twice.
"""

from typing import Any, NamedTuple

from fcl_sim.jit import combine_four, copied, inlined, put_four, u
from fcl_sim.loop.work import BASE_AT, Floats, row_of


class Shape(NamedTuple):
    """What is known of a run when its plant's functions are compiled.

    The number of states, without padding and with it; that of the scheme's
    stages, and whether it controls its step.
    """

    true: int
    states: int
    stages: int
    adaptive: bool


class Step(NamedTuple):
    """What the stages of one step share: the plant's arrays, the scheme, where the step begins.

    `point` (states,) is where the next derivative is taken, `slope` (states,)
    the newest, `base` (states,) the next point but for that; they are in
    registers. `weights` is where in `floats` the rows of the scheme begin,
    `nodes` where its nodes do.
    """

    x: Floats
    held: Floats
    p: Floats
    point: Floats
    slope: Floats
    base: Floats
    rows: Floats
    floats: Floats
    nodes: int
    weights: int
    t: float
    h: float
    mode: int


@inlined
def put_states(target: Floats, at: int, numbers: Floats, i: int) -> None:
    """Set four numbers of a buffer at once to those of another, from i on."""
    put_four(target, u(at), numbers[u(i)], numbers[u(i + 1)], numbers[u(i + 2)], numbers[u(i + 3)])


@inlined
def combine_rows(rows: Floats, floats: Floats, weights: int, states: int, count: int) -> None:
    """Set the base to the sum of the first `count` derivatives, each times its weight."""
    for i in range(0, states, 4):
        start = u(row_of(0, states) + i)
        combine_four(rows, u(BASE_AT + i), floats, u(weights), rows, start, u(states), u(count))


def nothing(step: Step, first: int, last: int) -> None:
    """Stand before the first stage."""


def chain(own: Any, shape: Shape) -> Any:
    """Return a kernel that goes through the stages of a scheme, `first` to `last`; see `called.step`.

    `own` is the plant's function, copied in at each. With step control the last
    derivative is that at the solution.
    """
    true, states, stages, _ = shape

    @copied
    def take(step: Step, stage: int, last: int) -> None:
        x, held, p, point, slope, base, rows, floats, nodes, weights, t, h, mode = step
        row = weights + stage * (stage + 1) // 2
        if 0 < stage < stages:
            # All of the next point but the derivative to come: work that need not wait for it. The one
            # before is still in the registers, and may not have reached memory.
            combine_rows(rows, floats, row, states, stage - 1)
            for i in range(true):
                total = rows[u(BASE_AT + i)] + floats[u(row + stage - 1)] * slope[u(i)]
                base[u(i)] = x[u(i)] + h * total
        own(t + floats[u(nodes + stage)] * h, point, held, p, mode, slope)
        for i in range(0, states, 4):
            put_states(rows, row_of(stage, states) + i, slope, i)
        if stage < stages and last > 0:
            weight = h * floats[u(row + stage)]
            for i in range(true):
                point[u(i)] = base[u(i)] + weight * slope[u(i)]

    taken = copied(nothing)
    for stage in range(shape.stages + shape.adaptive):
        taken = _behind(taken, take, stage)
    return taken


def _behind(before: Any, take: Any, stage: int) -> Any:
    """Return `before` and one stage more, whose number is a constant once `take` is copied in."""

    @copied
    def behind(step: Step, first: int, last: int) -> None:
        before(step, first, last)
        if first <= stage <= last:
            take(step, stage, last)

    return behind
