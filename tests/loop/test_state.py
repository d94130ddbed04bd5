"""A run that is saved and continued is the run in one, bit for bit."""

from dataclasses import replace

import numpy as np
import pytest

from fcl_sim.loop.blocks.setting import Text
from fcl_sim.loop.diagram import FuzzyNode, Node, Overruns, Restart, Wire
from fcl_sim.loop.run import empty_record, proceed, run, run_tape, trace_of
from fcl_sim.loop.state import initial_state
from fcl_sim.loop.tape import lower
from fcl_sim.loop.wiring import wire
from fcl_sim.units import parse_quantity
from tests.loop.block_loops import node
from tests.loop.diagrams import crane, timing
from tests.loop.python_mode import every_block

COUNTER = "def step(inputs, state, t):\n    state['n'] = state.get('n', 0) + 1\n    return state['n']\n"


def loop():
    """The crane with latency, jitter and blocks that remember."""
    diagram = crane(timing=timing(50.0, 6.0, latency=10**7, jitter=10**7, seed=3, measured=True))
    quantity = parse_quantity
    nodes = (
        Node(name="late", type="unit_delay", inputs={"input": Wire("crane.distance")}),
        Node(
            name="area",
            type="integrator",
            inputs={"input": Wire("late")},
            parameters={"method": "forward", "high": quantity("60 m s")},
        ),
    )
    return replace(diagram, nodes=(*diagram.nodes, *nodes))


def disturbed_loop():
    """Noise, delays, faults, devices that remember, overruns, and restarts of either kind."""
    diagram = loop()
    disturbed = replace(
        diagram.timing,
        overruns=Overruns(policy="late", listed=((7, 130 * 10**6),), chance=0.1, longest=120 * 10**6),
        restarts=(
            Restart(at=1_230_000_000, kind="cold"),
            Restart(at=3_000_000_000, kind="warm", lasts=170 * 10**6),
            Restart(at=5_000_000_000, kind="cold", lasts=60 * 10**6),
        ),
    )
    seen, begins = {"input": "crane.distance"}, {"from": "1 s", "to": "4 s"}
    own = {"file": Text("own.py", COUNTER), "outputs": {"n": "1"}}
    nodes = (
        node("noise", "noise", sigma="2 m", correlation_time="1 s"),
        node("delay", "dead_time", seen, time="330 ms"),
        node("sensor", "sensor", seen, lag="0.2 s", noise="1 cm", low="-50 m", high="50 m", bits=10),
        node("drive", "actuator", {"input": "noise"}, stiction="1 m", rate="3 m/s", backlash="0.5 m"),
        node("lost", "fault", {"input": "sensor"}, kind="dropout", chance=0.3, **begins),
        node("old", "fault", {"input": "lost"}, kind="delayed", delay="150 ms"),
        node("mean", "moving_average", {"input": "sensor"}, scans=9),
        node("swing", "sine", amplitude="0.2 s", frequency="0.3 Hz", offset="0.3 s"),
        node("pipe", "dead_time", {"input": "sensor", "time": "swing"}, longest="0.6 s"),
        Node(name="count", type="python", parameters=own),
    )
    (rules,) = (each for each in diagram.nodes if isinstance(each, FuzzyNode))
    in_real = replace(rules, name="in_real", arithmetic="REAL")
    return replace(diagram, nodes=(*diagram.nodes, in_real, *nodes), timing=disturbed)


def every_block_disturbed(folder):
    """Every case of the blocks' references beside each other, with jitter, overruns and restarts."""
    diagram = every_block(folder)
    disturbed = replace(
        diagram.timing,
        jitter=3 * 10**6,
        latency=2 * 10**6,
        seed=5,
        measured=True,
        overruns=Overruns(policy="late", listed=((7, 50 * 10**6),), chance=0.1, longest=47 * 10**6),
        restarts=(
            Restart(at=1_230_000_000, kind="cold"),
            Restart(at=3_000_000_000, kind="warm", lasts=70 * 10**6),
        ),
    )
    return replace(diagram, timing=disturbed)


def in_pieces(tape, stops):
    state, record = initial_state(tape), empty_record(tape)
    for stop in [*stops, None]:
        proceed(tape, state, record, stop)
        state = state.copy()
    return trace_of(tape, state, record)


@pytest.mark.parametrize(
    "stops", [[60], [0, 1, 2, 119, 120, 121], list(range(121))], ids=["two", "edges", "each"]
)
def test_a_run_in_pieces_is_the_run_in_one(stops):
    tape = lower(wire(loop()))
    whole, pieces = run_tape(tape), in_pieces(tape, stops)
    assert whole.fault is None
    assert whole.ticks.size == 121
    assert np.array_equal(pieces.values, whole.values)
    assert np.array_equal(pieces.ticks, whole.ticks)
    for name, record in whole.fuzzy.items():
        assert np.array_equal(pieces.fuzzy[name].degrees, record.degrees)


@pytest.mark.parametrize("every", [1, 7, 1000])
def test_a_run_in_pieces_is_the_run_in_one_whatever_disturbs_it(every):
    tape = lower(wire(disturbed_loop()))
    whole, pieces = run_tape(tape), in_pieces(tape, range(0, tape.starts.size, every))
    assert whole.fault is None
    assert len(tape.schedule.cold) == 2
    assert np.array_equal(pieces.values, whole.values)
    assert np.array_equal(pieces.ticks, whole.ticks)
    assert pieces.incidents == whole.incidents


def test_a_run_of_every_block_in_pieces_is_the_run_in_one(tmp_path):
    tape = lower(wire(every_block_disturbed(tmp_path)))
    whole = run_tape(tape)
    assert whole.fault is None
    assert len(whole.incidents) > 10
    for every in (1, 37):
        pieces = in_pieces(tape, range(0, tape.starts.size, every))
        assert np.array_equal(pieces.values, whole.values)
        assert np.array_equal(pieces.ticks, whole.ticks)


def test_a_saved_state_is_left_alone_by_the_run_that_goes_on():
    tape = lower(wire(loop()))
    state, record = initial_state(tape), empty_record(tape)
    proceed(tape, state, record, 40)
    saved = state.copy()
    proceed(tape, state, record)
    first = trace_of(tape, state, record).values.copy()
    assert saved.scan == 40
    proceed(tape, saved, record)
    assert np.array_equal(trace_of(tape, saved, record).values, first)


def test_a_run_that_is_over_stays_where_it_is():
    text = Text("own.py", "def step(inputs, state, t):\n    return float('nan') if t > 1.0 else 0.0\n")
    own = Node(name="own", type="python", parameters={"file": text, "outputs": {"y": "m"}})
    diagram = crane(timing=timing(50.0, 2.0))
    tape = lower(wire(replace(diagram, nodes=(*diagram.nodes, own))))
    state, record = initial_state(tape), empty_record(tape)
    proceed(tape, state, record)
    assert state.over
    fault = trace_of(tape, state, record).fault
    assert (fault.tick, fault.signal) == (1_050_000_000, "own.y")
    before = state.copy()
    proceed(tape, state, record)
    assert np.array_equal(state.x, before.x)
    assert np.array_equal(state.progress, before.progress)


def test_runs_of_one_diagram_are_the_same():
    assert np.array_equal(run(loop()).values, run(loop()).values)
