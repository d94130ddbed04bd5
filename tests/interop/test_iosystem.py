import control
import numpy as np
import pytest

import fcl_sim
from fcl_sim import interop
from fcl_sim.loop.diagram import Diagram, FuzzyNode, Integration, PlantNode, Wire
from fcl_sim.loop.run import run
from tests.interop.blocks import crane, linear, narrow
from tests.loop.diagrams import plant_of, timing

OSCILLATOR = """
PLANT = Plant(
    name="oscillator", title="a mass on a spring",
    states=(State("x", "m", 25.0, "position"), State("v", "deg", 1.0, "speed")),
    inputs=(Input("power", "kW", "drive"),),
    outputs=(Output("x", "m", "position"), Output("v", "deg", "speed")),
)

def dynamics(t, x, u, p, mode, dx):
    dx[0] = x[1]
    dx[1] = -0.5 * x[0] - 0.1 * x[1] - u[0]

def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
    y[1] = x[1]
"""


def test_signals_are_called_as_those_of_the_block():
    system = interop.to_iosystem(crane(), 0.05, name="rules")
    assert system.input_labels == ["distance", "angle"]
    assert system.output_labels == ["power"]
    assert (system.name, system.dt, system.nstates) == ("rules", 0.05, 0)


def test_a_member_of_a_structure_has_no_dot():
    text = """
    TYPE pair: STRUCT a: LREAL; b: LREAL; END_STRUCT; END_TYPE
    FUNCTION_BLOCK f
    VAR_INPUT x: LREAL; END_VAR
    VAR_OUTPUT both: pair; END_VAR
    FUZZIFY x TERM all := (0, 1) (1, 1); END_FUZZIFY
    DEFUZZIFY both.a TERM one := 1; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
    DEFUZZIFY both.b TERM two := 2; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
    RULEBLOCK r AND: MIN; ACCU: MAX;
    RULE 1: IF x IS all THEN both.a IS one, both.b IS two;
    END_RULEBLOCK
    END_FUNCTION_BLOCK
    """
    system = interop.to_iosystem(fcl_sim.loads(text), 1.0)
    assert system.output_labels == ["both_a", "both_b"]
    assert system([0.5]).tolist() == [1.0, 2.0]


def test_a_block_without_memory_is_called_with_one_point_or_with_columns_of_points():
    block = crane()
    system = interop.to_iosystem(block, 0.05)
    values = {"distance": np.array([12.0, -3.0, 7.5]), "angle": np.array([4.0, 1.0, -8.0])}
    expected = block.evaluate(values)["power"]
    assert system([12.0, 4.0]).tolist() == [expected[0]]
    assert system(np.array([*values.values()])).tolist() == expected.tolist()


def test_a_block_of_one_input_has_a_describing_function():
    # Saturation at 1 with the slope 1, in closed form.
    system = interop.to_iosystem(linear({"e": (-1.0, 1.0)}, (1.0,)), 0.1)
    amplitude = 2.0
    ratio = 1 / amplitude
    expected = 2 / np.pi * (np.arcsin(ratio) + ratio * np.sqrt(1 - ratio**2))
    found = control.describing_function(system, amplitude, num_points=4000)
    assert found == pytest.approx(expected, abs=1e-6)


def test_the_previous_value_of_an_output_with_nc_is_the_state():
    block = narrow()
    system = interop.to_iosystem(block, 0.1)
    assert system.state_labels == ["y_before"]
    x = np.array([1.5, 0.5, 1.5, 1.5, 2.5, 1.2])
    response = control.input_output_response(system, 0.1 * np.arange(6), x, [0.75])
    instance = block.instance()
    expected = []
    for value in x:
        instance(x=value)
        expected.append(instance.y)
    assert response.outputs.tolist() == expected == [0.75, -1.0, -1.0, -1.0, 4.0, 4.0]


def test_asking_twice_changes_nothing():
    system = interop.to_iosystem(narrow(), 0.1)
    state = np.array([0.5])
    for x, y in ((0.5, -1.0), (1.5, 0.5), (2.5, 4.0), (1.5, 0.5)):
        assert system.output(0.0, state, np.array([x])).tolist() == [y]
        assert system.dynamics(0.0, state, np.array([x])).tolist() == [y]


def test_a_loop_in_python_control_runs_as_our_own(tmp_path):
    block, dt, seconds = crane(), 0.05, 10.0
    node = FuzzyNode(
        name="rules",
        block=block,
        inputs={"distance": Wire("plant.x"), "angle": Wire("plant.v")},
        units={"distance": "m", "angle": "deg", "power": "kW"},
    )
    plant = PlantNode(
        name="plant", model=plant_of(tmp_path, OSCILLATOR), inputs={"power": Wire("rules.power")}
    )
    diagram = Diagram(
        plant=plant, nodes=(node,), timing=timing(50.0, seconds), integration=Integration(rtol=1e-12)
    )
    trace = run(diagram)
    oscillator = control.ss([[0, 1], [-0.5, -0.1]], [[0], [-1]], np.eye(2), 0)
    sampled = control.ss(
        control.sample_system(oscillator, dt), inputs=["power"], outputs=["distance", "angle"]
    )
    loop = control.interconnect(
        [sampled, interop.to_iosystem(block, dt)], inputs=[], outputs=["distance", "angle", "power"]
    )
    response = control.input_output_response(loop, trace.time, 0.0, [25.0, 1.0])
    for theirs, ours in (("distance", "plant.x"), ("angle", "plant.v"), ("power", "rules.power")):
        assert np.ptp(trace[ours]) > 10.0
        assert response.outputs[theirs] == pytest.approx(trace[ours], abs=1e-8)


@pytest.mark.parametrize("dt", [0, -0.1, float("nan"), float("inf"), True])
def test_dt_must_be_a_time_between_scans(dt):
    with pytest.raises(ValueError, match="dt must be the seconds between two scans"):
        interop.to_iosystem(crane(), dt)


def test_a_system_computes_in_the_arithmetic_of_the_plc():
    block = crane()
    instance = block.instance("REAL")
    instance(distance=11.1, angle=0.3)
    found = interop.to_iosystem(block, 0.05, arithmetic="REAL")([11.1, 0.3])
    assert found.tolist() == [instance.power]
    assert found != interop.to_iosystem(block, 0.05)([11.1, 0.3])


def test_an_unknown_arithmetic_is_refused():
    with pytest.raises(ValueError, match="no arithmetic TERNARY"):
        interop.to_iosystem(crane(), 0.05, arithmetic="TERNARY")


def test_what_is_not_finite_is_named():
    with pytest.raises(ValueError, match="angle is nan"):
        interop.to_iosystem(crane(), 0.05)([1.0, np.nan])
