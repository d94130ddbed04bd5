"""A second-order lag, so cheap that a loop around it is dominated by its fuzzy block."""

from fcl_sim.plant import Input, Output, Parameter, Plant, State

PLANT = Plant(
    name="lag_plant",
    title="Second-order lag with its set point",
    states=(State("place", "m", 0.0, "of the mass"), State("speed", "m/s", 0.0, "of the mass")),
    inputs=(Input("power", "kW", "pushes the mass"),),
    outputs=(
        Output("distance", "m", "from the mass to the set point"),
        Output("angle", "deg", "30 times the speed, for the second input of the rule base"),
    ),
    parameters=(
        Parameter("gain", "m/kW", 1.0, "steady place for each kilowatt", "made up"),
        Parameter("damping", "s", 3.0, "time constant of the damping", "made up"),
        Parameter("inertia", "s^2", 4.0, "time constant of the inertia, squared", "made up"),
        Parameter("target", "m", 12.0, "set point", "made up"),
    ),
)


def dynamics(t, x, u, p, mode, dx):
    """Push a mass on a spring with a damper."""
    dx[0] = x[1]
    dx[1] = (p[0] * u[0] - x[0] - p[1] * x[1]) / p[2]


def outputs(t, x, u, p, mode, y):
    """Give what the rule base reads."""
    y[0] = p[3] - x[0]
    y[1] = 30.0 * x[1]
