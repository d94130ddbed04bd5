"""Tunnel oven of IEC 61131-7 Annex D: two heated zones, a belt with biscuits, their colour and the humidity.

The belt is a plug flow of CELLS cells, which move on by one place each time that
it has gone the length of a cell; half of them are in each zone. For each cell
the product has a temperature Tp, a moisture X (kg per kg dry) and a browning B
between 0 and 1. With Tz the temperature of the zone and T = Tp + 273.15 K

    Tp' = (HA (Tz - Tp) - LAM r) / (cps + cpw X)
    X'  = -r,    r = kd max(0, X - Xe),    kd = KD0 exp(-EAD/R (1/T - 1/378.15 K)),    Xe = 0.2 Y
    B'  = sugar SUG kB0 exp(-EB/(R (Ts + 273.15 K))) (1 - B) / (1 + (X/0.1)^2),    Ts = Tp + 0.22 (Tz - Tp)

Ts is the surface, which browns only once it is dry. The colour is dE = 52 B, the
distance from that of the dough. Each zone i has a heater ui and a neighbour j;
Y is the humidity of the air in kg per kg dry, of which G enters and leaves:

    CZ Ti' = Pmax ui - UA (Ti - Ta) - G/2 cp (Ti - Ta) - sum of m HA (Ti - Tp) + KX (Tj - Ti)
    Mair Y' = sum of m r - G (Y - Ya)

the sums over the cells of the zone and of the belt, m the mass of a cell. A piece
that leaves is seen by a camera: dE goes along a line of CIELAB from that of dough
(82, 0, 22) to that of a burnt crust, and from there to XYZ for D65 and to sRGB.

The humidity is in g of water per kg of dry air: Annex D gives no unit, and no
relative humidity is possible at 210 degC. [A] marks an assumption.
"""

from math import exp

from fcl_sim.plant import Input, Output, Parameter, Plant, State, kernel

CELLS = 120
PRODUCT, MOISTURE, BROWNING = 0, CELLS, 2 * CELLS
ZONE_1, ZONE_2, HUMIDITY, TRAVELLED, LEFT_MOISTURE, LEFT_BROWNING = range(3 * CELLS, 3 * CELLS + 6)
"""Places of the states."""
LENGTH = 60.0
"""Of the belt in the oven, m."""
KELVIN, GAS = 273.15, 8.314
BAKER = "[A] handbook value"


def belt(name, unit, first, last, meaning, scale):
    """Return a state for each cell, its start value going from that of the first to that of the last."""
    step = (last - first) / (CELLS - 1)
    return tuple(State(f"{name}_{i}", unit, first + step * i, meaning, scale) for i in range(CELLS))


