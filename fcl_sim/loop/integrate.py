"""Advance a plant between two writes: step control, events, modes.

One step is a walk through the scheme's table; the step is accepted when the
largest error estimate, each relative to rtol * (|x| + scale), is at most 1. An
event that crossed zero in the step is located by the method of Illinois on
steps of the scheme itself, so it is as exact as the solution; the step is cut
there and restarted. An event that has fired is armed again after leaving zero.
"""

from math import ceil, fabs

import numpy as np

from fcl_sim.jit import kernel
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
    RTOL,
    SCALES_AT,
    SCHEME_AT,
    STAGES,
    STATES,
    STEP_AT,
    STEP_TOO_SMALL,
    TRUE_STATES,
)

MODE, STATUS, INDEX, BUDGET, HAPPENED, ARMED = 0, 1, 2, 3, 4, 5
"""Words of the integer state of an integration.

Mode; how it ended and of what; steps left and events happened since the last
write; then one word per event: 1 while it is armed.
"""

STEP_GUESS = 0
"""Word of the float state of an integration: the step to try next, s."""

MAX_STEPS = 1_000_000
MAX_EVENTS = 1_000
SAFETY, SHRINK, GROW = 0.9, 0.2, 5.0
NO_POWER_BELOW = (SAFETY / GROW) ** 5
"""Errors below this grow the step by GROW whatever the order (at most 5): no power needs computing."""


@kernel
def attempt(dynamics, t, h, x, u, p, mode, ints, floats, k, trial):
    """Fill `trial` with the solution a step h after x, k[0] being the derivative at x.

    For a scheme with step control the derivative at the solution is left in
    the last row of k. k (stages + 1, states), trial and x (states,).
    """
    stages = ints[STAGES]
    states = ints[STATES]
    nodes = ints[SCHEME_AT]
    row = nodes + stages + 1
    for stage in range(1, stages + 1):
        for i in range(0, states, 4):
            s0 = s1 = s2 = s3 = 0.0
            for j in range(stage):
                weight = floats[row + j]
                s0 += weight * k[j, i]
                s1 += weight * k[j, i + 1]
                s2 += weight * k[j, i + 2]
                s3 += weight * k[j, i + 3]
            trial[i] = x[i] + h * s0
            trial[i + 1] = x[i + 1] + h * s1
            trial[i + 2] = x[i + 2] + h * s2
            trial[i + 3] = x[i + 3] + h * s3
        row += stage
        if stage < stages or ints[ADAPTIVE]:
            dynamics(t + floats[nodes + stage] * h, trial, u, p, mode, k[stage])


@kernel
def error_of(h, x, ints, floats, k, trial, progress):
    """Return the largest error estimate of a step in units of the tolerance; leave its state in `progress`."""
    stages = ints[STAGES]
    weights = ints[SCHEME_AT] + (stages + 1) + stages * (stages + 1) // 2
    rtol = floats[ints[STEP_AT] + RTOL]
    scales = ints[SCALES_AT]
    worst = 0.0
    for i in range(ints[TRUE_STATES]):
        total = 0.0
        for j in range(stages + 1):
            total += floats[weights + j] * k[j, i]
        ratio = fabs(h * total) / (rtol * (floats[scales + i] + max(fabs(x[i]), fabs(trial[i]))))
        if not ratio <= worst:
            worst = ratio
            progress[INDEX] = i
            if ratio != ratio:
                return ratio
    return worst


@kernel
def beyond(g, direction):
    """Whether an event's function has left zero in its direction."""
    return g * direction > 0.0


@kernel
def rearm(ints, g, progress):
    """Arm the events whose function has left zero against their direction."""
    directions = ints[DIRECTIONS_AT]
    for i in range(ints[EVENTS]):
        if g[i] * ints[directions + i] < 0.0:
            progress[ARMED + i] = 1


@kernel
def first_beyond(ints, g, progress):
    """Return the first armed event that stands beyond zero in its direction, -1 where there is none."""
    directions = ints[DIRECTIONS_AT]
    for i in range(ints[EVENTS]):
        if progress[ARMED + i] == 1 and beyond(g[i], ints[directions + i]):
            return i
    return -1


@kernel
def settle(event, transition, events, t, x, u, p, ints, g, progress):
    """Let `event` happen (-1: none), then every armed event that stands beyond zero; return whether it ends.

    A transition may set x and give a new mode, in which the events' functions are taken anew.
    """
    while event >= 0:
        progress[MODE] = transition(event, t, x, u, p, progress[MODE])
        progress[ARMED + event] = 0
        events(t, x, u, p, progress[MODE], g)
        rearm(ints, g, progress)
        progress[HAPPENED] += 1
        if progress[HAPPENED] > MAX_EVENTS:
            progress[STATUS] = CHATTERS
            progress[INDEX] = event
            return False
        event = first_beyond(ints, g, progress)
    return True


