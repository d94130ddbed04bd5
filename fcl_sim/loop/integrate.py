"""Advance a plant between two writes: step control, events, modes.

A step is accepted when the largest error estimate, each relative to
rtol * (|x| + scale), is at most 1. An event that crossed zero in the step is
located on steps of the scheme itself, so it is as exact as the solution; the
step is cut there and restarted (`loop.events`).
"""

from math import ceil, inf

from fcl_sim.jit import inlined, u
from fcl_sim.loop.events import AT_BEGINNING, AT_END, cut_short, locate, look, rearm, settle, within
from fcl_sim.loop.layout import (
    ADAPTIVE,
    BLEW_UP,
    BUDGET_SPENT,
    EVENTS,
    EXPONENT,
    FINISHED,
    FIXED_STEP,
    RUN_BUDGET_SPENT,
    STEP_AT,
    STEP_TOO_SMALL,
)
from fcl_sim.loop.step import attempt, carry_derivative, carry_states, derive, error_of, worst_state
from fcl_sim.loop.work import GUESS, INDEX, STATUS, STEPS, Plant, Work

MAX_STEPS = 1_000_000
"""Steps between two writes beyond which an integration is given up."""
MAX_STEPS_OF_RUN = 1_000_000_000
"""Steps beyond which a run is."""

SAFETY, SHRINK, GROW = 0.9, 0.2, 5.0
NO_POWER_BELOW = (SAFETY / GROW) ** 5
"""Errors below this grow the step by GROW whatever the order (at most 5): no power needs computing."""


@inlined
def next_step(h: float, wanted: float, error: float, exponent: float) -> float:
    """Return the step to try after one of length h, of which `wanted` was the wish, with this error."""
    if error < NO_POWER_BELOW:
        return max(wanted, h * GROW)
    factor: float = max(SHRINK, SAFETY * error**exponent) if error < inf else SHRINK
    return h * factor


@inlined
def accepted(work: Work, t: float, h: float, wanted: float) -> bool:
    """Judge an attempted step and choose the next; return whether it is accepted.

    A step that vanishes is an end: `progress` says so, and of which state.
    """
    ints, rows = work.ints, work.rows
    error = error_of(work, h)
    rows[u(GUESS)] = next_step(h, wanted, error, work.floats[u(ints[u(STEP_AT)] + EXPONENT)])
    if error <= 1.0:
        return True
    if t + rows[u(GUESS)] == t:
        work.progress[u(STATUS)] = STEP_TOO_SMALL if error < inf else BLEW_UP
        work.progress[u(INDEX)] = worst_state(work, h)
    return False


@inlined
def carry(work: Work) -> None:
    """Make the end of a step the start of the next."""
    carry_states(work)
    for i in range(work.ints[u(EVENTS)]):
        work.g0[u(i)] = work.g1[u(i)]


@inlined
def begin(plant: Plant, work: Work, t: float) -> bool:
    """Take up the integration after a write: what the write set off happens first; return whether it ends."""
    progress = work.progress
    progress[u(STATUS)] = FINISHED
    if work.ints[u(EVENTS)] > 0:
        event = look(plant, work, t, AT_BEGINNING)
        rearm(work.ints, work.g0, progress)
        if event >= 0 and not settle(plant, work, t, event):
            return False
    if work.ints[u(ADAPTIVE)] == 1:
        derive(plant, work, t)
    return True


@inlined
def afforded(work: Work, steps: int, h: float) -> bool:
    """Count the steps between two writes, of which the last was h long; return whether the run may go on."""
    progress = work.progress
    progress[u(STEPS)] += steps
    if progress[u(STEPS)] <= MAX_STEPS_OF_RUN:
        return True
    progress[u(STATUS)] = RUN_BUDGET_SPENT
    progress[u(INDEX)] = worst_state(work, h)
    return False


@inlined
def advance(plant: Plant, work: Work, t: float, length: float) -> bool:
    """Advance x from t by `length` seconds, the inputs held; return whether it could.

    On failure `progress` says how and of what.
    """
    ints, progress = work.ints, work.progress
    adaptive = ints[u(ADAPTIVE)] == 1
    if not begin(plant, work, t):
        return False
    done = h = 0.0
    goes_on = False
    for step in range(MAX_STEPS):
        if goes_on:
            carry_derivative(work)
            goes_on = False
        wanted = work.rows[u(GUESS)] if adaptive else work.floats[u(ints[u(STEP_AT)] + FIXED_STEP)]
        h = length - done
        pieces = max(1.0, ceil(h / wanted - 1e-9)) if h > wanted else 1.0
        if pieces > 1.0:
            h /= pieces
        attempt(plant, work, t + done, h)
        if adaptive and not accepted(work, t + done, h, wanted):
            if progress[u(STATUS)] != FINISHED:
                return False
            continue
        event, part = -1, 1.0
        if ints[u(EVENTS)] > 0:
            event = look(plant, work, t + done + h, AT_END)
            part = within(plant, work, t + done, h) if adaptive else 1.0
            if part < 1.0:
                part, event = cut_short(plant, work, t + done, h, part, event)
            if event >= 0:
                cut, event = locate(plant, work, t + done, part * h, event)
                part *= cut
            rearm(ints, work.g1, progress)
        carry(work)
        done = length if pieces == 1.0 and part == 1.0 else done + part * h
        if event >= 0 and not settle(plant, work, t + done, event):
            return False
        if done >= length:
            return afforded(work, step + 1, h)
        if adaptive and event >= 0:
            derive(plant, work, t + done)
        goes_on = adaptive and event < 0
    progress[u(STATUS)] = BUDGET_SPENT
    progress[u(INDEX)] = worst_state(work, h)
    return False
