"""One step of an explicit Runge-Kutta scheme, and the estimate of its error."""

from math import fabs, inf, isnan

from fcl_sim.jit import copy_four, flat, inlined, u
from fcl_sim.loop.layout import ADAPTIVE, RTOL, SCALES_AT, SCHEME_AT, STAGES, STATES, STEP_AT, TRUE_STATES
from fcl_sim.loop.work import BASE_AT, MODE, Plant, Work, errors_at, row_of

# States come in pieces of 4, written out, and how many there are is looked up
# at each turn: of a loop whose length is known beforehand the compiler makes one
# for long vectors, and asks before each whether any two of its arrays overlap.


@inlined
def derive(plant: Plant, work: Work, t: float) -> None:
    """Let the plant write the derivative at x into its row."""
    plant.step(work.at, t, 0.0, 0, 0, work.progress[u(MODE)])


@inlined
def carry_states(work: Work) -> None:
    """Copy `trial` to x."""
    x, trial = work.x, work.trial
    i = 0
    while i < work.ints[u(STATES)]:
        x[u(i)] = trial[u(i)]
        x[u(i + 1)] = trial[u(i + 1)]
        x[u(i + 2)] = trial[u(i + 2)]
        x[u(i + 3)] = trial[u(i + 3)]
        i += 4


@inlined
def carry_derivative(work: Work) -> None:
    """Make the derivative at the solution that at x."""
    ints = work.ints
    first, last = row_of(0, ints[u(STATES)]), row_of(ints[u(STAGES)], ints[u(STATES)])
    i = 0
    while i < ints[u(STATES)]:
        copy_four(work.rows, u(first + i), work.rows, u(last + i))
        i += 4


@inlined
def attempt(plant: Plant, work: Work, t: float, h: float) -> None:
    """Fill `trial` with the solution a step h after x.

    For a scheme with step control, the row of derivative 0 is that at x, and
    the row of the last is left as that at the solution.
    """
    stages, mode = work.ints[u(STAGES)], work.progress[u(MODE)]
    if work.ints[u(ADAPTIVE)] == 1:
        plant.step(work.at, t, h, 1, stages, mode)
    else:
        plant.step(work.at, t, h, 0, stages - 1, mode)


@flat
def error_of_state(work: Work, h: float, i: int) -> float:
    """Return the error estimate of state i in a step, in units of the tolerance."""
    ints, floats = work.ints, work.floats
    stages = ints[u(STAGES)]
    states = ints[u(STATES)]
    weights = errors_at(ints[u(SCHEME_AT)], stages)
    total = 0.0
    for j in range(stages + 1):
        total += floats[u(weights + j)] * work.rows[u(row_of(j, states) + i)]
    size = floats[u(ints[u(SCALES_AT)] + i)] + max(fabs(work.x[u(i)]), fabs(work.trial[u(i)]))
    error: float = fabs(h * total) / (floats[u(ints[u(STEP_AT)] + RTOL)] * size)
    return error


@inlined
def error_of(work: Work, h: float) -> float:
    """Return the largest error estimate of a step in units of the tolerance, infinite where one is NaN.

    The step has left the weighted sums of its derivatives in the base.
    """
    ints, floats, x, trial, rows = work.ints, work.floats, work.x, work.trial, work.rows
    scales, rtol = ints[u(SCALES_AT)], floats[u(ints[u(STEP_AT)] + RTOL)]
    worst = 0.0
    for state in range(ints[u(TRUE_STATES)]):
        size = floats[u(scales + state)] + max(fabs(x[u(state)]), fabs(trial[u(state)]))
        worst = greater(worst, fabs(h * rows[u(BASE_AT + state)]) / (rtol * size))
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
