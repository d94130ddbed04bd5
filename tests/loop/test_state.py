"""A run that is saved and continued is the run in one, bit for bit."""

from dataclasses import replace

import numpy as np
import pytest

from fcl_sim.loop.blocks.setting import Text
from fcl_sim.loop.diagram import Node, Wire
from fcl_sim.loop.run import empty_record, proceed, run, run_tape, trace_of
from fcl_sim.loop.state import initial_state
from fcl_sim.loop.tape import lower
from fcl_sim.loop.wiring import wire
from fcl_sim.units import parse_quantity
from tests.loop.diagrams import crane, timing


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
    node = Node(name="own", type="python", parameters={"file": text, "outputs": {"y": "m"}})
    diagram = crane(timing=timing(50.0, 2.0))
    tape = lower(wire(replace(diagram, nodes=(*diagram.nodes, node))))
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
