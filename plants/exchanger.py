"""Steam heated exchanger with an outlet pipe, for the pre-control of IEC 61131-7 clause B.1.

States: temperature T of the water in the exchanger, opening v of the steam
valve, reading S of the sensor at the end of the pipe. Inputs: the valve's
command u, the throughput w, the inlet temperature Tin. With the mass m of water
in the exchanger and its heat capacity c

    m c T' = w c (Tin - T) + Q s v,    v' = (u - v) / tauv,    S' = (To - S) / taus

To is what leaves the pipe. Water moves through it as a plug: what leaves at a
time is what entered when the throughput up to then was less by the mass of the
pipe, so the delay is the pipe's mass by the flow, also while that changes.

The pipe is a register of marks, one for each cell of mass that entered, holding
the temperature with which it did; between marks the temperature is linear. At
each scan the marks that were passed are entered; a scan may take in less than
the whole pipe. Between scans nothing that was not entered leaves.

[A] marks an assumption; the standard gives B.1 a signal flow and no plant.
"""

from math import floor

from fcl_sim.plant import Input, Output, Parameter, Plant, State, kernel

CELLS = 60
TEMPERATURE, OPENING, READING, ENTERED, SINCE, BEFORE, PIPE = 0, 1, 2, 3, 4, 5, 6
"""Places of the states; from PIPE on the marks, the oldest first, one more than there are cells."""

PLANT = Plant(
    name="exchanger",
    title="Steam heated exchanger with an outlet pipe",
    states=(
        State("temperature", "degC", 50.0, "of the water in the exchanger", scale=10.0),
        State("opening", "1", 0.4883667, "of the steam valve; at rest with the temperature"),
        State("reading", "degC", 50.0, "of the sensor at the end of the pipe", scale=10.0),
        State("entered", "kg", 0.0, "water that entered the pipe since the newest mark"),
        State("since", "kg", 0.0, "water that entered the pipe since the last scan"),
        State("before", "degC", 50.0, "temperature in the exchanger at the last scan", scale=10.0),
        *(State(f"mark_{i}", "degC", 50.0, "in the pipe, from its end on", scale=10.0) for i in range(61)),
    ),
    inputs=(
        Input("valve", "%", "u, command of the steam valve"),
        Input("flow", "kg/s", "w, throughput", start=1.0),
        Input("inlet", "degC", "Tin", start=15.0),
    ),
    outputs=(
        Output("outlet", "degC", "reading of the sensor at the end of the pipe"),
        Output("water", "degC", "temperature in the exchanger"),
        Output("valve_opening", "%", "where the steam valve stands"),
        Output("delivered", "degC", "temperature at the end of the pipe"),
    ),
    parameters=(
        Parameter("mass", "kg", 60.0, "m, of the water in the exchanger", "[A] small plate exchanger", 0.1),
        Parameter(
            "pipe_mass", "kg", 15.0, "of the water in the outlet pipe", "[A] 15 s of delay at 1 kg/s", 0.1
        ),
        Parameter("heat_capacity", "J/kg K", 4186.0, "c, of water", "handbook", 1.0),
        Parameter(
            "steam", "kW", 300.0, "Q, with the valve fully open", "[A] 49 % of it hold 50 degC at 1 kg/s", 0.0
        ),
        Parameter("steam_quality", "1", 1.0, "s, part of Q that the steam gives", "[A] 0.9 tested", 0.0),
        Parameter("valve_lag", "s", 4.0, "tauv", "[A] short beside the 60 s of the exchanger", 0.01),
        Parameter("sensor_lag", "s", 5.0, "taus", "[A] short beside the 60 s of the exchanger", 0.01),
    ),
)


@kernel
def delivered(x, p):
    """Temperature at the end of the pipe: between the marks that the mass of the pipe ago lies between."""
    passed = x[ENTERED] * CELLS / p[1]
    whole = min(floor(passed), CELLS - 1)
    at = PIPE + int(whole)
    return x[at] + (passed - whole) * (x[at + 1] - x[at])


def dynamics(t, x, u, p, mode, dx):
    """Balance the heat; valve and sensor lag; water enters the pipe."""
    flow = max(u[1], 0.0)
    heat = 1000.0 * p[3] * p[4] * x[OPENING]
    dx[TEMPERATURE] = (flow * (u[2] - x[TEMPERATURE]) + heat / p[2]) / p[0]
    dx[OPENING] = (u[0] / 100.0 - x[OPENING]) / p[5]
    dx[READING] = (delivered(x, p) - x[READING]) / p[6]
    dx[ENTERED] = flow
    dx[SINCE] = flow
    for i in range(BEFORE, PIPE + CELLS + 1):
        dx[i] = 0.0


def outputs(t, x, u, p, mode, y):
    """Give the temperatures and the valve."""
    y[0] = x[READING]
    y[1] = x[TEMPERATURE]
    y[2] = 100.0 * x[OPENING]
    y[3] = delivered(x, p)


def sample(t, x, u, p):
    """Enter the marks that were passed since the last scan."""
    cell = p[1] / CELLS
    while x[ENTERED] >= cell:
        x[ENTERED] -= cell
        for i in range(PIPE, PIPE + CELLS):
            x[i] = x[i + 1]
        x[PIPE + CELLS] = x[TEMPERATURE] - x[ENTERED] / x[SINCE] * (x[TEMPERATURE] - x[BEFORE])
    x[SINCE] = 0.0
    x[BEFORE] = x[TEMPERATURE]
