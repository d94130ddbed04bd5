"""The same loops in engines that are not ours: python-control, pathsim, and SciPy's DOP853."""

from itertools import pairwise
from math import cos, pi, radians, sin, sqrt

import control
import numpy as np
import pytest
from pathsim import Connection, Simulation
from pathsim.blocks import ODE, Wrapper
from pathsim.solvers import RKDP87
from scipy.integrate import solve_ivp

from fcl_sim.loop.diagram import Diagram, Integration, PlantNode, Wire
from fcl_sim.loop.run import run
from fcl_sim.plant.catalog import find
from fcl_sim.plant.linear import transfer_function, zero_pole_gain
from tests.loop.block_loops import node
from tests.loop.diagrams import BENCH, plant_of, timing
from tests.loop.linear_loops import simulated

TS = 0.1
PLANTS = {
    "second order": (transfer_function([1.0, 3.0], [1.0, 0.8, 4.0]), control.tf([1, 3], [1, 0.8, 4])),
    "non-minimum phase": (
        zero_pole_gain([0.5 + 0j], [-1.0 + 0j] * 3, -2.0),
        control.zpk([0.5], [-1, -1, -1], -2),
    ),
    "eight lags": (zero_pole_gain([], [-1.0 + 0j] * 8, 1.0), control.zpk([], [-1] * 8, 1)),
    "integrator": (transfer_function([1.0], [1.0, 2.0, 0.0]), control.tf([1], [1, 2, 0])),
}


@pytest.mark.parametrize("delay", [0, 4])
@pytest.mark.parametrize("name", PLANTS)
def test_an_open_loop_is_the_forced_response_of_python_control(name, delay):
    ours, theirs = PLANTS[name]
    trace = simulated(
        ours, timing(100.0, 20.0), node("u", "sine", frequency="0.2 Hz", offset=0.3), delay=delay * TS
    )
    u = np.concatenate([np.zeros(delay), trace["plant.u"]])[: trace.time.size]
    sampled = control.sample_system(control.ss(theirs), TS, method="zoh")
    response = control.forced_response(sampled, trace.time, u)
    assert trace["plant.y"] == pytest.approx(response.outputs, abs=1e-11)


@pytest.mark.parametrize("name", PLANTS)
def test_a_closed_loop_under_a_pi_is_that_of_python_control(name):
    ours, theirs = PLANTS[name]
    gain, time = 0.3, 2.0
    trace = simulated(
        ours,
        timing(100.0, 20.0),
        node("one", "constant", value=1.0),
        node("u", "pid", {"setpoint": "one", "measurement": "plant.y"}, Kc=gain, Ti=f"{time} s"),
    )
    sampled = control.sample_system(control.ss(theirs), TS, method="zoh", inputs="u", outputs="y")
    pi_controller = control.ss(
        [[1.0]], [[1.0, -1.0]], [[gain * TS / time]], [[gain * (1 + TS / time), -gain * (1 + TS / time)]],
        TS, inputs=["r", "y"], outputs="u",
    )  # fmt: skip
    loop = control.interconnect([sampled, pi_controller], inputs=["r"], outputs=["y", "u"])
    response = control.input_output_response(loop, trace.time, np.ones(trace.time.size))
    assert trace["plant.y"] == pytest.approx(response.outputs[0], abs=1e-10)
    assert trace["plant.u"] == pytest.approx(response.outputs[1], abs=1e-10)


CONE = """
PLANT = Plant(
    name="cone", title="conical tank with a free outlet",
    states=(State("level", "m", 0.5, "h"),),
    inputs=(Input("inflow", "m3/s", "q"),), outputs=(Output("level", "m", "h"),),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = (u[0] - 0.02 * sqrt(x[0])) / (pi * (0.5 * x[0]) ** 2)

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
"""


