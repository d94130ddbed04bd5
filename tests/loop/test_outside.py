"""A block in Python: called once a scan, with what it keeps, and told about where it fails."""

import numpy as np
import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.blocks.setting import Text
from fcl_sim.loop.diagram import Node, Wire
from fcl_sim.loop.run import empty_record, proceed, run, trace_of
from fcl_sim.loop.state import initial_state
from fcl_sim.loop.tape import lower
from fcl_sim.loop.wiring import wire
from tests.loop.block_bench import diagram

COUNTER = """
def step(inputs, state, t):
    state["scans"] = state.get("scans", 0) + 1
    return {"scans": state["scans"], "twice": 2.0 * inputs["x"], "t": t}
"""
UNITS = {"scans": "1", "twice": "m", "t": "s"}


def block(text, outputs=UNITS, **further):
    parameters = {"file": Text("own.py", text), "outputs": outputs, **further}
    return Node(name="own", type="python", inputs={"x": Wire("signals.wave", -1.0)}, parameters=parameters)


def test_a_function_is_called_once_a_scan_with_what_it_keeps(tmp_path):
    trace = run(diagram(tmp_path, block(COUNTER)))
    assert trace["own.scans"].tolist() == list(range(1, trace.time.size + 1))
    assert np.array_equal(trace["own.twice"], -2.0 * trace["signals.wave"])
    assert np.array_equal(trace["own.t"], trace.time)
    assert trace.units["own.twice"] == "m"


def test_a_late_function_reads_the_last_scan_and_closes_no_loop(tmp_path):
    text = "def step(inputs, state, t):\n    return inputs['x'] + 1.0\n"
    own = block(text, {"y": ""}, late=True)
    loop = diagram(
        tmp_path,
        Node(name="next", type="gain", inputs={"input": Wire("own.y")}, parameters={"gain": quantity(1.0)}),
        Node(name="own", type="python", inputs={"x": Wire("next")}, parameters=own.parameters),
    )
    trace = run(loop)
    assert trace["own.y"].tolist() == [1.0 + n for n in range(trace.time.size)]


def quantity(value):
    from fcl_sim.units import parse_quantity

    return parse_quantity(value)


def test_what_a_function_keeps_belongs_to_the_saved_state(tmp_path):
    tape = lower(wire(diagram(tmp_path, block(COUNTER))))
    whole = run(diagram(tmp_path, block(COUNTER)))
    state, record = initial_state(tape), empty_record(tape)
    proceed(tape, state, record, 100)
    saved = state.copy()
    proceed(tape, state, record, 200)
    proceed(tape, saved, record)
    assert np.array_equal(trace_of(tape, saved, record).values, whole.values)


FAULTS = [
    ("def step(inputs, state, t)\n", "line 1, is not Python"),
    ("x = 1\n", "has no function `step`"),
    ("1 / 0\n", "`own.py`, line 1, fails: ZeroDivisionError: division by zero"),
]


@pytest.mark.parametrize(("text", "message"), FAULTS)
def test_a_function_that_cannot_be_loaded_is_told_before_the_run(tmp_path, text, message):
    with pytest.raises(InputFault) as caught:
        wire(diagram(tmp_path, block(text)))
    assert "WIR202" in str(caught.value)
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("return {}[t]", "`own` at 0 s: `own.py`, line 2, fails: KeyError: 0.0"),
        ("return {'scans': 1}", "lacks a number for each output"),
        ("return None", "lacks a number for each output"),
        ("return {'scans': 1, 'twice': 'x', 't': 3}", "lacks a number for each output"),
    ],
)
def test_a_function_that_fails_is_told_with_its_line(tmp_path, body, message):
    with pytest.raises(InputFault) as caught:
        run(diagram(tmp_path, block(f"def step(inputs, state, t):\n    {body}\n")))
    assert "RUN301" in str(caught.value)
    assert message in str(caught.value)


def test_a_function_that_gives_nan_is_a_fault_of_its_signal(tmp_path):
    text = "def step(inputs, state, t):\n    return float('nan') if t > 1.0 else 0.0\n"
    fault = run(diagram(tmp_path, block(text, {"y": ""}))).fault
    assert fault.signal == "own.y"
    assert fault.tick == 1_020_000_000
