"""A trolley with a swinging load and nothing else: no drive, no dry friction, no modes and no events."""

from math import cos, pi, sin

from fcl_sim.plant import Input, Output, Parameter, Plant, State

PLANT = Plant(
    name="plain_crane",
    title="Trolley with hanging load, driven by a force",
    states=(
        State("position", "m", -25.0, "trolley, the target is at 0"),
        State("speed", "m/s", 0.0, "trolley"),
        State("angle", "rad", 0.0, "load, positive ahead of the trolley"),
        State("rate", "rad/s", 0.0, "of the angle"),
    ),
    inputs=(Input("power", "kW", "what the rules ask for"),),
    outputs=(
        Output("distance", "m", "from the trolley to the target"),
        Output("angle", "deg", "load, positive ahead of the trolley"),
    ),
    parameters=(
        Parameter("trolley", "kg", 15_000.0, "its mass", "as plants/crane.py"),
        Parameter("load", "kg", 20_000.0, "its mass", "as plants/crane.py"),
        Parameter("cable", "m", 10.0, "its length", "as plants/crane.py"),
        Parameter("gravity", "m/s2", 9.81, "standard gravity, rounded", "as plants/crane.py"),
        Parameter("friction", "N s/m", 200.0, "viscous", "as plants/crane.py"),
        Parameter("force", "N/kW", 1000.0, "of a kilowatt", "at 1 m/s"),
    ),
)


def dynamics(t, x, u, p, mode, dx):
    """Swing the load below a trolley that a force moves."""
    s, c = sin(x[2]), cos(x[2])
    force = p[5] * u[0] - p[4] * x[1] + p[1] * s * (p[2] * x[3] * x[3] + p[3] * c)
    acceleration = force / (p[0] + p[1] * s * s)
    dx[0] = x[1]
    dx[1] = acceleration
    dx[2] = x[3]
    dx[3] = -(acceleration * c + p[3] * s) / p[2]


def outputs(t, x, u, p, mode, y):
    """Give what the rule base reads."""
    y[0] = -x[0]
    y[1] = x[2] * (180.0 / pi)
