"""One step of an explicit Runge-Kutta scheme, and the estimate of its error."""

from math import fabs

from fcl_sim.jit import inlined, kernel, u
from fcl_sim.loop.layout import ADAPTIVE, RTOL, SCALES_AT, SCHEME_AT, STAGES, STATES, STEP_AT, TRUE_STATES

# States come in pieces of 4, written out: loops of constant length are what
# lets the compiler keep a piece in one register.


@inlined
def keep(dx, k, stage, states):
    """Copy the derivative dx into row `stage` of k, a flat table of rows of `states` numbers."""
    at = stage * states
    for i in range(0, states, 4):
        k[u(at + i)] = dx[u(i)]
        k[u(at + i + 1)] = dx[u(i + 1)]
        k[u(at + i + 2)] = dx[u(i + 2)]
        k[u(at + i + 3)] = dx[u(i + 3)]


@inlined
def shift(origin, weight, dx, at, point, states):
    """Set point = origin + weight * dx, dx beginning at word `at` of its buffer."""
    for i in range(0, states, 4):
        point[u(i)] = origin[u(i)] + weight * dx[u(at + i)]
        point[u(i + 1)] = origin[u(i + 1)] + weight * dx[u(at + i + 1)]
        point[u(i + 2)] = origin[u(i + 2)] + weight * dx[u(at + i + 2)]
        point[u(i + 3)] = origin[u(i + 3)] + weight * dx[u(at + i + 3)]


@inlined
def gather(x, h, floats, row, count, k, base, states):
    """Set base = x + h * (the first `count` derivatives of k, weighted by the row of the scheme)."""
    for i in range(0, states, 4):
        s0 = s1 = s2 = s3 = 0.0
        at = i
        for j in range(count):
            weight = floats[u(row + j)]
            s0 += weight * k[u(at)]
            s1 += weight * k[u(at + 1)]
            s2 += weight * k[u(at + 2)]
            s3 += weight * k[u(at + 3)]
            at += states
        base[u(i)] = x[u(i)] + h * s0
        base[u(i + 1)] = x[u(i + 1)] + h * s1
        base[u(i + 2)] = x[u(i + 2)] + h * s2
        base[u(i + 3)] = x[u(i + 3)] + h * s3


@inlined
def attempt(dynamics, t, h, x, held, p, mode, ints, floats, k, dx, base, trial):
    """Fill `trial` with the solution a step h after x; row 0 of k is the derivative at x.

    For a scheme with step control dx and the last row of k are left as the
    derivative at the solution. k (stages + 1 rows of states), dx, base, trial, x (states,).
    """
    stages = ints[u(STAGES)]
    states = ints[u(STATES)]
    nodes = ints[u(SCHEME_AT)]
    adaptive = ints[u(ADAPTIVE)] == 1
    row = nodes + stages + 1
    shift(x, h * floats[u(row)], k, 0, trial, states)
    for stage in range(1, stages + 1):
        row += stage
        if stage < stages:
            # All of the next point but the derivative to come: work that need not wait for it.
            gather(x, h, floats, row, stage, k, base, states)
        if stage < stages or adaptive:
            dynamics(t + floats[u(nodes + stage)] * h, trial, held, p, mode, dx)
            keep(dx, k, stage, states)
        if stage < stages:
            shift(base, h * floats[u(row + stage)], dx, 0, trial, states)


@inlined
def error_of_state(i, h, x, ints, floats, k, trial):
    """Return the error estimate of state i in a step, in units of the tolerance."""
    stages = ints[u(STAGES)]
    states = ints[u(STATES)]
    weights = ints[u(SCHEME_AT)] + (stages + 1) + stages * (stages + 1) // 2
    total = 0.0
    for j in range(stages + 1):
        total += floats[u(weights + j)] * k[u(j * states + i)]
    size = floats[u(ints[u(SCALES_AT)] + i)] + max(fabs(x[u(i)]), fabs(trial[u(i)]))
    return fabs(h * total) / (floats[u(ints[u(STEP_AT)] + RTOL)] * size)


@inlined
def error_of(h, x, ints, floats, k, trial):
    """Return the largest error estimate of a step in units of the tolerance, NaN where one is NaN."""
    worst = 0.0
    for i in range(ints[u(TRUE_STATES)]):
        error = error_of_state(i, h, x, ints, floats, k, trial)
        if not error <= worst:
            worst = error
        if worst != worst:
            break
    return worst


@kernel
def worst_state(h, x, ints, floats, k, trial):
    """Return the state with the largest error estimate of a step, one that is NaN before all."""
    worst, which = -1.0, 0
    for i in range(ints[u(TRUE_STATES)]):
        error = error_of_state(i, h, x, ints, floats, k, trial)
        if error != error:
            return i
        if error > worst:
            worst, which = error, i
    return which
