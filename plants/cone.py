"""Conical tank of a laboratory, for the parameter adaptation of IEC 61131-7 clause B.2.

States: level h and inflow q, which the pump brings up with a lag. Inputs: the
pump's command u and a further outflow qd. With the apex down, height H and
radius R at the rim, the surface at level h is A(h) = pi (R h / H)^2, and

    A(h) h' = q - c sqrt(h / 1 m) - qd,    q' = (Qmax u - q) / tauq

Linear about a level, the gain is 2 sqrt(h) Qmax / c and the time constant
2 A sqrt(h) / c, so their ratio goes with 1 / h^2: from 0.15 m to 0.70 m it
changes 22 times, more than one setting of a PID controller can span.

The equation is taken down to a level of 1 mm; below it the outflow keeps
from falling further. [A] marks an assumption.
"""

from math import pi, sqrt

from fcl_sim.plant import Input, Output, Parameter, Plant, State

PLANT = Plant(
    name="cone",
    title="Conical tank with a pump",
    states=(
        State("level", "m", 0.15, "h, above the apex", scale=0.1),
        State("inflow", "m3/s", 4e-4 * 0.15**0.5, "q, of the pump; at rest with the level", scale=1e-4),
    ),
    inputs=(
        Input("pump", "1", "u, command of the pump, 0 to 1"),
        Input("leak", "m3/s", "qd, outflow beside the outlet"),
    ),
    outputs=(
        Output("height", "m", "level above the apex"),
        Output("flow", "l/min", "inflow"),
        Output("drain", "l/min", "what flows out in all"),
    ),
    parameters=(
        Parameter("rim", "m", 0.8, "H, height of the rim", "a laboratory cone, scribd 411962115", 0.01),
        Parameter("radius", "m", 0.2, "R, at the rim", "the same", 0.01),
        Parameter(
            "outlet", "m3/s", 4e-4, "c, outflow at a level of 1 m", "[A] the pump at 72 % holds the rim", 0.0
        ),
        Parameter("capacity", "m3/s", 5e-4, "Qmax, of the pump", "[A] the laboratory's gave 3e-4", 0.0),
        Parameter("pump_lag", "s", 1.5, "tauq", "[A] near the dead time of 2 s", 0.01),
    ),
)

LOWEST = 1e-3


def dynamics(t, x, u, p, mode, dx):
    """Balance the volume; the pump lags."""
    level = max(x[0], LOWEST)
    radius = p[1] * level / p[0]
    net = x[1] - p[2] * sqrt(level) - u[1]
    dx[0] = (net if x[0] > LOWEST else max(net, 0.0)) / (pi * radius * radius)
    dx[1] = (p[3] * u[0] - x[1]) / p[4]


def outputs(t, x, u, p, mode, y):
    """Give the level and the flows."""
    y[0] = x[0]
    y[1] = 6e4 * x[1]
    y[2] = 6e4 * (p[2] * sqrt(max(x[0], LOWEST)) + u[1])
