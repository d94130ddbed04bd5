"""One scan as a PLC does it, and what the trace keeps of it."""

import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

import fcl_sim
from fcl_sim.loop.diagram import FuzzyNode, Node, PlantNode, Wire
from fcl_sim.loop.run import run, run_tape
from fcl_sim.loop.tape import lower
from fcl_sim.loop.wiring import wire
from fcl_sim.units import parse_quantity
from tests.loop.diagrams import BENCH, alone, constant, crane, plant_of, timing

INTEGRATOR = """
PLANT = Plant(
    name="integrator", title="integrates its input",
    states=(State("x", "m", 0.0, "integral"),),
    inputs=(Input("rate", "m/s", "x'"),), outputs=(Output("x", "m", "integral"),),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = u[0]

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
"""

COUNTER = """
PLANT = Plant(
    name="counter", title="counts scans",
    states=(State("n", "1", 0.0, "count"),), inputs=(), outputs=(Output("n", "1", "count"),),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = 0.0

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]

def sample(t, x, u, p):
    x[0] += 1.0
"""

SWITCHED = """
PLANT = Plant(
    name="switched", title="runs while its input is positive",
    states=(State("x", "m", 0.0, "way"),),
    inputs=(Input("go", "m/s", "runs when positive"),),
    outputs=(Output("x", "m", "way"), Output("running", "1", "mode")),
    modes=(Mode("stands", ""), Mode("runs", "")),
    events=(Event("starts", RISING, ""), Event("stops", FALLING, "")),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = 1.0 if mode == 1 else 0.0

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
    y[1] = mode

def events(t, x, u, p, mode, g):
    g[0] = u[0] if mode == 0 else -1.0
    g[1] = u[0] if mode == 1 else 1.0

def transition(i, t, x, u, p, mode):
    if i == 0:
        return 1
    return 0
"""


def driven(model, timing, value=2.0):
    plant = PlantNode(name="plant", model=model, inputs={model.declaration.inputs[0].name: Wire("drive.y")})
    node = constant("drive", value, "plant.x", {"x": "m", "y": "m/s"})
    return replace(alone(model, timing), plant=plant, nodes=(node,))


def test_a_run_has_a_sample_for_every_scan_and_one_for_the_end():
    trace = run(crane(timing=timing(50.0, 10.0)))
    assert trace.ticks.tolist() == [50_000_000 * n for n in range(201)]
    assert trace.time[-1] == 10.0


def test_what_is_written_is_held_until_the_next_scan(tmp_path):
    trace = run(driven(plant_of(tmp_path, INTEGRATOR), timing(100.0, 1.0)))
    assert trace["plant.x"] == pytest.approx(2.0 * trace.time, abs=1e-12)


def test_an_optional_input_stays_at_its_start_until_something_drives_it(tmp_path):
    optional = INTEGRATOR.replace('"x\'")', '"x\'", start=3.0, optional=True)')
    model = plant_of(tmp_path, optional)
    free = replace(driven(model, timing(100.0, 1.0)), plant=PlantNode(name="plant", model=model))
    trace = run(free)
    assert trace["plant.x"] == pytest.approx(3.0 * trace.time, abs=1e-12)
    assert "plant.rate" not in trace
    assert run(driven(model, timing(100.0, 1.0)))["plant.x"][-1] == pytest.approx(2.0)


def test_latency_delays_the_writing_and_so_the_plant(tmp_path):
    late = timing(100.0, 1.0, latency=30_000_000)
    trace = run(driven(plant_of(tmp_path, INTEGRATOR), late))
    assert trace["plant.x"] == pytest.approx(2.0 * np.maximum(0.0, trace.time - 0.03), abs=1e-12)
    assert trace["plant.rate"][0] == 0.0


def test_what_a_plant_does_at_scans_is_done_once_at_each(tmp_path):
    trace = run(alone(plant_of(tmp_path, COUNTER), timing(10.0, 1.0)))
    assert trace["plant.n"].tolist() == [float(n + 1) for n in range(101)]


