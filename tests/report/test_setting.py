"""What sets a run apart from the base run is told, each thing once."""

from dataclasses import replace

import pytest

from fcl_sim.loop.diagram import Integration, Node, Wire
from fcl_sim.report.setting import differences
from tests.report.synthetic import run


@pytest.fixture
def base(tmp_path):
    return run(tmp_path).diagram


def test_a_diagram_does_not_differ_from_itself(base, tmp_path):
    assert differences(base, base) == []
    assert differences(base, run(tmp_path).diagram) == []


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"parameters": {"load_mass": 40.0}}, "load_mass = 40 t"),
        ({"parameters": {}}, "load_mass = as declared"),
        ({"start": {"position": -40.0}}, "start position = −40 m"),
        ({"inputs": {"power": Wire("controller.power")}}, "the controller is wired differently"),
    ],
)
def test_a_change_of_the_plant_is_told(base, changes, told):
    other = replace(base, plant=replace(base.plant, **changes))
    assert [each.replace("\N{NO-BREAK SPACE}", " ") for each in differences(base, other)] == [told]


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"scan": 10**8}, "scan 100 ms"),
        ({"latency": 10**6}, "latency 1 ms"),
        ({"seed": 7}, "seed 7"),
        ({"measured": True}, "measured cycle time"),
    ],
)
def test_a_change_of_timing_is_told(base, changes, told):
    other = replace(base, timing=replace(base.timing, **changes))
    assert [each.replace("\N{NO-BREAK SPACE}", " ") for each in differences(base, other)] == [told]


def test_a_change_of_blocks_is_told(base):
    speed = Node(name="controller.speed", type="differentiator", inputs={})
    (rules,) = base.nodes
    assert differences(base, replace(base, nodes=(rules, speed))) == ["with controller.speed"]
    assert differences(base, replace(base, nodes=())) == ["without controller.rules"]
    rewired = replace(rules, inputs={"distance": Wire("controller.distance")})
    assert differences(base, replace(base, nodes=(rewired,))) == ["changed: controller.rules"]


def test_another_integration_is_told(base):
    other = replace(base, integration=Integration(scheme="runge_kutta"))
    assert differences(base, other) == ["integrated by runge_kutta"]
