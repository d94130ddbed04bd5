"""Fuzzy blocks in INT within a loop: the numbers of the instance in Python, scan by scan (S36)."""

from dataclasses import replace

import numpy as np
import pytest

import fcl_sim
from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.diagram import Diagram, FuzzyNode, Node, PlantNode, Wire
from fcl_sim.loop.run import empty_record, proceed, run, run_tape, trace_of
from fcl_sim.loop.state import initial_state
from fcl_sim.loop.tape import lower
from fcl_sim.loop.wiring import wire
from fcl_sim.units import parse_quantity
from tests.concept.test_function_block import BATH, VALVE
from tests.loop.diagrams import plant_of, timing

SENSORS = """
PLANT = Plant(
    name="sensors",
    title="A pressure and a temperature that pass over all terms",
    states=(State("nothing", "1", 0.0, "stays"),),
    inputs=(Input("u", "1", "goes nowhere"),),
    outputs=(
        Output("pressure", "1", "3850 to 4150, back and forth"),
        Output("temperature", "1", "4900 to 9600, back and forth"),
        Output("time", "1", "rises"),
    ),
    parameters=(),
)


def dynamics(t, x, u, p, mode, dx):
    dx[0] = 0.0


def outputs(t, x, u, p, mode, y):
    y[0] = 4000.0 + 150.0 * sin(7.0 * t)
    y[1] = 7250.0 - 2350.0 * cos(1.9 * t)
    y[2] = t
"""


@pytest.fixture
def sensors(tmp_path):
    return plant_of(tmp_path, SENSORS, "sensors")


def valve(extreme="AND", arithmetic="INT", **further):
    return FuzzyNode(
        name="valve",
        block=fcl_sim.loads(VALVE.format(extreme=extreme)),
        inputs={"ipress": Wire("sensors.pressure"), "itemp": Wire("sensors.temperature")},
        arithmetic=arithmetic,
        **further,
    )


def diagram(model, *nodes, source="valve.y"):
    plant = PlantNode(name="sensors", model=model, inputs={"u": Wire(source)})
    return Diagram(plant=plant, nodes=nodes, timing=timing(20.0, 4.0))


@pytest.mark.parametrize("rounding", ["truncate", "round"])
@pytest.mark.parametrize("scale", [{}, {"ipress": (0.25, 3000.0), "y": (0.5, 0.0)}])
def test_a_block_in_int_gives_in_the_loop_what_its_instance_gives(sensors, rounding, scale):
    node = valve(scale=scale, rounding=rounding)
    trace = run(diagram(sensors, node))
    record = trace.fuzzy["valve"]
    instance = node.block.instance("INT", scale=scale, rounding=rounding)
    held = 0
    for at, time in enumerate(trace.time):
        before = instance.y
        instance(ipress=trace["sensors.pressure"][at], itemp=trace["sensors.temperature"][at])
        assert list(instance.inputs.values()) == record.inputs[at].tolist(), time
        assert [instance.y] == record.outputs[at].tolist()
        assert [each / 10_000 for each in instance.degrees.values()] == record.degrees[at].tolist()
        assert list(instance.active.values()) == record.active[at].tolist()
        assert instance.active["y"] == any(instance.degrees.values())
        held += not instance.active["y"] and instance.y == before != 0
    assert held > 10
    assert np.array_equal(trace["valve.y"], record.outputs[:, 0])
    assert len(record.rule_labels) == 4


def test_blocks_in_all_arithmetics_stand_in_one_loop_and_do_not_meddle(sensors):
    nodes = [valve("OR", arithmetic=each) for each in ("REAL", "INT", "LREAL", "INT")]
    nodes = [replace(each, name=f"valve{number}") for number, each in enumerate(nodes)]
    nodes[3] = replace(nodes[3], inputs={**nodes[3].inputs, "ipress": Wire("sensors.pressure", -1.0)})
    nodes[3] = replace(nodes[3], scale={"ipress": (1.0, -8000.0)})
    trace = run(diagram(sensors, *nodes, source="valve1.y"))
    alone = run(diagram(sensors, replace(valve("OR"), name="valve1"), source="valve1.y"))
    assert np.array_equal(trace["valve1.y"], alone["valve1.y"])
    assert np.abs(trace["valve1.y"] - trace["valve2.y"]).max() < 100
    assert not np.array_equal(trace["valve1.y"], trace["valve2.y"])
    assert np.array_equal(trace.fuzzy["valve3"].inputs[:, 0], -alone.fuzzy["valve1"].inputs[:, 0])


