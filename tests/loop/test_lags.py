"""Lags and dead times against closed forms, and against a plant that the integrator solves."""

import math

import numpy as np
import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.diagram import Diagram, Integration, PlantNode, Wire
from fcl_sim.loop.run import empty_record, proceed, run, run_tape, trace_of
from fcl_sim.loop.state import initial_state
from fcl_sim.loop.tape import lower
from fcl_sim.loop.wiring import wire
from tests.loop.block_bench import Alone, diagram
from tests.loop.block_loops import CYCLE, fopdt, node
from tests.loop.diagrams import plant_of, timing

FIRST_ORDER = """
PLANT = Plant(
    name="lag", title="first order",
    states=(State("x", "m", 0.0, "level"),),
    inputs=(Input("u", "m", "level to go to"),), outputs=(Output("x", "m", "level"),),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = 2.0 * (3.0 * u[0] - x[0])

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
"""
LAG, GAIN = 0.5, 3.0

JITTER = {"jitter": 15 * 10**6, "seed": 4, "measured": True}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("lags")


def refusal(folder, *nodes):
    with pytest.raises(InputFault) as caught:
        wire(diagram(folder, *nodes))
    return str(caught.value)


def step_response(folder, kind, further=None, **parameters):
    """Return time since the first scan and the answer to a step from 0 to 1 at the first scan."""
    nodes = (
        node("one", "constant", value=1.0),
        node("answer", kind, {"input": "one"}, **parameters),
    )
    trace = run(diagram(folder, *nodes, **(further or {})))
    return trace.time[:-1] - trace.time[0], trace["answer"][:-1]  # the end of a run is not late


@pytest.mark.parametrize("timing", [{}, JITTER], ids=["even", "jitter"])
def test_a_lag_behind_a_hold_is_on_the_exponential_at_every_scan_however_they_are_spaced(folder, timing):
    time, answer = step_response(folder, "first_order_lag", timing, time_constant="0.4 s")
    assert answer == pytest.approx(-np.expm1(-time / 0.4), abs=4e-15)


@pytest.mark.parametrize("timing", [{}, JITTER], ids=["even", "jitter"])
@pytest.mark.parametrize("damping", [0.0, 0.3, 1.0, 2.5])
def test_a_second_order_lag_is_on_its_step_response_at_every_scan(folder, damping, timing):
    time, answer = step_response(
        folder, "second_order_lag", timing, natural_frequency="4 rad/s", damping=damping
    )
    w, root = 4.0, np.emath.sqrt(1.0 - damping**2)
    if damping == 1.0:
        expected = 1.0 - np.exp(-w * time) * (1.0 + w * time)
    else:
        swing = np.cos(w * root * time) + damping / root * np.sin(w * root * time)
        expected = np.real(1.0 - np.exp(-damping * w * time) * swing)
    assert answer == pytest.approx(expected, abs=1e-13)


def test_a_lead_lag_jumps_by_its_ratio_and_settles_at_gain_1(folder):
    time, answer = step_response(folder, "lead_lag", lead="0.6 s", lag="0.2 s")
    assert answer == pytest.approx(1.0 + 2.0 * np.exp(-time / 0.2), abs=1e-14)


@pytest.mark.parametrize(("method", "order"), [("backward", 1), ("trapezoidal", 2)])
def test_a_discretised_lag_nears_the_differential_equation_with_the_order_of_its_method(
    folder, method, order
):
    lag, loop = (
        0.5,
        diagram(
            folder,
            node("lag", "first_order_lag", {"input": "signals.wave"}, time_constant="0.5 s", method=method),
        ),
    )
    exact = (math.sin(1.0) - lag * math.cos(1.0) + lag * math.exp(-1.0 / lag)) / (1 + lag**2)
    errors = []
    for scans in (100, 200):
        alone = Alone(loop)
        for n in range(scans + 1):
            (given,) = alone.step([math.sin(n / scans)], 1 / scans, n / scans, n)
        errors.append(abs(given - exact))
    assert math.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.02)


@pytest.mark.parametrize("delay", [0, 1, 7])
def test_first_order_plus_dead_time_follows_its_recursion(folder, delay):
    trace = run(diagram(folder, *fopdt(LAG, GAIN, delay * CYCLE, "signals.wave", "m")))
    u, y = trace["signals.wave"], trace["process"]
    a = math.exp(-CYCLE / LAG)
    for k in range(y.size - 1):
        before = u[k - delay] if k >= delay else 0.0
        assert y[k + 1] == pytest.approx(a * y[k] + (1 - a) * GAIN * before, abs=4e-15)


def test_first_order_plus_dead_time_answers_a_step_by_the_exponential_after_the_dead_time(folder):
    nodes = (node("one", "constant", value=1.0), *fopdt(LAG, GAIN, 9 * CYCLE, "one"))
    trace = run(diagram(folder, *nodes))
    since = np.maximum(trace.time - 9 * CYCLE, 0.0)
    assert trace["process"] == pytest.approx(-GAIN * np.expm1(-since / LAG), abs=1e-14)


def by_fractional_recursion(u, whole, rest):
    """Return first order plus a dead time of `whole` scans and `rest` seconds, exact behind a hold."""
    a, late = math.exp(-CYCLE / LAG), math.exp(-(CYCLE - rest) / LAG)
    y = [0.0]
    for k in range(len(u) - 1):
        newer = u[k - whole] if k >= whole else 0.0
        older = u[k - whole - 1] if k > whole else 0.0
        y.append(a * y[-1] + GAIN * (1 - late) * newer + GAIN * (late - a) * older)
    return y


