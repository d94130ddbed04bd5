"""Events: which are armed, which stand beyond zero, where one crossed it, what happens then.

An event happens when its function goes from at or before zero to beyond it, in
its direction. One that has happened is armed again when its function is back:
one that stays beyond zero happens once, one whose transition puts its function
back to zero, as a bounce does, can happen again at once.

Events are looked for at the end of a step and, with step control, within it:
in the middle, on the cubic through both ends, and where the parabola through
the beginning, the middle and the end of an event's function is highest. So an
event whose function goes beyond zero and back within one step is found where it
is nearly a parabola there; where it turns more than once in a step, as the
solution then hardly does, it may not be. A scheme with a fixed step looks at
the ends of steps alone: the step that is asked for bounds what is not seen.
"""

from fcl_sim.jit import flat, inlined, u
from fcl_sim.loop.layout import CHATTERS, DIRECTIONS_AT, EVENTS, STAGES, STATES
from fcl_sim.loop.step import attempt
from fcl_sim.loop.work import (
    ARMED,
    HAPPENED,
    INDEX,
    LAST_EVENT,
    MODE,
    STATUS,
    Floats,
    Ints,
    Plant,
    Work,
    row_of,
)

MAX_EVENTS = 1_000
"""Events at one time beyond which a plant chatters."""
APART = 1e-9
"""Seconds to which times of events are told apart."""
RESOLUTION = 1e-13
"""To what part of a step an event is located."""
AT_BEGINNING, AT_END, IN_THE_MIDDLE = range(3)
"""Where in a step the events' functions are taken: at x into g0, at `trial` into g1, at `middle` into gm."""


@inlined
def rearm(ints: Ints, g: Floats, progress: Ints) -> None:
    """Arm the events that are not, or no longer, beyond zero in their direction."""
    directions = ints[u(DIRECTIONS_AT)]
    i = 0
    while i < ints[u(EVENTS)]:  # each written at once, so that they are read one by one (`loop.step`)
        if g[u(i)] * ints[u(directions + i)] <= 0.0:
            progress[u(ARMED)] |= 1 << i
        i += 1


@inlined
def first_beyond(ints: Ints, g: Floats, progress: Ints) -> int:
    """Return the first armed event that stands beyond zero in its direction, -1 where there is none."""
    armed = progress[u(ARMED)]
    directions = ints[u(DIRECTIONS_AT)]
    for i in range(ints[u(EVENTS)]):
        if g[u(i)] * ints[u(directions + i)] > 0.0 and (armed >> i) & 1:
            return i
    return -1


@inlined
def look(plant: Plant, work: Work, t: float, where: int) -> int:
    """Take the events' functions; return the first armed event beyond zero, -1 where there is none."""
    plant.look(work.at, where, t, work.progress[u(MODE)])
    return first_beyond(work.ints, work.g0 if where == AT_BEGINNING else work.g1, work.progress)


@inlined
def summit(before: float, between: float, after: float) -> float:
    """Return where in (0, 1) a parabola through its values at 0, 1/2 and 1 is above 0, else 1.

    Before and after it is not. Above it is in the middle, or where it is highest.
    """
    if between > 0.0:
        return 0.5
    slope, bend = 4.0 * between - 3.0 * before - after, 2.0 * (before + after) - 4.0 * between
    if slope > 0.0 and slope + 2.0 * bend < 0.0 and before - slope * slope / (4.0 * bend) > 0.0:
        return slope / (-2.0 * bend)
    return 1.0


@inlined
def within(plant: Plant, work: Work, t: float, h: float) -> float:
    """Return at what part of a step with step control an armed event may stand beyond zero, 1 if at none.

    Of events that do so at its end nothing is said.
    """
    ints, rows, middle = work.ints, work.rows, work.middle
    at, end = row_of(0, ints[u(STATES)]), row_of(ints[u(STAGES)], ints[u(STATES)])
    x, trial, bow = work.x, work.trial, 0.125 * h
    i = 0
    while i < ints[u(STATES)]:
        for k in range(i, i + 4):
            middle[u(k)] = 0.5 * (x[u(k)] + trial[u(k)]) + bow * (rows[u(at + k)] - rows[u(end + k)])
        i += 4
    plant.look(work.at, IN_THE_MIDDLE, t + 0.5 * h, work.progress[u(MODE)])
    armed = work.progress[u(ARMED)]
    directions = ints[u(DIRECTIONS_AT)]
    first = 1.0
    for i in range(ints[u(EVENTS)]):
        sign = float(ints[u(directions + i)])
        before, after = sign * work.g0[u(i)], sign * work.g1[u(i)]
        if (armed >> i) & 1 and before <= 0.0 and after <= 0.0:
            first = min(first, summit(before, sign * work.gm[u(i)], after))
    return first


@flat
def cut_short(plant: Plant, work: Work, t: float, h: float, part: float, event: int) -> tuple[float, int]:
    """Return the part of the step h at whose end an event stands beyond zero, and that event.

    It may do so at `part`; if it does not, what is left is `event` at the end
    of the step, -1 for none. `trial` and g1 then belong to the part returned.
    """
    attempt(plant, work, t, part * h)
    found = look(plant, work, t + part * h, AT_END)
    if found >= 0:
        return part, found
    attempt(plant, work, t, h)
    plant.look(work.at, AT_END, t + h, work.progress[u(MODE)])
    return 1.0, event


@flat
def settle(plant: Plant, work: Work, t: float, event: int) -> bool:
    """Let `event` happen, then every armed event that stands beyond zero; return whether it ends.

    A transition may set x and give a new mode, in which the events' functions are taken anew.
    """
    progress, g0 = work.progress, work.g0
    if t - work.rows[u(LAST_EVENT)] > APART:
        progress[u(HAPPENED)] = 0
    work.rows[u(LAST_EVENT)] = t
    while event >= 0:
        progress[u(MODE)] = plant.transition(event, t, work.x, work.held, work.p, progress[u(MODE)])
        progress[u(ARMED)] &= ~(1 << event)
        plant.look(work.at, AT_BEGINNING, t, progress[u(MODE)])
        rearm(work.ints, g0, progress)
        progress[u(HAPPENED)] += 1
        if progress[u(HAPPENED)] > MAX_EVENTS:
            progress[u(STATUS)] = CHATTERS
            progress[u(INDEX)] = event
            return False
        event = first_beyond(work.ints, g0, progress)
    return True


@flat
def locate(plant: Plant, work: Work, t: float, h: float, which: int) -> tuple[float, int]:
    """Return the part of the step h at whose end event `which` has just crossed zero, and that event.

    On entry `trial` and g1 belong to the whole step, on return to that part of
    it. Regula falsi after Illinois on the interval (0, 1) of the step; the end
    of it that lies beyond zero is returned. An event found to be earlier takes the place of `which`.
    """
    g0, g1 = work.g0, work.g1
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
        attempt(plant, work, t, part * h)
        earlier = look(plant, work, t + part * h, AT_END)
        if earlier >= 0 and earlier != which:
            which, low, high, side = earlier, 0.0, part, 0
            g_low, g_high = g0[u(which)], g1[u(which)]
        elif earlier == which:
            high, g_high = part, g1[u(which)]
            g_low = 0.5 * g_low if side == 1 else g_low
            side = 1
        else:
            low, g_low = part, g1[u(which)]
            g_high = 0.5 * g_high if side == -1 else g_high
            side = -1
    return high, which