def test_modes_are_looked_at_again_when_outputs_are_written(tmp_path):
    trace = run(driven(plant_of(tmp_path, SWITCHED), timing(100.0, 1.0)))
    assert trace["plant.running"].tolist() == [0.0] + [1.0] * 10
    assert trace["plant.x"] == pytest.approx(trace.time, abs=1e-12)


def test_every_block_runs_exactly_once_per_scan(tmp_path):
    # The difference of a count of scans is 1 per scan from the second call on only if it is called once.
    nodes = (
        Node(
            name="rate",
            type="differentiator",
            inputs={"input": Wire("plant.n")},
            parameters={"filter": parse_quantity("0 s")},
        ),
    )
    trace = run(replace(alone(plant_of(tmp_path, COUNTER), timing(10.0, 1.0)), nodes=nodes))
    assert trace["rate"].tolist() == [0.0] + [pytest.approx(100.0)] * 100


def test_a_fuzzy_record_says_which_rules_fired_and_how_strongly():
    trace = run(crane(timing=timing(50.0, 20.0)))
    record = trace.fuzzy["controller.rules"]
    block = fcl_sim.load(BENCH / "scenarios" / "crane" / "crane_completed.fcl")
    assert record.rule_labels == tuple(str(n) for n in range(1, 26))
    assert record.input_names == ("distance", "angle")
    given = {name: record.inputs[:, i] for i, name in enumerate(record.input_names)}
    assert np.array_equal(block.evaluate(given)["power"], record.outputs[:, 0])
    assert np.array_equal(record.active[:, 0], (record.degrees > 0).any(axis=1))
    assert np.array_equal(record.outputs[:, 0], trace["crane.power"])


def test_aliases_are_signals_with_their_sign():
    diagram = replace(crane(timing=timing()), aliases={"controller.gap": Wire("crane.distance", -1.0)})
    trace = run(diagram)
    assert np.array_equal(trace["controller.gap"], -trace["crane.distance"])
    assert trace.units["controller.gap"] == "m"


def test_a_tape_can_be_run_again_with_the_same_result():
    tape = lower(wire(crane(timing=timing())))
    assert np.array_equal(run_tape(tape).values, run_tape(tape).values)


def test_the_measured_cycle_time_makes_up_for_jitter():
    jittered = crane(timing=timing(50.0, 10.0, jitter=20_000_000, seed=3))
    nominal = run(jittered)
    measured = run(replace(jittered, timing=replace(jittered.timing, measured=True)))

    def noise(trace):
        return np.abs(np.diff(trace["controller.speed"], 2)).mean()

    assert noise(measured) < noise(nominal) / 3


def test_compiled_and_plain_python_give_the_same_trace():
    program = (
        "from tests.loop.diagrams import crane, timing\n"
        "from fcl_sim.loop.run import run\n"
        "import numpy as np, sys\n"
        "trace = run(crane(timing=timing(50.0, 5.0)))\n"
        "np.save(sys.stdout.buffer, trace.values)\n"
    )
    plain = subprocess.run(
        [sys.executable, "-c", program],
        cwd=BENCH,
        env={**os.environ, "NUMBA_DISABLE_JIT": "1"},
        capture_output=True,
        check=True,
    )
    import io

    expected = np.load(io.BytesIO(plain.stdout))
    assert np.abs(run(crane(timing=timing(50.0, 5.0))).values - expected).max() <= 1e-12


def test_two_fuzzy_blocks_in_one_loop_keep_to_themselves():
    diagram = crane(timing=timing())
    (rules,) = (node for node in diagram.nodes if isinstance(node, FuzzyNode))
    twin = replace(
        rules, name="twin", inputs={"distance": Wire("crane.distance"), "angle": Wire("crane.angle")}
    )
    both = run(replace(diagram, nodes=(twin, *diagram.nodes)))
    assert np.array_equal(both["crane.power"], run(diagram)["crane.power"])
    expected = rules.block.evaluate({"distance": both["crane.distance"], "angle": both["crane.angle"]})
    assert np.array_equal(both["twin.power"], expected["power"])
