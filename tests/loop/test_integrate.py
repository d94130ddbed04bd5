"""The integrator: its order, its tolerance, its events, and how it gives up."""

from math import exp, log2, sqrt

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from fcl_sim.loop.diagram import Integration
from fcl_sim.loop.run import run
from fcl_sim.loop.schemes import SCHEMES
from tests.loop.diagrams import alone, crane_alone, plant_of, timing

OSCILLATOR = """
PLANT = Plant(
    name="oscillator", title="harmonic oscillator",
    states=(State("x", "m", 1.0, "place"), State("v", "m/s", 0.0, "speed")),
    inputs=(), outputs=(Output("place", "m", "x"),),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = x[1]
    dx[1] = -x[0]

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
"""

BALL = """
PLANT = Plant(
    name="ball", title="bouncing ball",
    states=(State("height", "m", 1.0, "h"), State("speed", "m/s", 0.0, "v")),
    inputs=(), outputs=(Output("height", "m", "h"), Output("speed", "m/s", "v")),
    parameters=(Parameter("bounce", "1", 0.8, "part of the speed kept", "[A]"),),
    events=(Event("bounces", FALLING, "the ball meets the ground"),),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = x[1]
    dx[1] = -10.0

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
    y[1] = x[1]

def events(t, x, u, p, mode, g):
    g[0] = x[0]

def transition(i, t, x, u, p, mode):
    if i == 0:
        x[0] = 0.0
        x[1] = -p[0] * x[1]
    return 0
"""

GROWTH = """
PLANT = Plant(
    name="growth", title="grows without bound in finite time",
    states=(State("size", "m", 1.0 / 0.995, "x"),), inputs=(), outputs=(Output("out", "m", "x"),),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = x[0] * x[0]

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
"""

ROOT = """
PLANT = Plant(
    name="drain", title="the root of a falling level",
    states=(State("level", "m", 1.0, "x"),), inputs=(), outputs=(Output("root", "m", "sqrt(x)"),),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = -1.0

def outputs(t, x, u, p, mode, y):
    y[0] = sqrt(x[0])
"""

CHATTER = """
PLANT = Plant(
    name="chatter", title="two regimes that drive at each other",
    states=(State("x", "m", 1.0, "x"),), inputs=(), outputs=(Output("out", "m", "x"),),
    modes=(Mode("above", ""), Mode("below", "")),
    events=(Event("falls", FALLING, "to below"), Event("rises", RISING, "to above")),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = -1.0 if mode == 0 else 1.0

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]

def events(t, x, u, p, mode, g):
    g[0] = x[0] if mode == 0 else 1.0
    g[1] = x[0] if mode == 1 else -1.0

def transition(i, t, x, u, p, mode):
    if i < 0:
        return 0
    return 1 if i == 0 else 0
"""


def error_of(model, scheme, scan_ms):
    # A loose tolerance makes every step as long as the scan, so the scheme shows its own order.
    integration = Integration(scheme=scheme, rtol=1e6, step=1.0)
    trace = run(alone(model, timing(scan_ms, 6.0), integration))
    return np.abs(trace["plant.place"] - np.cos(trace.time)).max()


@pytest.mark.parametrize("name", SCHEMES)
def test_halving_the_step_shows_the_declared_order_of_a_scheme(name, tmp_path):
    model = plant_of(tmp_path, OSCILLATOR)
    errors = [error_of(model, name, scan) for scan in (200.0, 100.0, 50.0)]
    orders = [log2(errors[i] / errors[i + 1]) for i in range(2)]
    assert orders == pytest.approx([SCHEMES[name].order] * 2, abs=0.25)


def oscillators(number, moving):
    """Return the text of so many oscillators, two states each, moved by the lines of `moving`."""
    states = ", ".join(
        f'State("x{n}", "m", {n + 1.0}, "place"), State("v{n}", "m/s", 0.0, "speed")' for n in range(number)
    )
    lines = "\n".join(f"    {line.format(x=2 * n, v=2 * n + 1)}" for n in range(number) for line in moving)
    return f"""
import numpy as np
PLANT = Plant(
    name="oscillators", title="harmonic oscillators", states=({states}),
    inputs=(), outputs=(Output("place", "m", "of the last"),),
)

def dynamics(t, x, u, p, mode, dx):
{lines}

def outputs(t, x, u, p, mode, y):
    y[0] = x[{2 * number - 2}]
"""


