"""One step of an explicit Runge-Kutta scheme, and the estimate of its error."""

from math import fabs, inf, isnan

from fcl_sim.jit import flat, inlined, u
from fcl_sim.loop.layout import ADAPTIVE, RTOL, SCALES_AT, SCHEME_AT, STAGES, STATES, STEP_AT, TRUE_STATES
from fcl_sim.loop.work import BASE_AT, MODE, Floats, Plant, Work, row_of

# States come in pieces of 4, written out, and how many there are is looked up
# at each turn: of a loop whose length is known beforehand the compiler makes one
# for long vectors, and asks before each whether any two of its arrays overlap.


@inlined
def keep(work: Work, states: int, derivative: int) -> None:
    """Copy dx into the row of a derivative."""
    dx, rows = work.dx, work.rows
    at = row_of(derivative, states)
    i = 0
    while i < work.ints[u(STATES)]:
        rows[u(at + i)] = dx[u(i)]
        rows[u(at + i + 1)] = dx[u(i + 1)]
        rows[u(at + i + 2)] = dx[u(i + 2)]
        rows[u(at + i + 3)] = dx[u(i + 3)]
        i += 4


@inlined
def shift(work: Work, origin: Floats, origin_at: int, weight: float, dx: Floats, dx_at: int) -> None:
    """Set trial = origin + weight * dx, these two beginning at words of their buffers."""
    trial = work.trial
    i = 0
    while i < work.ints[u(STATES)]:
        trial[u(i)] = origin[u(origin_at + i)] + weight * dx[u(dx_at + i)]
        trial[u(i + 1)] = origin[u(origin_at + i + 1)] + weight * dx[u(dx_at + i + 1)]
        trial[u(i + 2)] = origin[u(origin_at + i + 2)] + weight * dx[u(dx_at + i + 2)]
        trial[u(i + 3)] = origin[u(origin_at + i + 3)] + weight * dx[u(dx_at + i + 3)]
        i += 4


@inlined
def gather(work: Work, states: int, h: float, row: int, count: int) -> None:
    """Set base = x + h * (the first `count` derivatives, weighted by the row of the scheme)."""
    floats, x, rows = work.floats, work.x, work.rows
    i = 0
    while i < work.ints[u(STATES)]:
        s0 = s1 = s2 = s3 = 0.0
        at = row_of(0, states) + i
        for j in range(count):
            weight = floats[u(row + j)]
            s0 += weight * rows[u(at)]
            s1 += weight * rows[u(at + 1)]
            s2 += weight * rows[u(at + 2)]
            s3 += weight * rows[u(at + 3)]
            at += states
        base = BASE_AT + i
        rows[u(base)] = x[u(i)] + h * s0
        rows[u(base + 1)] = x[u(i + 1)] + h * s1
        rows[u(base + 2)] = x[u(i + 2)] + h * s2
        rows[u(base + 3)] = x[u(i + 3)] + h * s3
        i += 4


@inlined
def attempt(plant: Plant, work: Work, t: float, h: float) -> None:
    """Fill `trial` with the solution a step h after x; the row of derivative 0 is that at x.

    For a scheme with step control dx and the row of the last derivative are
    left as the derivative at the solution.
    """
    ints, floats = work.ints, work.floats
    stages, states = ints[u(STAGES)], ints[u(STATES)]
    nodes = ints[u(SCHEME_AT)]
    adaptive = ints[u(ADAPTIVE)] == 1
    row = nodes + stages + 1
    shift(work, work.x, 0, h * floats[u(row)], work.rows, row_of(0, states))
    for stage in range(1, stages + 1):
        row += stage
        if stage < stages:
            # All of the next point but the derivative to come: work that need not wait for it.
            gather(work, states, h, row, stage)
        if stage < stages or adaptive:
            at = t + floats[u(nodes + stage)] * h
            plant.dynamics(at, work.trial, work.held, work.p, work.progress[u(MODE)], work.dx)
            keep(work, states, stage)
        if stage < stages:
            shift(work, work.rows, BASE_AT, h * floats[u(row + stage)], work.dx, 0)


@flat
def error_of_state(work: Work, h: float, i: int) -> float:
    """Return the error estimate of state i in a step, in units of the tolerance."""
    ints, floats = work.ints, work.floats
    stages = ints[u(STAGES)]
    states = ints[u(STATES)]
    weights = ints[u(SCHEME_AT)] + (stages + 1) + stages * (stages + 1) // 2
    total = 0.0
    for j in range(stages + 1):
        total += floats[u(weights + j)] * work.rows[u(row_of(j, states) + i)]
    size = floats[u(ints[u(SCALES_AT)] + i)] + max(fabs(work.x[u(i)]), fabs(work.trial[u(i)]))
    error: float = fabs(h * total) / (floats[u(ints[u(STEP_AT)] + RTOL)] * size)
    return error


@inlined
def error_of(work: Work, h: float) -> float:
    """Return the largest error estimate of a step in units of the tolerance, infinite where one is NaN."""
    ints, floats, x, trial, rows = work.ints, work.floats, work.x, work.trial, work.rows
    stages, states, scales = ints[u(STAGES)], ints[u(STATES)], ints[u(SCALES_AT)]
    weights = ints[u(SCHEME_AT)] + (stages + 1) + stages * (stages + 1) // 2
    rtol = floats[u(ints[u(STEP_AT)] + RTOL)]
    worst = 0.0
    i = 0
    while i < work.ints[u(STATES)]:
        e0 = e1 = e2 = e3 = 0.0
        at = row_of(0, states) + i
        for j in range(stages + 1):
            weight = floats[u(weights + j)]
            e0 += weight * rows[u(at)]
            e1 += weight * rows[u(at + 1)]
            e2 += weight * rows[u(at + 2)]
            e3 += weight * rows[u(at + 3)]
            at += states
        s = scales + i
        e0 = fabs(h * e0) / (rtol * (floats[u(s)] + max(fabs(x[u(i)]), fabs(trial[u(i)]))))
        e1 = fabs(h * e1) / (rtol * (floats[u(s + 1)] + max(fabs(x[u(i + 1)]), fabs(trial[u(i + 1)]))))
        e2 = fabs(h * e2) / (rtol * (floats[u(s + 2)] + max(fabs(x[u(i + 2)]), fabs(trial[u(i + 2)]))))
        e3 = fabs(h * e3) / (rtol * (floats[u(s + 3)] + max(fabs(x[u(i + 3)]), fabs(trial[u(i + 3)]))))
        worst = greater(greater(worst, e0), greater(e1, greater(e2, e3)))
        i += 4
    return inf if isnan(worst) else worst


@inlined
def greater(one: float, other: float) -> float:
    """Return the greater of two numbers, NaN where one of them is."""
    return one if one > other or isnan(one) else other


@flat
def worst_state(work: Work, h: float) -> int:
    """Return the state with the largest error estimate of a step, one that is NaN before all."""
    worst, which = -1.0, 0
    for i in range(work.ints[u(TRUE_STATES)]):
        error = error_of_state(work, h, i)
        if isnan(error):
            return i
        if error > worst:
            worst, which = error, i
    return which
