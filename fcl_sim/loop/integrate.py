"""Advance a plant between two writes: step control, events, modes.

A step is accepted when the largest error estimate, each relative to
rtol * (|x| + scale), is at most 1. An event that crossed zero in the step is
located on steps of the scheme itself, so it is as exact as the solution; the
step is cut there and restarted. An event that has fired is armed again after
leaving zero.
"""

from math import ceil

import numpy as np

from fcl_sim.jit import inlined, kernel, u
from fcl_sim.loop.layout import (
    ADAPTIVE,
    BLEW_UP,
    BUDGET_SPENT,
    CHATTERS,
    DIRECTIONS_AT,
    EVENTS,
    EXPONENT,
    FINISHED,
    FIXED_STEP,
    STATES,
    STEP_AT,
    STEP_TOO_SMALL,
)
from fcl_sim.loop.step import attempt, error_of, keep, worst_state

MODE, ARMED, STATUS, INDEX, HAPPENED, PROGRESS = range(6)
"""Words of the integer state of an integration, and their number.

Mode; a bit per event, set while it is armed; how the integration ended and of
what; events since the last write.
"""

STEP_GUESS = 0
"""Word of the float state of an integration: the step to try next, s."""

MAX_EVENTS = 1_000
"""Events between two writes beyond which a plant chatters."""
MOST_EVENTS = 62
"""Events that a plant can declare: bits of a word."""
MAX_STEPS = 1_000_000
"""Steps between two writes beyond which an integration is given up."""

SAFETY, SHRINK, GROW = 0.9, 0.2, 5.0
NO_POWER_BELOW = (SAFETY / GROW) ** 5
"""Errors below this grow the step by GROW whatever the order (at most 5): no power needs computing."""
RESOLUTION = 1e-13
"""To what part of a step an event is located."""


@inlined
def rearm(ints, g, armed):
    """Return the armed events, with those whose function has left zero against their direction."""
    directions = ints[u(DIRECTIONS_AT)]
    for i in range(ints[u(EVENTS)]):
        if g[u(i)] * ints[u(directions + i)] < 0.0:
            armed |= 1 << i
    return armed


@inlined
def first_beyond(ints, g, armed):
    """Return the first armed event that stands beyond zero in its direction, -1 where there is none."""
    directions = ints[u(DIRECTIONS_AT)]
    for i in range(ints[u(EVENTS)]):
        if g[u(i)] * ints[u(directions + i)] > 0.0 and (armed >> i) & 1:
            return i
    return -1


@kernel
def settle(event, transition, events, t, x, held, p, ints, g, progress):
    """Let `event` happen (-1: none), then every armed event that stands beyond zero; return whether it ends.

    A transition may set x and give a new mode, in which the events' functions are taken anew.
    """
    while event >= 0:
        progress[u(MODE)] = transition(event, t, x, held, p, progress[u(MODE)])
        events(t, x, held, p, progress[u(MODE)], g)
        progress[u(ARMED)] = rearm(ints, g, progress[u(ARMED)] & ~(1 << event))
        progress[u(HAPPENED)] += 1
        if progress[u(HAPPENED)] > MAX_EVENTS:
            progress[u(STATUS)] = CHATTERS
            progress[u(INDEX)] = event
            return False
        event = first_beyond(ints, g, progress[u(ARMED)])
    return True


@kernel
def locate(which, dynamics, events, t, h, x, held, p, ints, floats, k, dx, base, trial, g0, g1, progress):
    """Return the part of the step h at whose end event `which` has just crossed zero, and that event.

    On entry `trial` and g1 belong to the whole step, on return to that part of
    it. Regula falsi after Illinois on the interval (0, 1) of the step; its end
    beyond zero is returned. An event found to be earlier takes the place of `which`.
    """
    direction = ints[u(ints[u(DIRECTIONS_AT)] + which)]
    low, high, part = 0.0, 1.0, 1.0
    g_low, g_high = g0[u(which)], g1[u(which)]
    side = 0
    while high - low > RESOLUTION or part != high:
        if high - low > RESOLUTION:
            part = (low * g_high - high * g_low) / (g_high - g_low)
            if not low < part < high:
                part = 0.5 * (low + high)
        else:
            part = high
        attempt(dynamics, t, part * h, x, held, p, progress[u(MODE)], ints, floats, k, dx, base, trial)
        events(t + part * h, trial, held, p, progress[u(MODE)], g1)
        earlier = first_beyond(ints, g1, progress[u(ARMED)])
        if earlier >= 0 and earlier != which:
            which, low, high, side = earlier, 0.0, part, 0
            direction = ints[u(ints[u(DIRECTIONS_AT)] + which)]
            g_low, g_high = g0[u(which)], g1[u(which)]
        elif g1[u(which)] * direction >= 0.0:
            low = part if g1[u(which)] == 0.0 else low
            high, g_high = part, g1[u(which)]
            g_low = 0.5 * g_low if side == 1 else g_low
            side = 1
        else:
            low, g_low = part, g1[u(which)]
            g_high = 0.5 * g_high if side == -1 else g_high
            side = -1
    return high, which


