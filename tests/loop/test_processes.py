"""Small nonlinear processes against their closed forms, as a plant file would have them."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from fcl_sim.loop.diagram import Integration, PlantNode, Wire
from fcl_sim.loop.run import run
from tests.loop.block_loops import node
from tests.loop.diagrams import alone, plant_of, timing

FINE = Integration(rtol=1e-12)

TANK = """
PLANT = Plant(
    name="tank", title="a tank that drains through a hole",
    states=(State("level", "m", 0.8, "h"), State("empty_at", "s", -1.0, "when")),
    inputs=(), outputs=(Output("level", "m", "h"), Output("empty_at", "s", "when it was empty, -1 before")),
    modes=(Mode("drains", ""), Mode("empty", "")),
    events=(Event("empties", FALLING, "no water is left above the hole"),),
)
FLOW, LEAST = 4e-4, 1e-6

def dynamics(t, x, u, p, mode, dx):
    dx[0] = -FLOW * sqrt(x[0]) / AREA if mode == 0 else 0.0
    dx[1] = 0.0

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
    y[1] = x[1]

def events(t, x, u, p, mode, g):
    g[0] = x[0] - LEAST if mode == 0 else 1.0

def transition(i, t, x, u, p, mode):
    if i == 0:
        x[1] = t
    return i + 1
"""
FLOW, HEIGHT, LEAST = 4e-4, 0.8, 1e-6
CYLINDER, CONE = "0.03", "(pi * (0.25 * x[0]) ** 2)"


def drained(folder, area, seconds):
    trace = run(alone(plant_of(folder, TANK.replace("AREA", area)), timing(500.0, seconds), FINE))
    assert trace.fault is None
    return trace


def test_a_cylinder_drains_as_the_square_of_the_time_that_is_left(tmp_path):
    trace = drained(tmp_path, CYLINDER, 150.0)
    root = np.sqrt(HEIGHT) - FLOW * trace.time / (2 * 0.03)
    ends = (np.sqrt(HEIGHT) - np.sqrt(LEAST)) * 2 * 0.03 / FLOW
    full = trace.time < ends
    assert trace["plant.level"][full] == pytest.approx(root[full] ** 2, abs=1e-8)
    assert trace["plant.level"][~full] == pytest.approx(LEAST, abs=1e-8)
    assert trace["plant.empty_at"][-1] == pytest.approx(ends, abs=1e-8)


def test_a_cone_drains_as_its_level_to_the_power_of_five_halves(tmp_path):
    trace = drained(tmp_path, CONE, 120.0)
    power = HEIGHT**2.5 - 2.5 * FLOW * trace.time / (pi * 0.25**2)
    ends = (HEIGHT**2.5 - LEAST**2.5) * pi * 0.25**2 / (2.5 * FLOW)
    full = trace.time < ends - 0.5  # the last half second falls ever faster
    assert trace["plant.level"][full] == pytest.approx(power[full] ** 0.4, abs=1e-8)
    assert trace["plant.empty_at"][-1] == pytest.approx(ends, abs=1e-8)


VESSEL = """
PLANT = Plant(
    name="vessel", title="a rigid vessel without heat losses, filled with a gas",
    states=(State("mass", "kg", 2.0, "m"), State("temperature", "K", 278.0, "T", scale=100.0)),
    inputs=(Input("inflow", "kg/s", "w"),),
    outputs=(Output("mass", "kg", "m"), Output("temperature", "K", "T")),
)
CP, CV, INLET = 1005.0, 717.95, 313.0

def dynamics(t, x, u, p, mode, dx):
    dx[0] = u[0]
    dx[1] = (u[0] * CP * INLET - CV * x[1] * u[0]) / (x[0] * CV)

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
    y[1] = x[1]