def test_a_run_in_int_goes_on_as_if_it_had_never_stopped(sensors):
    tape = lower(wire(diagram(sensors, valve())))
    state, record = initial_state(tape), empty_record(tape)
    whole = run(diagram(sensors, valve()))
    silent = np.flatnonzero(~whole.fuzzy["valve"].active[:, 0] & (whole["valve.y"] != 0.0))
    proceed(tape, state, record, until=int(silent[0]))
    saved = state.copy()
    proceed(tape, state, record, until=int(silent[0]) + 60)
    proceed(tape, saved, record)
    assert np.array_equal(trace_of(tape, saved, record).values, whole.values)


def test_an_output_forced_beyond_int_ends_the_run(sensors):
    tape = lower(wire(diagram(sensors, valve())), forced={"valve.y": 40000.0})
    fault = run_tape(tape).fault
    assert fault.signal == "valve.y"
    assert fault.tick == 20_000_000
    assert fault.reason == "`valve` in INT: y is 40000.0, 40000 counts; an INT lies in -32768 .. 32767"


def scaled(factor):
    return Node(
        name="scaled",
        type="gain",
        inputs={"input": Wire("sensors.time")},
        parameters={"gain": parse_quantity(factor)},
    )


def test_an_input_beyond_int_ends_the_run_and_is_named(sensors):
    node = replace(valve(), inputs={"ipress": Wire("scaled"), "itemp": Wire("sensors.temperature")})
    trace = run(diagram(sensors, scaled(32767.4), node))
    assert trace.fault.tick == 1_020_000_000
    assert trace.fault.signal == "scaled"
    assert trace.fault.reason == (
        "`scaled` exceeds what `valve.ipress` can hold: it is INT; "
        "ipress is 33422.748, 33423 counts; an INT lies in -32768 .. 32767"
    )
    assert trace.time.size == 51
    assert np.isfinite(trace.values).all()


@pytest.mark.filterwarnings("ignore::RuntimeWarning")  # of NumPy, uncompiled
def test_an_input_that_is_infinite_is_told_as_such(sensors):
    huge = [replace(scaled(1e200), name=f"huge{number}") for number in range(2)]
    huge[1] = replace(huge[1], inputs={"input": Wire("huge0")})
    node = replace(valve(), inputs={"ipress": Wire("huge1"), "itemp": Wire("sensors.temperature")})
    fault = run(diagram(sensors, *huge, node)).fault
    assert fault.signal == "huge1"
    assert fault.reason == "`huge1` is NaN or infinite"


def test_what_leaves_32_bits_ends_the_run_and_names_the_step(sensors):
    text = BATH.replace("open := 10000", "open := 32767").replace("shut := 0", "shut := 32766")
    text = text.replace("METHOD", "".join(f"TERM t{i} := {32700 + i}; " for i in range(6)) + "METHOD")
    rules = "".join(f"RULE {10 + i}: IF temp IS cold THEN valve IS t{i}; " for i in range(6))
    block = fcl_sim.loads(text.replace("END_RULEBLOCK", rules + "END_RULEBLOCK"))
    nodes = (
        replace(scaled(-100.0), name="falls"),
        Node(
            name="temp",
            type="sum",
            inputs={"a": Wire("falls"), "b": Wire("start")},
            parameters={"a": parse_quantity(1.0), "b": parse_quantity(1.0)},
        ),
        Node(name="start", type="constant", parameters={"value": parse_quantity(350.0)}),
        FuzzyNode(
            name="bath",
            block=block,
            inputs={"temp": Wire("temp"), "flow": Wire("start")},
            arithmetic="INT",
        ),
    )
    trace = run(diagram(sensors, *nodes, source="bath.valve"))
    assert trace.fault.signal == "bath.valve"
    assert trace.fault.reason == "`bath` in INT: bath: defuzzification of valve: OVERFLOW"
    assert 1.0 < trace.fault.tick / 1e9 < 4.0
    instance = block.instance("INT")
    for at in range(trace.time.size):
        instance(temp=trace["temp"][at], flow=350)
        assert instance.valve == trace["bath.valve"][at]
    with pytest.raises(OverflowError):
        instance(temp=350.0 - 100.0 * trace.fault.tick / 1e9, flow=350)


def test_what_the_library_lacks_and_unknown_scales_are_refused_before_the_run(sensors):
    with pytest.raises(InputFault, match=r"WIR104(.|\n)*no variable called `ipres`(.|\n)*`ipress`"):
        wire(diagram(sensors, valve(scale={"ipres": (1.0, 0.0)})))


def test_repeated_labels_do_not_hide_rules(sensors):
    text = VALVE.format(extreme="OR").replace("RULE 2:", "RULE 1:")
    node = replace(valve(), block=fcl_sim.loads(text))
    record = run(diagram(sensors, node)).fuzzy["valve"]
    assert record.rule_labels == ("1", "1 (2)", "3", "4")
    again = run(diagram(sensors, valve("OR"))).fuzzy["valve"]
    assert np.array_equal(record.degrees, again.degrees)
