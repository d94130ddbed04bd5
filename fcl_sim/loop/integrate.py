"""Advance a plant between two writes: step control, events, modes.

A step is accepted when the largest error estimate, each relative to
rtol * (|x| + scale), is at most 1. An event that crossed zero in the step is
located on steps of the scheme itself, so it is as exact as the solution; the
step is cut there and restarted (`loop.events`).
"""

from math import ceil, inf

from fcl_sim.jit import inlined, u
from fcl_sim.loop.events import first_beyond, locate, rearm, settle
from fcl_sim.loop.layout import (
    ADAPTIVE,
    BLEW_UP,
    BUDGET_SPENT,
    EVENTS,
    EXPONENT,
    FINISHED,
    FIXED_STEP,
    STATES,
    STEP_AT,
    STEP_TOO_SMALL,
)
from fcl_sim.loop.step import attempt, error_of, keep, worst_state
from fcl_sim.loop.work import GUESS, HAPPENED, INDEX, MODE, STATUS, Floats, Ints, row_of
from fcl_sim.plant.functions import PlantFunction

MAX_STEPS = 1_000_000
"""Steps between two writes beyond which an integration is given up."""

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
def accepted(
    t: float,
    h: float,
    wanted: float,
    ints: Ints,
    floats: Floats,
    x: Floats,
    progress: Ints,
    work: Floats,
    dx: Floats,
    trial: Floats,
) -> bool:
    """Judge an attempted step and choose the next; return whether it is accepted.

    A step that vanishes is an end: `progress` says so, and of which state.
    """
    error = error_of(h, ints, floats, x, trial, work)
    work[u(GUESS)] = next_step(h, wanted, error, floats[u(ints[u(STEP_AT)] + EXPONENT)])
    if error <= 1.0:
        return True
    if t + work[u(GUESS)] == t:
        progress[u(STATUS)] = STEP_TOO_SMALL if error < inf else BLEW_UP
        progress[u(INDEX)] = worst_state(h, ints, floats, x, trial, work)
    at = row_of(0, ints[u(STATES)])
    for i in range(ints[u(STATES)]):
        dx[u(i)] = work[u(at + i)]
    return False


@inlined
def carry(ints: Ints, x: Floats, trial: Floats, g0: Floats, g1: Floats) -> None:
    """Make the end of a step the start of the next."""
    for i in range(0, ints[u(STATES)], 4):
        x[u(i)] = trial[u(i)]
        x[u(i + 1)] = trial[u(i + 1)]
        x[u(i + 2)] = trial[u(i + 2)]
        x[u(i + 3)] = trial[u(i + 3)]
    for i in range(ints[u(EVENTS)]):
        g0[u(i)] = g1[u(i)]


@inlined
def begin(
    dynamics: PlantFunction,
    events: PlantFunction,
    transition: PlantFunction,
    t: float,
    ints: Ints,
    x: Floats,
    held: Floats,
    p: Floats,
    progress: Ints,
    dx: Floats,
    g0: Floats,
) -> bool:
    """Take up the integration after a write: what the write set off happens first; return whether it ends."""
    progress[u(STATUS)] = FINISHED
    progress[u(HAPPENED)] = 0
    if ints[u(EVENTS)] > 0:
        events(t, x, held, p, progress[u(MODE)], g0)
        rearm(ints, g0, progress)
        event = first_beyond(ints, g0, progress)
        if event >= 0 and not settle(event, events, transition, t, ints, x, held, p, progress, g0):
            return False
    dynamics(t, x, held, p, progress[u(MODE)], dx)
    return True


@inlined
def advance(
    dynamics: PlantFunction,
    events: PlantFunction,
    transition: PlantFunction,
    t: float,
    length: float,
    ints: Ints,
    floats: Floats,
    x: Floats,
    held: Floats,
    p: Floats,
    progress: Ints,
    work: Floats,
    dx: Floats,
    trial: Floats,
    g0: Floats,
    g1: Floats,
) -> bool:
    """Advance x from t by `length` seconds, the inputs held; return whether it could.

    On failure `progress` says how and of what.
    """
    adaptive = ints[u(ADAPTIVE)] == 1
    if not begin(dynamics, events, transition, t, ints, x, held, p, progress, dx, g0):
        return False
    done = h = 0.0
    for _ in range(MAX_STEPS):
        keep(dx, work, 0, ints[u(STATES)])
        wanted = work[u(GUESS)] if adaptive else floats[u(ints[u(STEP_AT)] + FIXED_STEP)]
        pieces = max(1.0, ceil((length - done) / wanted - 1e-9))
        h = (length - done) / pieces
        attempt(dynamics, t + done, h, ints, floats, x, held, p, progress, work, dx, trial)
        if adaptive and not accepted(t + done, h, wanted, ints, floats, x, progress, work, dx, trial):
            if progress[u(STATUS)] != FINISHED:
                return False
            continue
        event, part = -1, 1.0
        if ints[u(EVENTS)] > 0:
            events(t + done + h, trial, held, p, progress[u(MODE)], g1)
            event = first_beyond(ints, g1, progress)
            if event >= 0:
                part, event = locate(
                    event, dynamics, events, t + done, h,
                    ints, floats, x, held, p, progress, work, dx, trial, g0, g1,
                )  # fmt: skip
            rearm(ints, g1, progress)
        carry(ints, x, trial, g0, g1)
        done = length if pieces == 1.0 and part == 1.0 else done + part * h
        if event >= 0 and not settle(event, events, transition, t + done, ints, x, held, p, progress, g0):
            return False
        if done >= length:
            return True
        if event >= 0 or not adaptive:
            dynamics(t + done, x, held, p, progress[u(MODE)], dx)
    progress[u(STATUS)] = BUDGET_SPENT
    progress[u(INDEX)] = worst_state(h, ints, floats, x, trial, work)
    return False