PLANT = Plant(
    name="oven",
    title="Tunnel oven with two zones",
    states=(
        *belt("product", "degC", 30.0, 170.0, "temperature of the product in a cell", 10.0),
        *belt("moisture", "1", 0.25, 0.03, "of the product in a cell, per dry mass", 0.1),
        *belt("browning", "1", 0.0, 0.0, "of the product in a cell", 0.1),
        State("zone_1", "degC", 210.0, "T1, of the air", scale=100.0),
        State("zone_2", "degC", 240.0, "T2, of the air", scale=100.0),
        State("water", "1", 0.060, "Y, of the air, per dry mass", scale=0.01),
        State("travelled", "m", 0.0, "way of the belt since the cells moved on"),
        State("left_moisture", "1", 0.013, "of the piece that left", scale=0.1),
        State("left_browning", "1", 0.4075, "of the piece that left", scale=0.1),
    ),
    inputs=(
        Input("heater_1", "%", "u1", start=55.0),
        Input("heater_2", "%", "u2", start=55.0),
        Input("belt", "m/min", "speed of the belt", start=10.0),
        Input("dough", "1", "X0, moisture of the dough, per dry mass", start=0.25),
        Input("sugar", "1", "of the recipe, 1 as usual", start=1.0),
        Input("outside", "g/kg", "Ya, humidity of the air that enters", start=8.0),
        Input("extraction", "1", "part of G that the damper lets through", start=1.0),
    ),
    outputs=(
        Output("temperature_1", "degC", "T1"),
        Output("temperature_2", "degC", "T2"),
        Output("humidity", "g/kg", "of the air"),
        Output("colour", "1", "dE of the piece that left"),
        Output("residual", "1", "moisture of the piece that left, per dry mass"),
        Output("red", "1", "of the piece that left, 0 to 255"),
        Output("green", "1", "of the piece that left, 0 to 255"),
        Output("blue", "1", "of the piece that left, 0 to 255"),
    ),
    parameters=(
        Parameter("heat_transfer", "W/kg K", 22.0, "HA, per dry mass", "[A] 44 W/(m2 K) a side, 4 kg/m2"),
        Parameter(
            "line_load",
            "kg/m",
            3.402,
            "dry mass on the belt",
            "[A] 0.567 kg/s at 10 m/min; about 4 kg/m2 on 85 % of 1 m",
            0.0,
        ),
        Parameter("solids_heat", "J/kg K", 1600.0, "cps", BAKER, 1.0),
        Parameter("water_heat", "J/kg K", 4180.0, "cpw", "handbook", 1.0),
        Parameter("latent_heat", "J/kg", 2.4e6, "LAM", "handbook", 0.0),
        Parameter("drying", "1/s", 0.0078, "KD0, at 105 degC", "[A] dries dough to 1.3 % in 6 min", 0.0),
        Parameter(
            "drying_energy", "J/mol", 40_000.0, "EAD", "[A] near the heat of evaporation, 43 kJ/mol", 0.0
        ),
        Parameter("browning", "1/s", 42_000.0, "kB0", "Zanoni, Peri, Bruno 1995, LWT 28:604", 0.0),
        Parameter("browning_energy", "J/mol", 64_151.0, "EB", "Zanoni, Peri, Bruno 1995, LWT 28:604", 0.0),
        Parameter("recipe", "1", 3.2, "SUG, against crumb", "[A] makes dE 21.2 of the nominal oven", 0.0),
        Parameter("zone_heat", "J/K", 1.4e6, "CZ, of a zone", "[A] a lag of about 400 s", 1.0),
        Parameter("heating", "W", 1.1e6, "Pmax, of a zone", "[A] 55 % of it at rest", 0.0),
        Parameter("wall", "W/K", 600.0, "UA, of a zone", "[A] a fifth of the heat at rest", 0.0),
        Parameter("exchange", "W/K", 340.0, "KX, between the zones", "[A] 10 kW at rest", 0.0),
        Parameter("air", "kg/s", 2.55, "G, dry air in and out", "[A] keeps the air at 61 g/kg", 0.0),
        Parameter("air_heat", "J/kg K", 1050.0, "cp, of air", "handbook", 1.0),
        Parameter("air_mass", "kg", 35.0, "Mair, dry air in the oven", "[A] renewed in 14 s", 0.1),
        Parameter("ambient", "degC", 20.0, "Ta", "[A] room temperature"),
        Parameter("dough_temperature", "degC", 30.0, "of what enters", "[A] somewhat above the room"),
    ),
)


