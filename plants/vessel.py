"""Compressed-air receiver for the block of IEC 61131-7 figure 7: a rigid vessel that a valve fills or drains.

States: pressure P (above that of the atmosphere Pa) and temperature T of the
gas. Inputs: the valve, from -100 % (drains) over 0 (closed) to 100 % (fills),
the demand of a consumer, and the temperature Ta of the surroundings. With the
absolute pressure p = P + Pa, the mass m = p V / (R T) of an ideal gas, and the
flows in from a header, out to the atmosphere, and to the consumer

    wi = KI max(valve, 0) max(Ps - P, 0)
    wo = KO max(-valve, 0) max(P, 0),    wc = KC demand max(P, 0)

mass and energy of the vessel give

    m' = wi - wo - wc
    m cv T' = wi cp Tin - (wo + wc) cp T + UA (Ta - T) - cv T m'
    p' = R (m' T + m T') / V

At rest the valve stands where the rule base puts it for the pressure and the
temperature that it causes, so the points of rest are the roots of m' = T' = 0.

[A] marks an assumption; the standard gives figure 7 no plant.
"""

from fcl_sim.plant import Input, Output, Parameter, Plant, State, kernel

PLANT = Plant(
    name="vessel",
    title="Compressed-air receiver between a header and a consumer",
    states=(
        State("pressure", "kPa", 50.0, "above the atmosphere", scale=10.0),
        State("temperature", "degC", 5.0, "of the gas", scale=10.0),
    ),
    inputs=(
        Input("valve", "%", "above 0 from the header, below 0 to the atmosphere"),
        Input("demand", "1", "of the consumer, 1 as usual", start=1.0),
        Input("surroundings", "degC", "temperature around the vessel", start=12.0),
    ),
    outputs=(
        Output("gauge_pressure", "kPa", "above the atmosphere"),
        Output("gas_temperature", "degC", "of the gas"),
        Output("mass", "kg", "of the gas"),
        Output("inflow", "g/s", "from the header"),
        Output("outflow", "g/s", "to the atmosphere and the consumer"),
    ),
    parameters=(
        Parameter("volume", "m3", 2.0, "V", "[A] holds 4 kg at rest, 10 min of the usual demand", 0.01),
        Parameter(
            "header_pressure",
            "kPa",
            150.0,
            "Ps, above the atmosphere",
            "[A] above the 95 kPa of figure 7",
            0.0,
        ),
        Parameter("header_temperature", "degC", 40.0, "Tin", "[A] behind a compressor's cooler"),
        Parameter("atmosphere", "kPa", 101.325, "Pa", "standard atmosphere", 1.0),
        Parameter(
            "inlet",
            "kg/s kPa",
            2e-3,
            "KI, of the valve fully open to the header",
            "[A] 4.4 % open at rest",
            0.0,
        ),
        Parameter(
            "drainage", "kg/s kPa", 2e-3, "KO, of the valve fully open to the atmosphere", "[A] as KI", 0.0
        ),
        Parameter("consumer", "kg/s kPa", 1e-4, "KC, at a demand of 1", "[A] 7 g/s at rest", 0.0),
        Parameter("wall", "W/K", 40.0, "UA, to the surroundings", "[A] bare steel, still air", 0.0),
        Parameter("gas_constant", "J/kg K", 287.05, "R of air", "handbook", 1.0),
        Parameter("heat_capacity", "J/kg K", 1005.0, "cp of air; cv = cp - R", "handbook", 300.0),
    ),
)

KELVIN = 273.15


@kernel
def inflow(x, u, p):
    """Mass flow from the header, kg/s."""
    return p[4] * max(u[0], 0.0) / 100.0 * max(p[1] - x[0], 0.0)


@kernel
def outflow(x, u, p):
    """Mass flow to the atmosphere and to the consumer, kg/s."""
    return (p[5] * max(-u[0], 0.0) / 100.0 + p[6] * u[1]) * max(x[0], 0.0)


@kernel
def mass(x, p):
    """Mass of the gas, kg."""
    return 1000.0 * (x[0] + p[3]) * p[0] / (p[8] * (x[1] + KELVIN))


def dynamics(t, x, u, p, mode, dx):
    """Balance mass and energy."""
    volume, r, cp = p[0], p[8], p[9]
    cv = cp - r
    kelvin, content = x[1] + KELVIN, mass(x, p)
    came, went = inflow(x, u, p), outflow(x, u, p)
    change = came - went
    heat = came * cp * (p[2] + KELVIN) - went * cp * kelvin + p[7] * (u[2] - x[1]) - cv * kelvin * change
    warming = heat / (content * cv)
    dx[0] = r * (change * kelvin + content * warming) / volume / 1000.0
    dx[1] = warming


def outputs(t, x, u, p, mode, y):
    """Give pressure, temperature and flows."""
    y[0] = x[0]
    y[1] = x[1]
    y[2] = mass(x, p)
    y[3] = 1000.0 * inflow(x, u, p)
    y[4] = 1000.0 * outflow(x, u, p)
