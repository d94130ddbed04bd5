"""Heated water tank for the example of the Concept FUZZY manual, whose rules open a steam valve.

States: temperature T of the water, and the opening v of the valve, which
follows its command u with a lag. Inputs: the command, the draw-off, and a
disturbance dp of the steam pressure. With the water's mass m and heat capacity c

    m c T' = Q v - K demand (T - Tin),    v' = (u - v) / tauv
    P = P0 + kP (T - T0) + dp

The manual wires temperature and pressure to a valve and gives no plant; the
pressure follows the temperature as that of saturated steam does, made linear
about 72.5 degC. [A] marks an assumption.
"""

from fcl_sim.plant import Input, Output, Parameter, Plant, State

PLANT = Plant(
    name="bath",
    title="Water tank heated by steam",
    states=(
        State("temperature", "degC", 45.0, "of the water", scale=10.0),
        State("opening", "1", 0.0, "of the valve"),
    ),
    inputs=(
        Input("valve", "%", "command of the steam valve"),
        Input("demand", "1", "draw-off, 1 as usual", start=1.0),
        Input("disturbance", "mbar", "dp, of the steam pressure"),
    ),
    outputs=(
        Output("water", "degC", "temperature of the water"),
        Output("pressure", "mbar", "of the steam"),
        Output("valve_opening", "%", "where the valve stands"),
    ),
    parameters=(
        Parameter("mass", "kg", 500.0, "m, of the water", "[A] 50 min of lag at the usual draw-off", 1.0),
        Parameter("heat_capacity", "J/kg K", 4186.0, "c, of water", "handbook", 1.0),
        Parameter(
            "heating", "kW", 60.0, "Q, with the valve fully open", "[A] holds 100 degC at a demand of 1", 0.0
        ),
        Parameter("draw_off", "W/K", 700.0, "K, at a demand of 1", "[A] 0.17 kg/s of water", 0.0),
        Parameter("supply", "degC", 20.0, "Tin, of what replaces the draw-off", "[A] room temperature"),
        Parameter("valve_lag", "s", 5.0, "tauv", "[A] short beside the lag of the water", 0.01),
        Parameter("pressure_at", "mbar", 4000.0, "P0, at T0", "middle of the manual's ramp for the pressure"),
        Parameter("reference", "degC", 72.5, "T0", "[A] middle of the manual's plateau for the temperature"),
        Parameter("pressure_slope", "mbar/K", 2.0, "kP", "[A] 50 K pass one ramp of the manual"),
    ),
)


def dynamics(t, x, u, p, mode, dx):
    """Balance the heat; the valve lags."""
    dx[0] = (1000.0 * p[2] * x[1] - p[3] * u[1] * (x[0] - p[4])) / (p[0] * p[1])
    dx[1] = (u[0] / 100.0 - x[1]) / p[5]


def outputs(t, x, u, p, mode, y):
    """Give temperature, pressure and the valve."""
    y[0] = x[0]
    y[1] = p[6] + p[8] * (x[0] - p[7]) + u[2]
    y[2] = 100.0 * x[1]