def test_a_conical_tank_under_a_limited_controller_is_that_of_pathsim(tmp_path):
    plant = PlantNode(name="tank", model=plant_of(tmp_path, CONE), inputs={"inflow": Wire("inflow")})
    nodes = (
        node("one", "constant", value="1.32 m"),
        node("wanted", "sum", {"one": "one", "level": "tank.level"}, one="0.1 m2/s", level="-0.1 m2/s"),
        node("inflow", "limiter", {"input": "wanted"}, low="0 m3/s", high="0.05 m3/s"),
    )
    trace = run(
        Diagram(plant=plant, nodes=nodes, timing=timing(500.0, 60.0), integration=Integration(rtol=1e-12))
    )

    levels = []

    def inflow(level):
        levels.append(float(level))
        return min(max(0.1 * (1.32 - level), 0.0), 0.05)

    def rise(x, u, _):
        return np.array([(u[0] - 0.02 * np.sqrt(x[0])) / (pi * (0.5 * x[0]) ** 2)])

    tank, controller = ODE(rise, np.array([0.5])), Wrapper(inflow, T=0.5)
    wires = [Connection(tank, controller), Connection(controller, tank)]
    accuracy = {"tolerance_lte_abs": 1e-13, "tolerance_lte_rel": 1e-12}
    Simulation([tank, controller], wires, dt=0.1, Solver=RKDP87, log=False, **accuracy).run(60.0)
    assert len(levels) == trace.time.size
    assert trace["tank.level"] == pytest.approx(levels, abs=1e-11)
    assert set(np.diff(trace["inflow"]) == 0.0) == {True, False}  # limited at first, and then no more


def crane_moves(t, x, power):
    """The crane without friction, from the equations of its page."""
    _, v, theta, w, force = x
    swing = 9.81 * sin(theta) + 2 * 0.005 * sqrt(98.1) * w
    dv = (force + 20e3 * (10 * w * w * sin(theta) + cos(theta) * swing)) / (35e3 - 20e3 * cos(theta) ** 2)
    asked = 1000 * power / max(abs(v), 1.0)
    fading = max(0.0, 5e4 * (2.5 - v)) if asked > 0 else min(0.0, -5e4 * (2.5 + v))
    asked = min(asked, fading) if asked > 0 else max(asked, fading)
    grip = 0.12 * 35e3 * 9.81
    return [v, dv, w, -(dv * cos(theta) + swing) / 10, (min(max(asked, -grip), grip) - force) / 0.1]


def test_the_crane_under_a_simple_controller_is_that_of_dop853():
    plant = PlantNode(
        name="crane",
        model=find("crane", BENCH),
        parameters={"rolling_resistance": 0.0, "viscous_friction": 0.0},
        start={"position": -5.0, "angle": radians(4.0)},
        inputs={"power": Wire("power")},
    )
    terms = {"distance": "crane.distance", "speed": "crane.speed", "angle": "crane.angle"}
    gains = {"distance": "1.5 kW/m", "speed": "-4 kW s/m", "angle": "1 kW/deg"}
    nodes = (node("power", "sum", terms, **gains),)
    trace = run(
        Diagram(plant=plant, nodes=nodes, timing=timing(50.0, 20.0), integration=Integration(rtol=1e-12))
    )
    assert trace.fault is None

    x = np.array([-5.0, 0.0, radians(4.0), 0.0, 0.0])
    states = [x]
    for begin, end in pairwise(trace.time):
        power = 1.5 * -x[0] - 4.0 * x[1] + np.degrees(x[2])
        x = solve_ivp(crane_moves, (begin, end), x, "DOP853", rtol=1e-12, atol=1e-12, args=(power,)).y[:, -1]
        states.append(x)
    position, speed, angle = np.array(states).T[:3]
    assert trace["crane.position"] == pytest.approx(position, abs=1e-9)
    assert trace["crane.speed"] == pytest.approx(speed, abs=1e-9)
    assert np.radians(trace["crane.angle"]) == pytest.approx(angle, abs=1e-10)
    assert np.ptp(position) > 4.0
