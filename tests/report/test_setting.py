"""What sets a run apart from the base run is told, each thing once."""

from dataclasses import replace

import pytest

from fcl_sim.block import loads
from fcl_sim.loop.diagram import Integration, Node, Overruns, Restart, Wire
from fcl_sim.report.setting import differences
from fcl_sim.units import Quantity, parse_unit
from tests.report.synthetic import CRANE, run


@pytest.fixture
def base(tmp_path):
    return run(tmp_path).diagram


def test_a_diagram_does_not_differ_from_itself(base, tmp_path):
    assert differences(base, base) == []
    assert differences(base, run(tmp_path).diagram) == []


def told(base, other):
    return [each.replace("\N{NO-BREAK SPACE}", " ") for each in differences(base, other)]


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({"parameters": {"load_mass": 40.0}}, "load_mass 20 t → 40 t"),
        ({"start": {"position": -40.0}}, "start position −25 m → −40 m"),
        (
            {"inputs": {"power": Wire("controller.power")}},
            "crane.power from controller.rules.power → controller.power",
        ),
    ],
)
def test_a_change_of_the_plant_is_told_with_what_it_was(base, changes, expected):
    other = replace(base, plant=replace(base.plant, **changes))
    assert told(base, other) == [expected]


def test_a_value_that_is_as_declared_is_no_change_whether_it_is_given_or_not(base):
    assert told(base, replace(base, plant=replace(base.plant, parameters={}))) == []
    heavy = replace(base, plant=replace(base.plant, parameters={"load_mass": 40.0}))
    assert told(heavy, replace(base, plant=replace(base.plant, parameters={}))) == ["load_mass 40 t → 20 t"]


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({"scan": 10**8}, "scan 500 ms → 100 ms"),
        ({"latency": 10**6}, "latency 0 ms → 1 ms"),
        ({"seed": 7}, "seed 0 → 7"),
        ({"measured": True}, "cycle time nominal → measured"),
        ({"restarts": (Restart(at=2 * 10**9),)}, "restarts none → warm at 2 s"),
        ({"overruns": Overruns(listed=((3, 10**9),))}, "overruns none → scan 3 takes 1000 ms, policy skip"),
    ],
)
def test_a_change_of_timing_is_told_with_what_it_was(base, changes, expected):
    assert told(base, replace(base, timing=replace(base.timing, **changes))) == [expected]


def dead_time(time, **given):
    parameters = {"time": Quantity(time, parse_unit("s")), **given}
    wires = {"input": Wire("crane.distance")}
    return Node(name="measured", type="dead_time", inputs=wires, parameters=parameters)


def test_a_block_that_comes_or_goes_is_told_with_its_values(base):
    (rules,) = base.nodes
    added = replace(base, nodes=(rules, dead_time(3.0)))
    assert told(base, added) == ["with measured (dead_time, time = 3 s)"]
    assert told(added, base) == ["without measured"]


def test_a_change_in_a_block_is_told_with_what_it_was(base):
    first = replace(base, nodes=(dead_time(3.0),))
    assert told(first, replace(base, nodes=(dead_time(4.5),))) == ["measured: time 3 s → 4.5 s"]
    held = replace(base, nodes=(dead_time(3.0, between="hold"),))
    assert told(first, held) == ["measured: between linear → hold"]
    lag = replace(dead_time(3.0), type="unit_delay", parameters={})
    expected = "measured: dead_time → unit_delay (input from crane.distance)"
    assert told(first, replace(base, nodes=(lag,))) == [expected]


def test_of_a_block_of_another_type_only_what_is_there_is_told(base):
    first = replace(base, nodes=(dead_time(3.0),))
    held = Node(name="measured", type="constant", parameters={"value": Quantity(3.0, parse_unit("m"))})
    assert told(first, replace(base, nodes=(held,))) == ["measured: dead_time → constant (value = 3 m)"]


def test_what_is_no_longer_set_or_wired_is_told_without_what_it_was(base):
    held = Node(
        name="held", type="limiter", inputs={"input": Wire("crane.distance")}, parameters={"low": 1.0}
    )
    both = replace(held, parameters={"low": 1.0, "high": 2.0})
    first, other, loose = (replace(base, nodes=(each,)) for each in (held, both, replace(held, inputs={})))
    assert told(other, first) == ["held: without high"]
    assert told(first, other) == ["held: high = 2"]
    assert told(first, loose) == ["held: input from nothing"]
    assert told(loose, first) == ["held: input from crane.distance"]


def test_of_a_list_the_places_are_told_that_changed(base):
    def steps(*values):
        rows = tuple((Quantity(10.0 * at, parse_unit("s")), Quantity(each)) for at, each in enumerate(values))
        return replace(base, nodes=(Node(name="load", type="staircase", parameters={"steps": rows}),))

    assert told(steps(1.0, 2.0), steps(1.0, 3.0)) == ["load: steps[2] [10 s, 2] → [10 s, 3]"]
    assert told(steps(1.0), steps(1.0, 3.0)) == ["load: steps [[0 s, 1]] → [[0 s, 1], [10 s, 3]]"]


def test_another_wire_arithmetic_and_rule_base_are_told(base):
    (rules,) = base.nodes
    rewired = replace(rules, inputs={**rules.inputs, "distance": Wire("controller.distance")})
    expected = ["controller.rules: distance from crane.distance → controller.distance"]
    assert told(base, replace(base, nodes=(rewired,))) == expected
    real = replace(rules, arithmetic="REAL")
    assert told(base, replace(base, nodes=(real,))) == ["controller.rules: arithmetic LREAL → REAL"]
    other = replace(rules, block=loads(CRANE.replace("TERM zero := 0;", "TERM zero := 1;"), "new.fcl"))
    assert told(base, replace(base, nodes=(other,))) == ["controller.rules: rule base crane.fcl → new.fcl"]


def test_another_integration_is_told(base):
    other = replace(base, integration=Integration(scheme="runge_kutta"))
    assert differences(base, other) == ["integration dormand_prince → runge_kutta"]


def test_a_parameter_that_was_a_signal_is_told_once(base):
    wires = {"input": Wire("crane.distance"), "time": Wire("age")}
    varying = Node(name="measured", type="dead_time", inputs=wires)
    first = replace(base, nodes=(varying,))
    assert told(first, replace(base, nodes=(dead_time(3.0),))) == ["measured: time from age → 3 s"]