def dynamics(t, x, u, p, mode, dx):
    """Heat, dry and brown each cell; balance the zones and the water of the air."""
    length = LENGTH / CELLS
    load = p[1] * length
    water = x[HUMIDITY]
    equilibrium = 0.2 * water
    evaporated = 0.0
    for zone in range(2):
        air = x[ZONE_1 + zone]
        drawn = 0.0
        first = zone * (CELLS // 2)
        for i in range(first, first + CELLS // 2):
            product, moisture = x[PRODUCT + i], x[MOISTURE + i]
            rate = p[5] * exp(-p[6] / GAS * (1.0 / (product + KELVIN) - 1.0 / 378.15))
            drying = rate * max(0.0, moisture - equilibrium)
            heat = p[0] * (air - product)
            surface = product + 0.22 * (air - product) + KELVIN
            wet = moisture / 0.1
            browning = u[4] * p[9] * p[7] * exp(-p[8] / (GAS * surface)) / (1.0 + wet * wet)
            dx[PRODUCT + i] = (heat - p[4] * drying) / (p[2] + p[3] * moisture)
            dx[MOISTURE + i] = -drying
            dx[BROWNING + i] = browning * (1.0 - x[BROWNING + i])
            drawn += heat
            evaporated += drying
        ambient = p[12] + 0.5 * p[14] * u[6] * p[15]
        heating = p[11] * u[zone] / 100.0
        across = p[13] * (x[ZONE_2 - zone] - air)
        dx[ZONE_1 + zone] = (heating - ambient * (air - p[17]) - load * drawn + across) / p[10]
    dx[HUMIDITY] = (load * evaporated - p[14] * u[6] * (water - u[5] / 1000.0)) / p[16]
    dx[TRAVELLED] = u[2] / 60.0
    dx[LEFT_MOISTURE] = 0.0
    dx[LEFT_BROWNING] = 0.0


@kernel
def unfolded(value):
    """Inverse of the cube root of CIELAB, straight near 0."""
    return value * value * value if value > 6.0 / 29.0 else 108.0 / 841.0 * (value - 4.0 / 29.0)


@kernel
def byte(linear):
    """Value of sRGB, 0 to 255, of a linear one of 0 to 1."""
    bounded = min(max(linear, 0.0), 1.0)
    return 255.0 * (12.92 * bounded if bounded <= 0.0031308 else 1.055 * bounded ** (1.0 / 2.4) - 0.055)


def outputs(t, x, u, p, mode, y):
    """Give temperatures, humidity, and what a camera sees of the piece that left."""
    difference = 52.0 * x[LEFT_BROWNING]
    along = x[LEFT_BROWNING]
    lightness = 82.0 - 0.86 * difference
    redness = 0.50 * difference * (1.0 - 0.35 * along)
    yellowness = 22.0 + 0.45 * difference * (1.0 - 1.25 * along)
    grey = (lightness + 16.0) / 116.0
    big_x = 0.95047 * unfolded(grey + redness / 500.0)
    big_y = unfolded(grey)
    big_z = 1.08883 * unfolded(grey - yellowness / 200.0)
    y[0] = x[ZONE_1]
    y[1] = x[ZONE_2]
    y[2] = 1000.0 * x[HUMIDITY]
    y[3] = difference
    y[4] = x[LEFT_MOISTURE]
    y[5] = byte(3.2404542 * big_x - 1.5371385 * big_y - 0.4985314 * big_z)
    y[6] = byte(-0.9692660 * big_x + 1.8760108 * big_y + 0.0415560 * big_z)
    y[7] = byte(0.0556434 * big_x - 0.2040259 * big_y + 1.0572252 * big_z)


def sample(t, x, u, p):
    """Move the cells on by as many places as the belt has gone; what leaves is seen, dough enters."""
    length = LENGTH / CELLS
    while x[TRAVELLED] >= length:
        x[TRAVELLED] -= length
        x[LEFT_MOISTURE] = x[MOISTURE + CELLS - 1]
        x[LEFT_BROWNING] = x[BROWNING + CELLS - 1]
        for i in range(CELLS - 1, 0, -1):
            x[PRODUCT + i] = x[PRODUCT + i - 1]
            x[MOISTURE + i] = x[MOISTURE + i - 1]
            x[BROWNING + i] = x[BROWNING + i - 1]
        x[PRODUCT] = p[18]
        x[MOISTURE] = u[3]
        x[BROWNING] = 0.0