@inlined
def next_step(h, wanted, error, exponent, guess):
    """Choose the step after one of length h with this error; return whether that one is accepted."""
    if error <= 1.0:
        growth = GROW if error < NO_POWER_BELOW else SAFETY * error**exponent
        guess[u(STEP_GUESS)] = h * growth if growth < GROW else max(wanted, h * GROW)
        return True
    shrinkage = max(SHRINK, SAFETY * error**exponent) if error < np.inf else SHRINK
    guess[u(STEP_GUESS)] = h * shrinkage
    return False


@inlined
def carry(trial, x, g1, g0, ints):
    """Make the end of a step the start of the next."""
    for i in range(0, ints[u(STATES)], 4):
        x[u(i)] = trial[u(i)]
        x[u(i + 1)] = trial[u(i + 1)]
        x[u(i + 2)] = trial[u(i + 2)]
        x[u(i + 3)] = trial[u(i + 3)]
    for i in range(ints[u(EVENTS)]):
        g0[u(i)] = g1[u(i)]


@inlined
def advance(
    dynamics, events, transition, t, length, x, held, p, ints, floats, guess, progress, k, dx, base, trial, g0, g1
):
    """Advance x from t by `length` seconds, the inputs held; return whether it could.

    On failure `progress` says how and of what. Work arrays: k ((stages + 1) *
    states,), dx, base and trial (states,), g0 and g1 (events,).
    """
    adaptive = ints[u(ADAPTIVE)] == 1
    steps = ints[u(STEP_AT)]
    progress[u(STATUS)] = FINISHED
    progress[u(HAPPENED)] = 0
    if ints[u(EVENTS)] > 0:
        events(t, x, held, p, progress[u(MODE)], g0)
        progress[u(ARMED)] = rearm(ints, g0, progress[u(ARMED)])
        event = first_beyond(ints, g0, progress[u(ARMED)])
        if event >= 0 and not settle(event, transition, events, t, x, held, p, ints, g0, progress):
            return False
    dynamics(t, x, held, p, progress[u(MODE)], dx)
    done = 0.0
    for _ in range(MAX_STEPS):
        keep(dx, k, 0, ints[u(STATES)])
        wanted = guess[u(STEP_GUESS)] if adaptive else floats[u(steps + FIXED_STEP)]
        pieces = max(1.0, ceil((length - done) / wanted - 1e-9))
        h = (length - done) / pieces
        attempt(dynamics, t + done, h, x, held, p, progress[u(MODE)], ints, floats, k, dx, base, trial)
        if adaptive:
            error = error_of(h, x, ints, floats, k, trial)
            if not next_step(h, wanted, error, floats[u(steps + EXPONENT)], guess):
                if t + done + guess[u(STEP_GUESS)] == t + done:
                    progress[u(STATUS)] = STEP_TOO_SMALL if error < np.inf else BLEW_UP
                    progress[u(INDEX)] = worst_state(h, x, ints, floats, k, trial)
                    return False
                for i in range(ints[u(STATES)]):
                    dx[u(i)] = k[u(i)]
                continue
        event = -1
        part = 1.0
        if ints[u(EVENTS)] > 0:
            events(t + done + h, trial, held, p, progress[u(MODE)], g1)
            event = first_beyond(ints, g1, progress[u(ARMED)])
            if event >= 0:
                part, event = locate(
                    event, dynamics, events, t + done, h, x, held, p,
                    ints, floats, k, dx, base, trial, g0, g1, progress,
                )  # fmt: skip
            progress[u(ARMED)] = rearm(ints, g1, progress[u(ARMED)])
        carry(trial, x, g1, g0, ints)
        if pieces == 1.0 and part == 1.0:
            done = length
        else:
            done += part * h
        if event >= 0 and not settle(event, transition, events, t + done, x, held, p, ints, g0, progress):
            return False
        if done >= length:
            return True
        if event >= 0 or not adaptive:
            dynamics(t + done, x, held, p, progress[u(MODE)], dx)
    progress[u(STATUS)] = BUDGET_SPENT
    progress[u(INDEX)] = worst_state(h, x, ints, floats, k, trial)
    return False