@kernel
def locate(which, dynamics, events, t, h, x, u, p, ints, floats, k, trial, g0, g1, progress):
    """Return the part of the step h at whose end event `which` has just crossed zero, and that event.

    On entry `trial` and g1 belong to the whole step, on return to that part of
    it. Regula falsi after Illinois on the interval (0, 1) of the step; its end
    beyond zero is returned. An event found to be earlier takes the place of `which`.
    """
    directions = ints[DIRECTIONS_AT]
    mode = progress[MODE]
    low, high = 0.0, 1.0
    g_low, g_high = g0[which], g1[which]
    reached = 1.0
    side = 0
    while high - low > 1e-13:
        part = (low * g_high - high * g_low) / (g_high - g_low)
        if not low < part < high:
            part = 0.5 * (low + high)
        attempt(dynamics, t, part * h, x, u, p, mode, ints, floats, k, trial)
        events(t + part * h, trial, u, p, mode, g1)
        reached = part
        if beyond(g1[which], ints[directions + which]):
            high, g_high = part, g1[which]
            g_low = 0.5 * g_low if side == 1 else g_low
            side = 1
        else:
            low, g_low = part, g1[which]
            g_high = 0.5 * g_high if side == -1 else g_high
            side = -1
            if g1[which] == 0.0:
                high = part
        earlier = first_beyond(ints, g1, progress)
        if earlier >= 0 and earlier != which:
            which, low, high, side = earlier, 0.0, part, 0
            g_low, g_high = g0[earlier], g1[earlier]
    if reached != high:
        attempt(dynamics, t, high * h, x, u, p, mode, ints, floats, k, trial)
        events(t + high * h, trial, u, p, mode, g1)
    return high, which


@kernel
def controlled(t, h, wanted, x, ints, floats, guess, k, trial, progress):
    """Judge a step of a scheme with step control, and choose the next; return whether it is accepted."""
    error = error_of(h, x, ints, floats, k, trial, progress)
    exponent = floats[ints[STEP_AT] + EXPONENT]
    if error <= 1.0:
        growth = GROW if error < NO_POWER_BELOW else SAFETY * error**exponent
        guess[STEP_GUESS] = h * growth if growth < GROW else max(wanted, h * GROW)
        return True
    finite = error < np.inf
    shrunk = h * (max(SHRINK, SAFETY * error**exponent) if finite else SHRINK)
    guess[STEP_GUESS] = shrunk
    if t + shrunk == t:
        progress[STATUS] = STEP_TOO_SMALL if finite else BLEW_UP
    return False


@kernel
def advance(dynamics, events, transition, t, length, x, u, p, ints, floats, guess, progress, k, trial, g0, g1):
    """Advance x from t by `length` seconds, u held; return whether it could.

    On failure `progress` says how and of what. Work arrays: k (stages + 1,
    states), trial (states,), g0 and g1 (events,).
    """
    adaptive = ints[ADAPTIVE] == 1
    has_events = ints[EVENTS] > 0
    progress[STATUS], progress[BUDGET], progress[HAPPENED] = FINISHED, MAX_STEPS, 0
    if has_events:
        events(t, x, u, p, progress[MODE], g0)
        rearm(ints, g0, progress)
        if not settle(first_beyond(ints, g0, progress), transition, events, t, x, u, p, ints, g0, progress):
            return False
    dynamics(t, x, u, p, progress[MODE], k[0])
    done = 0.0
    while done < length:
        progress[BUDGET] -= 1
        if progress[BUDGET] < 0:
            progress[STATUS] = BUDGET_SPENT
            return False
        wanted = guess[STEP_GUESS] if adaptive else floats[ints[STEP_AT] + FIXED_STEP]
        pieces = max(1.0, ceil((length - done) / wanted - 1e-9))
        h = (length - done) / pieces
        attempt(dynamics, t + done, h, x, u, p, progress[MODE], ints, floats, k, trial)
        if adaptive and not controlled(t + done, h, wanted, x, ints, floats, guess, k, trial, progress):
            if progress[STATUS] != FINISHED:
                return False
            continue
        event = -1
        part = 1.0
        if has_events:
            events(t + done + h, trial, u, p, progress[MODE], g1)
            event = first_beyond(ints, g1, progress)
            if event >= 0:
                part, event = locate(
                    event, dynamics, events, t + done, h, x, u, p, ints, floats, k, trial, g0, g1, progress
                )
        done = length if pieces == 1.0 and part == 1.0 else done + part * h
        carry(trial, x, g1, g0, ints)
        rearm(ints, g0, progress)
        if event >= 0 and not settle(event, transition, events, t + done, x, u, p, ints, g0, progress):
            return False
        if event >= 0 or not adaptive:
            dynamics(t + done, x, u, p, progress[MODE], k[0])
        else:
            for i in range(ints[STATES]):
                k[0, i] = k[ints[STAGES], i]
    return True


@kernel
def carry(trial, x, g1, g0, ints):
    """Make the end of a step the start of the next."""
    for i in range(ints[STATES]):
        x[i] = trial[i]
    for i in range(ints[EVENTS]):
        g0[i] = g1[i]