SINGLY = ("dx[{x}] = x[{v}]", "dx[{v}] = -x[{x}]")


@pytest.mark.parametrize("scheme", SCHEMES)
def test_a_state_moves_alike_among_any_number_of_others(scheme, tmp_path):
    places = []
    for number in (1, 2, 3, 4, 5):
        model = plant_of(tmp_path, oscillators(number, SINGLY), f"of_{number}")
        # a fixed step: one of step control would be as short as the largest swing needs it
        integration = Integration(scheme=scheme, rtol=1e6, step=0.05)
        trace = run(alone(model, timing(50.0, 3.0), integration))
        places.append(trace["plant.place"] / number)
    assert np.abs(places - places[0]).max() < 1e-14


@pytest.mark.parametrize("scheme", SCHEMES)
def test_a_plant_may_work_in_arrays_of_its_own(scheme, tmp_path):
    through_an_array = ("way = np.zeros(2)", "way[0] = x[{v}]", "dx[{x}] = way[0]", "dx[{v}] = -x[{x}]")
    integration = Integration(scheme=scheme, step=0.05)
    with_it, without = (
        run(alone(plant_of(tmp_path, oscillators(2, moving), name), timing(50.0, 3.0), integration)).values
        for name, moving in (("own", through_an_array), ("none", SINGLY))
    )
    assert np.array_equal(with_it, without)


@pytest.mark.parametrize("name", SCHEMES)
def test_the_rows_of_a_scheme_are_consistent_with_its_nodes(name):
    scheme = SCHEMES[name]
    sums = [0.0, *(sum(row) for row in scheme.rows)]
    assert sums == pytest.approx(scheme.nodes, abs=1e-14)
    assert sum(scheme.error) == pytest.approx(0.0, abs=1e-15)


def test_a_tighter_tolerance_brings_the_solution_nearer_in_proportion(tmp_path):
    model = plant_of(tmp_path, OSCILLATOR)
    errors = []
    for rtol in (1e-4, 1e-6, 1e-8, 1e-10):
        trace = run(alone(model, timing(2000.0, 20.0), Integration(rtol=rtol)))
        errors.append(np.abs(trace["plant.place"] - np.cos(trace.time)).max())
        assert errors[-1] <= 20 * rtol
    assert errors == sorted(errors, reverse=True)


def test_the_crane_agrees_with_another_integrator():
    parameters = {"rolling_resistance": 0.0, "viscous_friction": 0.0}
    start = {"position": 0.0, "angle": 0.3}
    trace = run(crane_alone(timing(100.0, 10.0), parameters, start, power=5.0))

    def right_hand_side(t, x):
        _, v, theta, w, force = x
        swing = 9.81 * np.sin(theta) + 2 * 0.005 * sqrt(98.1) * w
        net = force + 20e3 * (10 * w * w * np.sin(theta) + np.cos(theta) * swing)
        dv = net / (35e3 - 20e3 * np.cos(theta) ** 2)
        asked = min(5000 / max(abs(v), 1.0), max(0.0, 5e4 * (2.5 - v)))
        return [v, dv, w, -(dv * np.cos(theta) + swing) / 10, (asked - force) / 0.1]

    other = solve_ivp(
        right_hand_side, (0, 10), [0, 0, 0.3, 0, 0], "DOP853", trace.time, rtol=1e-12, atol=1e-12
    )
    assert np.abs(trace["crane.position"] - other.y[0]).max() <= 1e-8
    assert np.abs(np.radians(trace["crane.angle"]) - other.y[2]).max() <= 1e-9


def bounces(t, keep):
    """Height and speed of a ball dropped from 1 m under 10 m/s2, from the times of its bounces."""
    speed, begin = sqrt(20.0), sqrt(0.2)
    if t < begin:
        return 1 - 5 * t * t, -10 * t
    while True:
        speed *= keep
        flight = speed / 5
        if t < begin + flight:
            s = t - begin
            return speed * s - 5 * s * s, speed - 10 * s
        begin += flight