@pytest.mark.parametrize("rest", [0.005, 0.013])
def test_a_fraction_between_two_scans_gives_the_recursion_of_a_fractional_dead_time(folder, rest):
    a, late = math.exp(-CYCLE / LAG), math.exp(-(CYCLE - rest) / LAG)
    part = (late - a) / (1 - a)  # what the older value moves in a scan, as a share of both
    trace = run(diagram(folder, *fopdt(LAG, GAIN, (3 + part) * CYCLE, "signals.wave", "m")))
    expected = by_fractional_recursion(trace["signals.wave"], 3, rest)
    assert trace["process"] == pytest.approx(expected, abs=2e-14)


@pytest.mark.parametrize("rest", [0, 7])
def test_a_plant_behind_a_dead_time_and_a_latency_follows_the_same_recursion(folder, rest):
    nodes = (
        node("swing", "constant", value="1 m"),
        node("seen", "lead_lag", {"input": "swing"}, lead="0.1 s", lag="0.3 s"),
        node("command", "dead_time", {"input": "seen"}, time=f"{3 * CYCLE} s"),
    )
    plant = PlantNode(name="plant", model=plant_of(folder, FIRST_ORDER, "lag"), inputs={"u": Wire("command")})
    loop = Diagram(
        plant=plant,
        nodes=nodes,
        timing=timing(20.0, 3.0, latency=rest * 10**6),
        integration=Integration(rtol=1e-12),
    )
    trace = run(loop)
    expected = by_fractional_recursion(trace["seen"], 3, rest / 1000)
    assert trace["plant.x"] == pytest.approx(expected, abs=1e-10)


def test_a_dead_time_of_a_scan_or_more_breaks_an_algebraic_loop(folder):
    def around(**delay):
        return (
            node("error", "sum", {"a": "signals.wave", "b": "fed_back"}, a=1.0, b=-0.5),
            node("fed_back", "dead_time", {"input": "error"}, initial="0 m", **delay),
        )

    assert "WIR301" in refusal(folder, *around(time="15 ms"))
    trace = run(diagram(folder, *around(time="25 ms")))
    assert trace["fed_back"][2] == 0.75 * trace["error"][1] + 0.25 * trace["error"][0]
    varying = node(
        "fed_back",
        "dead_time",
        {"input": "error", "time": "signals.moment"},
        initial="0 m",
        shortest="20 ms",
        longest="1 s",
    )
    assert run(diagram(folder, around(time="1 s")[0], varying)).fault is None


def test_a_dead_time_that_grows_as_fast_as_time_holds_its_output(folder):
    nodes = (
        node("one", "constant", value=1.0),
        node("now", "integrator", {"input": "one"}, method="forward"),
        node("still", "dead_time", {"input": "signals.ramp", "time": "now"}, longest="10 s"),
    )
    assert run(diagram(folder, *nodes))["still"].tolist() == [-1.0] * 251


@pytest.mark.parametrize(
    ("kind", "parameters", "told"),
    [
        ("moving_average", {}, "it has no length\n  hint: give its `duration` or its `scans`"),
        ("moving_average", {"duration": "0.1 s", "scans": 5}, "both `duration` and `scans` are given"),
        (
            "sample_hold",
            {"duration": "50 ms"},
            "0.05 s is not a whole number of scans of 0.02 s\n  hint: 0.04 s would do",
        ),
        ("sample_hold", {"duration": "1 ms"}, "hint: 0.02 s would do"),
        ("dead_time", {"time": "-1 s"}, "it must be at least 0"),
        ("dead_time", {"time": "1 s", "longest": "0.5 s"}, "`time` lies beyond `shortest` and `longest`"),
        ("dead_time", {"time": "1 s", "shortest": "2 s", "longest": "1 s"}, "`shortest` lies above"),
        ("lead_lag", {"lead": "1 s", "lag": "0 s"}, "it must be greater than 0"),
        ("second_order_lag", {"natural_frequency": "1 Hz", "damping": 1.0}, "does not convert to rad/s"),
    ],
)
def test_what_a_block_cannot_be_is_refused_with_what_it_can(folder, kind, parameters, told):
    assert told in refusal(folder, node("it", kind, {"input": "signals.wave"}, **parameters))


def test_a_dead_time_that_is_a_signal_needs_its_longest(folder):
    text = refusal(
        folder, node("it", "dead_time", {"input": "signals.wave", "time": "signals.moment"}, shortest="0 s")
    )
    assert "a dead time that is a signal needs its `longest`" in text


def test_blocks_that_remember_go_on_from_a_saved_state_bit_for_bit(folder):
    reads = {"input": "signals.wave"}
    control = {"setpoint": "signals.stairs", "measurement": "signals.wave", "automatic": "signals.flag"}
    tuned = {"Kc": 2.0, "Ti": "1 s", "Td": "0.1 s", "high": "1 m"}
    nodes = (
        node("lag", "first_order_lag", reads, time_constant="0.3 s"),
        node("second", "second_order_lag", reads, natural_frequency="5 rad/s", damping=0.4),
        node("lead", "lead_lag", reads, lead="0.1 s", lag="0.3 s"),
        node("late", "dead_time", reads | {"time": "signals.moment"}, longest="0.5 s"),
        node("mean", "moving_average", reads, scans=9),
        node("slow", "sample_hold", reads, scans=4),
        node("position", "pid", control | {"tracked": "slow"}, **tuned, anti_windup="back_calculation"),
        node("steps", "pid_velocity", control, **tuned),
    )
    tape = lower(wire(diagram(folder, *nodes, **JITTER)))
    whole = run_tape(tape)
    state, record = initial_state(tape), empty_record(tape)
    for stop in (1, 2, 30, 31, 200, None):
        proceed(tape, state, record, stop)
        state = state.copy()
    assert whole.fault is None
    assert np.array_equal(trace_of(tape, state, record).values, whole.values)
