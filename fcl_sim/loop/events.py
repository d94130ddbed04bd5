"""Events: which are armed, which stand beyond zero, where one crossed it, what happens then.

An event happens when its function goes from at or before zero to beyond it, in
its direction. One that has happened is armed again when its function is back:
one that stays beyond zero happens once, one whose transition puts its function
back to zero, as a bounce does, can happen again at once.
"""

from fcl_sim.jit import inlined, kernel, u
from fcl_sim.loop.layout import CHATTERS, DIRECTIONS_AT, EVENTS
from fcl_sim.loop.step import attempt
from fcl_sim.loop.work import ARMED, HAPPENED, INDEX, MODE, STATUS, Floats, Ints
from fcl_sim.plant.functions import PlantFunction

MAX_EVENTS = 1_000
"""Events between two writes beyond which a plant chatters."""
RESOLUTION = 1e-13
"""To what part of a step an event is located."""


@inlined
def rearm(ints: Ints, g: Floats, progress: Ints) -> None:
    """Arm the events that are not, or no longer, beyond zero in their direction."""
    armed = progress[u(ARMED)]
    directions = ints[u(DIRECTIONS_AT)]
    for i in range(ints[u(EVENTS)]):
        if g[u(i)] * ints[u(directions + i)] <= 0.0:
            armed |= 1 << i
    progress[u(ARMED)] = armed


@inlined
def first_beyond(ints: Ints, g: Floats, progress: Ints) -> int:
    """Return the first armed event that stands beyond zero in its direction, -1 where there is none."""
    armed = progress[u(ARMED)]
    directions = ints[u(DIRECTIONS_AT)]
    for i in range(ints[u(EVENTS)]):
        if g[u(i)] * ints[u(directions + i)] > 0.0 and (armed >> i) & 1:
            return i
    return -1


@kernel
def settle(
    event: int,
    events: PlantFunction,
    transition: PlantFunction,
    t: float,
    ints: Ints,
    x: Floats,
    held: Floats,
    p: Floats,
    progress: Ints,
    g0: Floats,
) -> bool:
    """Let `event` happen, then every armed event that stands beyond zero; return whether it ends.

    A transition may set x and give a new mode, in which the events' functions are taken anew.
    """
    while event >= 0:
        progress[u(MODE)] = transition(event, t, x, held, p, progress[u(MODE)])
        progress[u(ARMED)] &= ~(1 << event)
        events(t, x, held, p, progress[u(MODE)], g0)
        rearm(ints, g0, progress)
        progress[u(HAPPENED)] += 1
        if progress[u(HAPPENED)] > MAX_EVENTS:
            progress[u(STATUS)] = CHATTERS
            progress[u(INDEX)] = event
            return False
        event = first_beyond(ints, g0, progress)
    return True


@kernel
def locate(
    which: int,
    dynamics: PlantFunction,
    events: PlantFunction,
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
    g0: Floats,
    g1: Floats,
) -> tuple[float, int]:
    """Return the part of the step h at whose end event `which` has just crossed zero, and that event.

    On entry `trial` and g1 belong to the whole step, on return to that part of
    it. Regula falsi after Illinois on the interval (0, 1) of the step; the end
    of it that lies beyond zero is returned. An event found to be earlier takes the place of `which`.
    """
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
        attempt(dynamics, t, part * h, ints, floats, x, held, p, progress, work, dx, trial)
        events(t + part * h, trial, held, p, progress[u(MODE)], g1)
        earlier = first_beyond(ints, g1, progress)
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
