"""Events within a step: found where they are, wherever in the step they are."""

from math import sqrt

import numpy as np
import pytest

from fcl_sim.jit import compiled
from fcl_sim.loop import integrate
from fcl_sim.loop.diagram import Integration
from fcl_sim.loop.run import MOST_SCANS, empty_record, next_piece, proceed, run, trace_of
from fcl_sim.loop.state import initial_state
from fcl_sim.loop.tape import lower
from fcl_sim.loop.wiring import wire
from fcl_sim.loop.work import STEPS
from tests.loop.diagrams import alone, plant_of, timing

ARC = """
PLANT = Plant(
    name="arc", title="a ball that is thrown once, and a line that it may cross",
    states=(
        State("height", "m", 0.0, "h"), State("speed", "m/s", 10.0, "v"),
        State("rose", "s", -1.0, "when"), State("fell", "s", -1.0, "when"),
    ),
    inputs=(),
    outputs=(
        Output("height", "m", "h"), Output("rose", "s", "when it rose over the line"),
        Output("fell", "s", "when it fell below"),
    ),
    parameters=(Parameter("line", "m", 4.999, "height of the line", "[A]"),),
    events=(Event("rises", RISING, "over the line"), Event("falls", FALLING, "below the line")),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = x[1]
    dx[1] = -10.0
    dx[2] = 0.0
    dx[3] = 0.0

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
    y[1] = x[2]
    y[2] = x[3]

def events(t, x, u, p, mode, g):
    g[0] = x[0] - p[0]
    g[1] = x[0] - p[0]

def transition(i, t, x, u, p, mode):
    if i >= 0:
        x[2 + i] = t
    return 0
"""


def thrown(tmp_path, line, scan_ms, **integration):
    """Return when a ball thrown at 10 m/s under 10 m/s2 crossed the line; it is highest after 1 s, at 5 m."""
    text = ARC.replace("4.999", repr(line))
    trace = run(alone(plant_of(tmp_path, text), timing(scan_ms, 3.0), Integration(**integration)))
    assert trace.fault is None
    return trace["plant.rose"][-1], trace["plant.fell"][-1]


@pytest.mark.parametrize("above", [3.0, 1e-2, 1e-6, 1e-12])
@pytest.mark.parametrize("scan", [3000.0, 1500.0, 100.0, 70.0])
def test_a_line_that_is_crossed_and_crossed_back_within_a_step_is_seen_at_both_times(tmp_path, scan, above):
    # The motion is a parabola, which the scheme follows in steps as long as the scan.
    rose, fell = thrown(tmp_path, 5.0 - above, scan)
    half = sqrt(above / 5.0)
    accuracy = max(1e-9, 1e-14 / half)  # where the line only just touches, time follows from its height badly
    assert (rose, fell) == pytest.approx((1.0 - half, 1.0 + half), abs=accuracy)


@pytest.mark.parametrize("scan", [3000.0, 70.0])
def test_a_line_that_is_not_reached_is_not_crossed(tmp_path, scan):
    assert thrown(tmp_path, 5.0 + 1e-9, scan) == (-1.0, -1.0)


def test_a_scheme_with_a_fixed_step_sees_what_lasts_longer_than_its_step(tmp_path):
    # Over a line at 4.95 m from 0.9 to 1.1 s.
    fine = {"scheme": "rk4", "step": 0.04}
    assert thrown(tmp_path, 4.95, 3000.0, **fine) == pytest.approx((0.9, 1.1), abs=1e-9)
    assert thrown(tmp_path, 4.95, 3000.0, scheme="rk4", step=0.75) == (-1.0, -1.0)


SWITCHED = """
PLANT = Plant(
    name="heater", title="a two-position controller on a lag",
    states=(
        State("level", "m", 0.0, "x"), State("last", "s", 0.0, "last switch"), State("count", "1", 0.0, "n"),
    ),
    inputs=(),
    outputs=(Output("level", "m", "x"), Output("last", "s", "last switch"), Output("count", "1", "switches")),
    modes=(Mode("on", ""), Mode("off", "")),
    events=(Event("hot", RISING, "at 1.5 m"), Event("cold", FALLING, "at 0.5 m")),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = (2.0 if mode == 0 else 0.0) - x[0]
    dx[1] = 0.0
    dx[2] = 0.0

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
    y[1] = x[1]
    y[2] = x[2]

def events(t, x, u, p, mode, g):
    g[0] = x[0] - 1.5
    g[1] = x[0] - 0.5

def transition(i, t, x, u, p, mode):
    if i < 0:
        return 0
    x[1] = t
    x[2] += 1.0
    return 1 if i == 0 else 0
"""


