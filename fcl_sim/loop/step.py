"""One step of an explicit Runge-Kutta scheme, and the estimate of its error."""

from math import fabs, inf, isnan

from fcl_sim.jit import inlined, kernel, u
from fcl_sim.loop.layout import ADAPTIVE, RTOL, SCALES_AT, SCHEME_AT, STAGES, STATES, STEP_AT, TRUE_STATES
from fcl_sim.loop.work import MODE, ROWS_AT, Floats, Ints, row_of
from fcl_sim.plant.functions import PlantFunction

# States come in pieces of 4, written out: loops of constant length are what
# lets the compiler keep a piece in one register.


@inlined
def keep(dx: Floats, work: Floats, derivative: int, states: int) -> None:
    """Copy dx into the row of a derivative."""
    at = row_of(derivative, states)
    for i in range(0, states, 4):
        work[u(at + i)] = dx[u(i)]
        work[u(at + i + 1)] = dx[u(i + 1)]
        work[u(at + i + 2)] = dx[u(i + 2)]
        work[u(at + i + 3)] = dx[u(i + 3)]


@inlined
def shift(
    origin: Floats, origin_at: int, weight: float, dx: Floats, dx_at: int, point: Floats, states: int
) -> None:
    """Set point = origin + weight * dx, these two beginning at words of their buffers."""
    for i in range(0, states, 4):
        point[u(i)] = origin[u(origin_at + i)] + weight * dx[u(dx_at + i)]
        point[u(i + 1)] = origin[u(origin_at + i + 1)] + weight * dx[u(dx_at + i + 1)]
        point[u(i + 2)] = origin[u(origin_at + i + 2)] + weight * dx[u(dx_at + i + 2)]
        point[u(i + 3)] = origin[u(origin_at + i + 3)] + weight * dx[u(dx_at + i + 3)]


@inlined
def gather(x: Floats, h: float, floats: Floats, row: int, count: int, work: Floats, states: int) -> None:
    """Set base = x + h * (the first `count` derivatives, weighted by the row of the scheme)."""
    for i in range(0, states, 4):
        s0 = s1 = s2 = s3 = 0.0
        at = row_of(0, states) + i
        for j in range(count):
            weight = floats[u(row + j)]
            s0 += weight * work[u(at)]
            s1 += weight * work[u(at + 1)]
            s2 += weight * work[u(at + 2)]
            s3 += weight * work[u(at + 3)]
            at += states
        base = ROWS_AT + i
        work[u(base)] = x[u(i)] + h * s0
        work[u(base + 1)] = x[u(i + 1)] + h * s1
        work[u(base + 2)] = x[u(i + 2)] + h * s2
        work[u(base + 3)] = x[u(i + 3)] + h * s3


@inlined
def attempt(
    dynamics: PlantFunction,
    t: float,
    h: float,
    ints: Ints,
    floats: Floats,
    x: Floats,
    held: Floats,
    p: Floats,
    progress: Ints,
    work: Floats,
    dx: Floats,
    trial: Floats,
) -> None:
    """Fill `trial` with the solution a step h after x; the row of derivative 0 is that at x.

    For a scheme with step control dx and the row of the last derivative are
    left as the derivative at the solution.
    """
    stages = ints[u(STAGES)]
    states = ints[u(STATES)]
    nodes = ints[u(SCHEME_AT)]
    adaptive = ints[u(ADAPTIVE)] == 1
    row = nodes + stages + 1
    shift(x, 0, h * floats[u(row)], work, row_of(0, states), trial, states)
    for stage in range(1, stages + 1):
        row += stage
        if stage < stages:
            # All of the next point but the derivative to come: work that need not wait for it.
            gather(x, h, floats, row, stage, work, states)
        if stage < stages or adaptive:
            dynamics(t + floats[u(nodes + stage)] * h, trial, held, p, progress[u(MODE)], dx)
            keep(dx, work, stage, states)
        if stage < stages:
            shift(work, ROWS_AT, h * floats[u(row + stage)], dx, 0, trial, states)


@inlined
def error_of_state(
    i: int, h: float, ints: Ints, floats: Floats, x: Floats, trial: Floats, work: Floats
) -> float:
    """Return the error estimate of state i in a step, in units of the tolerance."""
    stages = ints[u(STAGES)]
    states = ints[u(STATES)]
    weights = ints[u(SCHEME_AT)] + (stages + 1) + stages * (stages + 1) // 2
    total = 0.0
    for j in range(stages + 1):
        total += floats[u(weights + j)] * work[u(row_of(j, states) + i)]
    size = floats[u(ints[u(SCALES_AT)] + i)] + max(fabs(x[u(i)]), fabs(trial[u(i)]))
    error: float = fabs(h * total) / (floats[u(ints[u(STEP_AT)] + RTOL)] * size)
    return error


@inlined
def error_of(h: float, ints: Ints, floats: Floats, x: Floats, trial: Floats, work: Floats) -> float:
    """Return the largest error estimate of a step in units of the tolerance, infinite where one is NaN."""
    worst = 0.0
    for i in range(ints[u(TRUE_STATES)]):
        error = error_of_state(i, h, ints, floats, x, trial, work)
        if not error <= worst:
            worst = inf if isnan(error) else error
    return worst


@kernel
def worst_state(h: float, ints: Ints, floats: Floats, x: Floats, trial: Floats, work: Floats) -> int:
    """Return the state with the largest error estimate of a step, one that is NaN before all."""
    worst, which = -1.0, 0
    for i in range(ints[u(TRUE_STATES)]):
        error = error_of_state(i, h, ints, floats, x, trial, work)
        if isnan(error):
            return i
        if error > worst:
            worst, which = error, i
    return which
