"""Fuzzy blocks in REAL within a loop, alone and beside one in LREAL (S36)."""

from dataclasses import replace

import numpy as np
import pytest

from fcl_sim.block import loads
from fcl_sim.loop.diagram import FuzzyNode, Node, Wire
from fcl_sim.loop.run import empty_record, proceed, run, trace_of
from fcl_sim.loop.state import initial_state
from fcl_sim.loop.tape import lower
from fcl_sim.loop.wiring import wire
from fcl_sim.units import parse_quantity
from tests.loop.diagrams import crane, timing

RULES = "controller.rules"


def diagram(*arithmetics):
    """The crane under its first block; the others of `arithmetics` read the same and act on nothing."""
    drawn = crane(timing=timing(50.0, 1.0))
    block = next(each for each in drawn.nodes if isinstance(each, FuzzyNode))
    further = [
        replace(block, name=f"{RULES}{number}", arithmetic=each)
        if number
        else replace(block, arithmetic=each)
        for number, each in enumerate(arithmetics)
    ]
    others = [each for each in drawn.nodes if each is not block]
    return replace(drawn, nodes=(*others, *further)), block.block


def test_a_block_in_real_gives_in_the_loop_what_its_instance_gives():
    drawn, block = diagram("REAL")
    record = run(drawn).fuzzy[RULES]
    instance = block.instance(arithmetic="REAL")
    for inputs, outputs, degrees in zip(record.inputs, record.outputs, record.degrees, strict=True):
        instance(distance=inputs[0], angle=inputs[1])
        assert list(instance.outputs.values()) == outputs.tolist()
        assert list(instance.degrees.values()) == degrees.tolist()


def test_what_is_recorded_of_a_block_in_real_is_binary32():
    drawn, _ = diagram("REAL")
    trace = run(drawn)
    record = trace.fuzzy[RULES]
    for part in (record.inputs, record.outputs, record.degrees):
        assert np.array_equal(part, part.astype(np.float32))
    assert not np.array_equal(trace["crane.distance"], trace["crane.distance"].astype(np.float32))
    assert np.array_equal(record.inputs[:, 0], trace["controller.predicted"].astype(np.float32))
    assert np.array_equal(trace["controller.rules.power"], record.outputs[:, 0])


def test_blocks_in_both_arithmetics_stand_in_one_loop():
    drawn, block = diagram("REAL", "LREAL", "REAL")
    trace = run(drawn)
    real, long, again = (trace.fuzzy[name] for name in (RULES, f"{RULES}1", f"{RULES}2"))
    assert np.array_equal(real.outputs, again.outputs)
    assert not np.array_equal(real.outputs, long.outputs)
    assert real.outputs == pytest.approx(long.outputs, abs=1e-5 * 54)
    exact = block.evaluate({"distance": long.inputs[:, 0], "angle": long.inputs[:, 1]})
    assert np.array_equal(exact["power"], long.outputs[:, 0])


def test_a_run_in_real_goes_on_as_if_it_had_never_stopped():
    drawn, _ = diagram("REAL", "LREAL")
    tape = lower(wire(drawn))
    state, record = initial_state(tape), empty_record(tape)
    proceed(tape, state, record, until=7)
    saved = state.copy()
    proceed(tape, state, record)
    again = record.copy()
    again[7:] = 0.0
    proceed(tape, saved, again)
    assert np.array_equal(record, again)
    assert np.array_equal(trace_of(tape, state, record).values, run(drawn).values)


@pytest.mark.filterwarnings("ignore::RuntimeWarning")  # of NumPy, uncompiled
def test_an_input_beyond_real_ends_the_run_and_is_named():
    drawn, _ = diagram("REAL")
    huge = Node(
        name="huge",
        type="gain",
        inputs={"input": Wire("crane.distance")},
        parameters={"gain": parse_quantity(1e38)},
    )
    nodes = tuple(
        replace(each, inputs={**each.inputs, "distance": Wire("huge")}) if each.name == RULES else each
        for each in drawn.nodes
    )
    trace = run(replace(drawn, nodes=(huge, *nodes)))
    assert trace.fault.tick == 0
    assert trace.fault.signal == "huge"
    assert trace.fault.reason == "`huge` exceeds what `controller.rules.distance` can hold: it is REAL"
    assert (
        run(replace(drawn, nodes=(replace(huge, parameters={"gain": parse_quantity(1e36)}), *nodes))).fault
        is None
    )


CURVED = """
FUNCTION_BLOCK curved
VAR_INPUT distance: LREAL; angle: LREAL; END_VAR
VAR_OUTPUT power: LREAL; END_VAR
FUZZIFY distance TERM near := (0, 1) (60, 0); TERM far := (0, 0) (60, 1); END_FUZZIFY
DEFUZZIFY power TERM low := (-27, 1) (27, 0); TERM high := (-27, 0) (27, 1);
METHOD: CoG; DEFAULT := 0; RANGE := (-27 .. 27); END_DEFUZZIFY
RULEBLOCK r ACT: EPROD; ACCU: ASUM; RULE 1: IF distance IS near THEN power IS low;
RULE 2: IF distance IS far THEN power IS high; END_RULEBLOCK
END_FUNCTION_BLOCK
"""


@pytest.mark.parametrize("arithmetic", ["LREAL", "REAL"])
def test_areas_under_norms_of_the_open_level_are_evaluated_in_the_loop(arithmetic):
    drawn, _ = diagram("LREAL", arithmetic)
    block = loads(CURVED)
    nodes = [replace(each, block=block) if each.name == f"{RULES}1" else each for each in drawn.nodes]
    record = run(replace(drawn, nodes=tuple(nodes))).fuzzy[f"{RULES}1"]
    instance = block.instance(arithmetic=arithmetic)
    for inputs, outputs in zip(record.inputs, record.outputs, strict=True):
        instance(distance=inputs[0], angle=inputs[1])
        assert list(instance.outputs.values()) == outputs.tolist()
        assert -27.0 < outputs[0] < 27.0