"""


def test_a_vessel_that_is_filled_without_losses_warms_by_the_work_of_what_flows_in(tmp_path):
    plant = PlantNode(name="plant", model=plant_of(tmp_path, VESSEL), inputs={"inflow": Wire("inflow")})
    swings = node("inflow", "sine", amplitude="0.02 kg/s", frequency="0.05 Hz", offset="0.03 kg/s")
    loop = replace(alone(plant.model, timing(500.0, 120.0), FINE), plant=plant, nodes=(swings,))
    trace = run(loop)
    mass, inlet, ratio = trace["plant.mass"], 313.0, 1005.0 / 717.95
    expected = (2.0 * 278.0 + ratio * inlet * (mass - 2.0)) / mass
    assert mass[-1] > 5.0
    assert trace["plant.temperature"] == pytest.approx(expected, rel=1e-8)


BROWNING = """
PLANT = Plant(
    name="crust", title="browning at one temperature",
    states=(State("colour", "1", 0.0, "B"),), inputs=(), outputs=(Output("colour", "1", "B"),),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = 0.02 * (1.0 - x[0])

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
"""


def test_at_one_temperature_what_is_not_yet_brown_fades_exponentially(tmp_path):
    trace = run(alone(plant_of(tmp_path, BROWNING), timing(1000.0, 300.0), FINE))
    assert trace["plant.colour"] == pytest.approx(-np.expm1(-0.02 * trace.time), abs=1e-11)


BELT = """
CELLS = 50

PLANT = Plant(
    name="belt", title="a belt of cells that are shifted at the scans",
    states=(
        State("offset", "m", 0.0, "since the last shift"), State("way", "m", 0.0, "of the belt"),
        State("mark", "1", 0.0, "what is put on it"),
        *(State(f"cell{i}", "1", 0.0, "") for i in range(CELLS)),
    ),
    inputs=(Input("speed", "m/s", "of the belt"), Input("mark", "1", "what is put on it")),
    outputs=(Output("way", "m", "of the belt"), Output("out", "1", "what arrives at its end")),
    parameters=(Parameter("length", "m", 5.0, "of the belt", "[A]"),),
)

def dynamics(t, x, u, p, mode, dx):
    for i in range(3 + CELLS):
        dx[i] = 0.0
    dx[0] = u[0]
    dx[1] = u[0]
    dx[2] = (u[1] - x[2]) / 1e-3

def outputs(t, x, u, p, mode, y):
    y[0] = x[1]
    y[1] = x[3 + CELLS - 1]

def sample(t, x, u, p):
    while x[0] >= p[0] / CELLS:
        x[0] -= p[0] / CELLS
        for i in range(3 + CELLS - 1, 3, -1):
            x[i] = x[i - 1]
        x[3] = x[2]
"""


def test_what_is_put_on_a_belt_arrives_when_the_belt_has_moved_by_its_length(tmp_path):
    plant = PlantNode(
        name="plant",
        model=plant_of(tmp_path, BELT),
        inputs={"speed": Wire("speed"), "mark": Wire("mark")},
    )
    nodes = (
        node("speed", "sine", amplitude="0.2 m/s", frequency="0.05 Hz", offset="0.3 m/s"),
        node("mark", "step", before=0.0, after=1.0, at="8 s"),
    )
    trace = run(replace(alone(plant.model, timing(10.0, 40.0)), plant=plant, nodes=nodes))
    way, time = trace["plant.way"], trace.time
    speed = 0.2 * np.sin(0.1 * pi * time) + 0.3
    moved = np.concatenate([[0.0], np.cumsum(speed[:-1] * 0.01)])
    assert way == pytest.approx(moved, abs=1e-12)
    arrived = int(np.argmax(trace["plant.out"] > 0.5))
    put_on = int(np.searchsorted(time, 8.0))
    cell = 5.0 / 50
    assert way[arrived] - way[put_on] == pytest.approx(5.0, abs=cell + 0.5 * 0.01)


PENDULUM = """
PLANT = Plant(
    name="pendulum", title="a load on a cable below a trolley with prescribed acceleration",
    states=(State("angle", "rad", 0.0, "th"), State("rate", "rad/s", 0.0, "w")),
    inputs=(Input("acceleration", "m/s2", "of the trolley"),),
    outputs=(Output("sway", "1", "amplitude of the swing in rad"), Output("angle", "1", "in rad")),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = x[1]
    dx[1] = -(u[0] * cos(x[0]) + 9.81 * sin(x[0])) / 10.0

def outputs(t, x, u, p, mode, y):
    y[0] = sqrt(x[0] ** 2 + x[1] ** 2 * 10.0 / 9.81)
    y[1] = x[0]
"""
NATURAL = np.sqrt(9.81 / 10.0)


def swing(folder, acceleration, seconds):
    """Return the trace of a load at rest whose trolley accelerates for so long."""
    plant = PlantNode(name="plant", model=plant_of(folder, PENDULUM), inputs={"acceleration": Wire("a")})
    node_ = node("a", "step", before=f"{acceleration} m/s2", after="0 m/s2", at=f"{seconds} s")
    return run(replace(alone(plant.model, timing(5.0, 30.0), FINE), plant=plant, nodes=(node_,)))


@pytest.mark.parametrize("seconds", [1.0, 3.17, 5.0])
def test_a_pulse_of_acceleration_leaves_the_sway_of_its_closed_form(tmp_path, seconds):
    trace = swing(tmp_path, 1e-3, seconds)
    left = 2 * 1e-3 / 9.81 * abs(np.sin(NATURAL * seconds / 2))
    after = trace.time >= seconds
    # Of the pendulum's own equation the linear one leaves out terms of the third order.
    assert trace["plant.sway"][after] == pytest.approx(left, rel=1e-6)


def test_a_pulse_as_long_as_the_period_leaves_no_sway(tmp_path):
    whole = 6.345  # the scan next to the period of 6.34374 s
    trace = swing(tmp_path, 1e-3, whole)
    left = 2 * 1e-3 / 9.81 * abs(np.sin(NATURAL * whole / 2))
    assert left < 1e-3 * 2e-3 / 9.81
    assert trace["plant.sway"][-1] == pytest.approx(left, abs=1e-11)


def test_under_constant_acceleration_a_load_swings_between_zero_and_twice_its_plumb_angle(tmp_path):
    trace = swing(tmp_path, 0.5, 30.0)
    assert trace["plant.angle"].max() == 0.0
    assert trace["plant.angle"].min() == pytest.approx(-2 * np.arctan(0.5 / 9.81), rel=1e-5)