@pytest.mark.parametrize("scan", [7.0, 410.0, 5000.0])
def test_a_relay_in_a_plant_switches_at_the_times_of_its_closed_form(tmp_path, scan):
    # From 0 to 1.5 of 2 takes ln 4; from then on ln 3 each way.
    trace = run(alone(plant_of(tmp_path, SWITCHED), timing(scan, 20.0), Integration(rtol=1e-11)))
    switches = np.log(4.0) + np.log(3.0) * np.arange(20)
    count = (switches[:, np.newaxis] < trace.time).sum(axis=0)
    last = np.where(count > 0, switches[np.maximum(count - 1, 0)], 0.0)
    assert trace["plant.count"].tolist() == count.tolist()
    assert trace["plant.last"] == pytest.approx(last, abs=1e-9)


def test_events_that_follow_each_other_fast_are_no_chattering_however_long_the_scan(tmp_path):
    # A thousand times as fast: some 4500 switches between two writes.
    text = SWITCHED.replace(
        "(2.0 if mode == 0 else 0.0) - x[0]", "1000.0 * ((2.0 if mode == 0 else 0.0) - x[0])"
    )
    trace = run(alone(plant_of(tmp_path, text), timing(5000.0, 10.0), Integration(rtol=1e-11)))
    assert trace.fault is None
    switches = 1 + int((1000.0 * 10.0 - np.log(4.0)) / np.log(3.0))
    assert trace["plant.count"][-1] == switches
    assert trace["plant.last"][-1] == pytest.approx(
        (np.log(4.0) + np.log(3.0) * (switches - 1)) / 1000.0, abs=1e-9
    )


FALL = """
PLANT = Plant(
    name="fall", title="falls ever faster into a point",
    states=(State("rest", "m", 1.0, "x"),), inputs=(), outputs=(Output("out", "m", "x"),),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = -1.0 / x[0]

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
"""


def test_a_tolerance_that_no_step_meets_ends_in_a_fault_with_the_trace_up_to_there(tmp_path):
    # x = sqrt(1 - 2 t) has an end at half a second, with a slope beyond all bounds.
    trace = run(alone(plant_of(tmp_path, FALL), timing(30.0, 2.0), Integration(rtol=1e-10)))
    assert trace.fault is not None
    assert trace.fault.signal == "plant.rest"
    assert (
        trace.fault.reason
        == "the state `rest` of `plant` needs steps too small for the clock to meet the tolerance"
    )
    assert trace.time[-1] == pytest.approx(0.48)
    assert trace["plant.out"] == pytest.approx(np.sqrt(1.0 - 2.0 * trace.time), abs=1e-8)


@pytest.mark.parametrize(
    "integration",
    [Integration(scheme="rk4", step=1e-9), Integration(rtol=1e-30)],
    ids=["fixed", "controlled"],
)
def test_steps_without_end_are_ended_by_a_budget(tmp_path, monkeypatch, integration):
    if not compiled():
        monkeypatch.setattr(integrate, "MAX_STEPS", 1000)
    text = FALL.replace("-1.0 / x[0]", "sin(10.0 * t) * x[0]")
    trace = run(alone(plant_of(tmp_path, text), timing(30.0, 2.0), integration))
    assert trace.fault is not None
    assert trace.fault.signal == "plant.rest"
    assert (
        trace.fault.reason == "the state `rest` of `plant` needs more than a million steps between two writes"
    )
    assert (trace.fault.tick, trace.time.tolist()) == (0, [0.0])


def test_a_run_that_has_used_up_its_steps_is_ended_wherever_it_stands(tmp_path):
    text = FALL.replace("-1.0 / x[0]", "sin(10.0 * t) * x[0]")
    tape = lower(wire(alone(plant_of(tmp_path, text), timing(30.0, 3.0))))
    state, record = initial_state(tape), empty_record(tape)
    proceed(tape, state, record, 50)
    assert 50 <= state.progress[STEPS] <= 500
    state.progress[STEPS] = integrate.MAX_STEPS_OF_RUN - 3
    proceed(tape, state, record)
    trace = trace_of(tape, state, record)
    assert trace.fault is not None
    assert trace.fault.signal == "plant.rest"
    assert trace.fault.reason.endswith("has needed a thousand million steps, and the run is not at its end")
    assert 51 <= trace.ticks.size <= 54
    assert np.isfinite(trace.values).all()


@pytest.mark.parametrize(
    ("seconds", "least", "most"), [(0.0, 16, 1024), (1e-3, 16, 1024), (10.0, 1, 1), (0.25, 16, 16)]
)
def test_python_looks_up_every_quarter_of_a_second(seconds, least, most):
    assert least <= next_piece(16, seconds) <= most
    assert next_piece(10**6, 0.0) == MOST_SCANS
