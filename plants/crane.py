"""Container crane of IEC 61131-7 Annex C: a trolley with a hanging load, driven with limited power.

States: position x of the trolley (the target is at 0), speed v, angle th of the
load (positive: ahead of the trolley, towards the target), its rate w, and the
drive force F. Inputs: motor power P, and the speed u of the wind at the load,
which may be left unconnected: no wind. With M the trolley's mass, m the load's,
L the cable's length:

    (M + m) v' + m L w' cos th - m L w^2 sin th = F - Ff + W
    L w' + v' cos th + g sin th = -2 zeta sqrt(g L) w + W cos th / m
    F' = (limited(Fc) - F) / taud,    Fc = P / max(|v|, vb)
    W = rho/2 cA u |u|

The drive gives constant torque below the base speed vb and constant power above
it; motoring fades out at the greatest speed, |F| is limited by adhesion.

Friction is set-valued: Ff = cr (M + m) g sign(v) + bv v while the trolley
slides; at rest it holds as long as the pull on the trolley does not exceed
cr (M + m) g. Smoothing it would let the trolley creep to the target, which no
crane does; so sliding and sticking are modes, and the changes are events.

[A] marks an assumption; the standard names no parameter of the crane.
"""

from math import cos, fabs, pi, sin, sqrt

from fcl_sim.plant import (
    FALLING,
    RISING,
    Event,
    Input,
    Mode,
    Output,
    Parameter,
    Plant,
    State,
    kernel,
)

STUCK, FORWARD, BACKWARD = 0, 1, 2
STOPS_FORWARD, STOPS_BACKWARD, BREAKS_FORWARD, BREAKS_BACKWARD = 0, 1, 2, 3

PLANT = Plant(
    name="crane",
    title="Container crane, trolley with hanging load",
    states=(
        State("position", "m", -25.0, "trolley, the target is at 0"),
        State("speed", "m/s", 0.0, "trolley"),
        State("angle", "rad", 0.0, "load, positive ahead of the trolley", scale=0.1),
        State("rate", "rad/s", 0.0, "of the angle", scale=0.1),
        State("drive_force", "N", 0.0, "on the trolley", scale=1000.0),
    ),
    inputs=(
        Input("power", "kW", "motor power, positive drives towards the target"),
        Input("wind", "m/s", "u, at the load, positive blows towards greater x", optional=True),
    ),
    outputs=(
        Output("distance", "m", "from the trolley to the target"),
        Output("angle", "deg", "load, positive ahead of the trolley"),
        Output("sway", "deg", "amplitude of the swing: sqrt(th^2 + (w sqrt(L/g))^2)"),
        Output("position", "m", "trolley, the target is at 0"),
        Output("speed", "m/s", "trolley"),
        Output("force", "kN", "drive force on the trolley"),
        Output("rate", "deg/s", "of the angle"),
    ),
    parameters=(
        Parameter(
            "trolley_mass",
            "kg",
            15_000.0,
            "M",
            "[A] between light and machinery trolleys, 10 to 20 t tested",
            1.0,
        ),
        Parameter(
            "load_mass", "kg", 20_000.0, "m: container and spreader", "10 to 40 t, RTG data sheets", 0.0
        ),
        Parameter("cable_length", "m", 10.0, "L", "5 to 15 m, RTG lift heights 12 to 21 m", 0.1),
        Parameter("gravity", "m/s2", 9.81, "g", "standard gravity, rounded", 0.0),
        Parameter("maximum_speed", "m/s", 2.5, "motoring fades out here", "[A] 150 m/min", 0.01),
        Parameter(
            "base_speed",
            "m/s",
            1.0,
            "vb: constant torque below, constant power above",
            "[A] makes 1 kN of 1 kW",
            0.001,
        ),
        Parameter(
            "drive_lag",
            "s",
            0.1,
            "taud: torque loop and gear",
            "[A] vector drive, 0.05 to 0.3 s tested",
            1e-4,
        ),
        Parameter(
            "rolling_resistance",
            "1",
            0.005,
            "cr",
            "crane wheels of 400 to 630 mm: 0.0044 to 0.0068",
            0.0,
            1.0,
        ),
        Parameter(
            "viscous_friction",
            "N s/m",
            200.0,
            "bv",
            "[A] 0.5 kN at the greatest speed, rolling takes 1.7 kN",
            0.0,
        ),
        Parameter("damping", "1", 0.005, "zeta of the swing", "[A] leaves 97 % of a swing to the next", 0.0),
        Parameter("adhesion", "1", 0.12, "greatest |F| per weight", "[A] steel on steel", 0.0),
        Parameter(
            "limiter_gain",
            "N s/m",
            5e4,
            "slope of the fading at the greatest speed",
            "[A] 27 kW fade over 0.24 m/s",
            0.0,
        ),
        Parameter(
            "wind_area",
            "m2",
            38.0,
            "cA: coefficient of drag times area of the load",
            "[A] 1.2 times the broad side of a container of 40 ft, 12.19 m by 2.59 m (ISO 668)",
            0.0,
        ),
        Parameter("air_density", "kg/m3", 1.25, "rho", "[A] u^2/1.6 as pressure, usual for cranes", 0.0),
    ),
    modes=(
        Mode("stuck", "the trolley rests, held by friction"),
        Mode("forward", "the trolley slides towards greater x"),
        Mode("backward", "the trolley slides towards smaller x"),
    ),
    events=(
        Event("stops forward", FALLING, "the speed of a forward slide reaches zero"),
        Event("stops backward", RISING, "the speed of a backward slide reaches zero"),
        Event("breaks loose forward", RISING, "the pull exceeds the friction at rest"),
        Event("breaks loose backward", FALLING, "the pull exceeds the friction at rest, backwards"),
    ),
)