def test_a_bouncing_ball_is_where_its_closed_form_says_it_is(tmp_path):
    trace = run(alone(plant_of(tmp_path, BALL), timing(10.0, 3.0)))
    expected = np.array([bounces(t, 0.8) for t in trace.time])
    assert trace.fault is None
    assert np.abs(trace["plant.height"] - expected[:, 0]).max() <= 1e-9
    assert np.abs(trace["plant.speed"] - expected[:, 1])[np.abs(expected[:, 0]) > 1e-6].max() <= 1e-8


def test_a_ball_that_comes_to_rest_by_ever_shorter_bounces_ends_in_a_fault_not_a_hang(tmp_path):
    diagram = alone(plant_of(tmp_path, BALL), timing(10.0, 10.0))
    trace = run(diagram)
    assert trace.fault is not None
    assert trace.fault.signal == "plant.bounces"
    assert trace.fault.reason == "the event `bounces` of `plant` happens over and over without time passing"
    rest = sqrt(0.2) + 2 * sqrt(20.0) * 0.8 / 0.2 / 10
    assert trace.time[-1] == pytest.approx(rest, abs=0.02)


def test_two_regimes_that_drive_at_each_other_end_in_a_fault(tmp_path):
    trace = run(alone(plant_of(tmp_path, CHATTER), timing(100.0, 5.0)))
    assert trace.fault is not None
    assert trace.time[-1] == pytest.approx(1.0, abs=0.1)


@pytest.mark.filterwarnings("ignore:(overflow|invalid value) encountered")  # uncompiled, NumPy says so
def test_a_state_that_grows_beyond_all_bounds_ends_in_a_fault_with_the_trace_up_to_there(tmp_path):
    trace = run(alone(plant_of(tmp_path, GROWTH), timing(10.0, 5.0)))
    assert trace.fault is not None
    assert trace.fault.signal == "plant.size"
    assert trace.time[-1] == pytest.approx(0.99, abs=1e-9)
    assert trace["plant.out"] == pytest.approx(1 / (0.995 - trace.time), rel=1e-6)


def test_a_signal_that_becomes_nan_ends_in_a_fault_that_names_it(tmp_path):
    trace = run(alone(plant_of(tmp_path, ROOT), timing(10.0, 5.0)))
    assert trace.fault is not None
    assert (trace.fault.signal, trace.fault.reason) == ("plant.root", "`plant.root` is NaN or infinite")
    assert trace.fault.tick == 1_010_000_000
    assert np.all(np.isfinite(trace.values))


def test_a_stiff_plant_costs_steps_but_keeps_its_tolerance(tmp_path):
    text = OSCILLATOR.replace("dx[0] = x[1]", "dx[0] = -1000.0 * (x[0] - cos(t))").replace(
        "dx[1] = -x[0]", "dx[1] = 0.0"
    )
    trace = run(alone(plant_of(tmp_path, text), timing(100.0, 1.0)))
    t = trace.time
    exact = (1e6 * np.cos(t) + 1e3 * np.sin(t) + exp(0.0) * np.exp(-1000 * t)) / (1e6 + 1)
    assert np.abs(trace["plant.place"] - exact).max() <= 1e-7


THRESHOLD = """
PLANT = Plant(
    name="tank", title="counts how often its level rises through one metre",
    states=(State("level", "m", 0.0, "level"), State("count", "1", 0.0, "risings")),
    inputs=(), outputs=(Output("level", "m", "level"), Output("count", "1", "risings")),
    events=(Event("full", RISING, "the level rises through one metre"),),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = 1.0 if t < 2.0 or t >= 4.0 else -1.0
    dx[1] = 0.0

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
    y[1] = x[1]

def events(t, x, u, p, mode, g):
    g[0] = x[0] - 1.0

def transition(i, t, x, u, p, mode):
    if i == 0:
        x[1] += 1.0
    return 0
"""


def test_an_event_that_stays_beyond_zero_happens_once_until_it_is_back(tmp_path):
    # The level rises through 1 m at 1 s, falls through it at 3 s and rises through it again at 5 s.
    trace = run(alone(plant_of(tmp_path, THRESHOLD), timing(70.0, 6.0)))
    expected = np.where(trace.time > 5.0, 2.0, np.where(trace.time > 1.0, 1.0, 0.0))
    assert trace["plant.count"].tolist() == expected.tolist()