@kernel
def pull(x, u, p):
    """Force on the trolley from drive, load and the wind on it, without friction."""
    load_mass, length, gravity = p[1], p[2], p[3]
    sine, cosine, rate = sin(x[2]), cos(x[2]), x[3]
    damping = 2.0 * p[9] * sqrt(gravity * length) * rate
    swing = gravity * sine + damping
    still = x[4] + load_mass * length * rate * rate * sine + load_mass * cosine * swing
    return still + drag(u[1], p) * sine * sine


@kernel
def drag(wind, p):
    """Force of the wind on the load."""
    return 0.5 * p[13] * p[12] * wind * fabs(wind)


@kernel
def hold(p):
    """Greatest force that friction holds at rest."""
    return p[7] * (p[0] + p[1]) * p[3]


@kernel
def commanded(power, speed, p):
    """Force that the drive is asked for, with its limits."""
    force = 1000.0 * power / max(fabs(speed), p[5])
    if force > 0.0:
        force = min(force, max(0.0, p[11] * (p[4] - speed)))
    else:
        force = max(force, min(0.0, -p[11] * (p[4] + speed)))
    grip = p[10] * (p[0] + p[1]) * p[3]
    return min(max(force, -grip), grip)


def dynamics(t, x, u, p, mode, dx):
    """Solve the equations of motion for v' and w'; the drive lags."""
    trolley_mass, load_mass, length, gravity = p[0], p[1], p[2], p[3]
    speed, rate, force = x[1], x[3], x[4]
    sine, cosine = sin(x[2]), cos(x[2])
    swing = gravity * sine + 2.0 * p[9] * sqrt(gravity * length) * rate
    wind = drag(u[1], p)
    acceleration = 0.0
    if mode != STUCK:
        friction = p[8] * speed + (hold(p) if mode == FORWARD else -hold(p))
        net = force - friction + load_mass * (length * rate * rate * sine + cosine * swing)
        net += wind * sine * sine
        acceleration = net / (trolley_mass + load_mass - load_mass * cosine * cosine)
    dx[0] = speed
    dx[1] = acceleration
    dx[2] = rate
    blown = wind * cosine / load_mass if load_mass > 0.0 else 0.0
    dx[3] = -(acceleration * cosine + swing - blown) / length
    dx[4] = (commanded(u[0], speed, p) - force) / p[6]


def outputs(t, x, u, p, mode, y):
    """Give what sensors could see."""
    degrees = 180.0 / pi
    y[0] = 0.0 - x[0]
    y[1] = degrees * x[2]
    y[2] = degrees * sqrt(x[2] * x[2] + x[3] * x[3] * p[2] / p[3])
    y[3] = x[0]
    y[4] = x[1]
    y[5] = x[4] / 1000.0
    y[6] = degrees * x[3]


def events(t, x, u, p, mode, g):
    """Watch for the end of a slide, its speed, and of rest, the pull against what friction holds."""
    g[STOPS_FORWARD] = x[1] if mode == FORWARD else 1.0
    g[STOPS_BACKWARD] = x[1] if mode == BACKWARD else -1.0
    g[BREAKS_FORWARD] = -1.0
    g[BREAKS_BACKWARD] = 1.0
    if mode == STUCK:
        now = pull(x, u, p)
        g[BREAKS_FORWARD] = now - hold(p)
        g[BREAKS_BACKWARD] = now + hold(p)


def transition(i, t, x, u, p, mode):
    """Let the pull decide at rest; a slide begins in its direction."""
    if i == BREAKS_FORWARD:
        return FORWARD
    if i == BREAKS_BACKWARD:
        return BACKWARD
    if i in (STOPS_FORWARD, STOPS_BACKWARD):
        x[1] = 0.0
    if x[1] > 0.0:
        return FORWARD
    if x[1] < 0.0:
        return BACKWARD
    now = pull(x, u, p)
    if fabs(now) <= hold(p):
        return STUCK
    return FORWARD if now > 0.0 else BACKWARD
