"""The steam heated exchanger against its steady state and the delay of its pipe."""

import numpy as np
import pytest

from fcl_sim.loop.diagram import Diagram, Node, PlantNode, Wire
from fcl_sim.loop.run import run
from fcl_sim.plant.catalog import find
from fcl_sim.units import parse_quantity
from tests.loop.diagrams import timing

AT_REST = 100 * 4186 * 35 / 300e3
"""Valve in % that holds 50 degC at 1 kg/s from 15 degC."""


def exchanger(seconds, parameters=None, **nodes) -> Diagram:
    constants = {"valve": f"{AT_REST} %", "flow": "1 kg/s", "inlet": "15 degC"}
    sources = {
        name: Node(name=name, type="constant", parameters={"value": parse_quantity(value)})
        for name, value in constants.items()
    }
    plant = PlantNode(
        name="exchanger",
        model=find("exchanger"),
        parameters=parameters or {},
        start={},
        inputs={name: Wire(name) for name in sources},
    )
    return Diagram(plant=plant, nodes=tuple({**sources, **nodes}.values()), timing=timing(0.5, seconds))


def step(name, before, after, at) -> Node:
    given = {"before": before, "after": after, "at": at}
    return Node(name=name, type="step", parameters={key: parse_quantity(each) for key, each in given.items()})


def test_it_rests_where_the_heat_balance_says():
    trace = run(exchanger(200.0))
    assert np.abs(trace["exchanger.water"] - 50.0).max() <= 1e-6
    assert np.abs(trace["exchanger.outlet"] - 50.0).max() <= 1e-6


@pytest.mark.parametrize("flow", [0.5, 1.0, 1.4])
def test_at_a_steady_flow_the_pipe_delays_by_its_mass_over_the_flow(flow):
    valve = step("valve", f"{AT_REST} %", "60 %", "60 s")
    held = step("flow", f"{flow} kg/s", f"{flow} kg/s", "1 s")
    trace = run(exchanger(200.0, valve=valve, flow=held))
    time, inside, outside = trace.time, trace["exchanger.water"], trace["exchanger.delivered"]
    later = time >= 60.0
    expected = np.interp(time[later] - 15.0 / flow, time, inside)
    assert np.abs(outside[later] - expected).max() <= 2e-3


def test_while_the_flow_changes_what_leaves_entered_a_pipe_s_mass_ago():
    valve = step("valve", f"{AT_REST} %", "60 %", "20 s")
    flow = step("flow", "0.6 kg/s", "1.3 kg/s", "40 s")
    trace = run(exchanger(120.0, valve=valve, flow=flow))
    time, inside, outside = trace.time, trace["exchanger.water"], trace["exchanger.delivered"]
    passed = np.where(time < 40.0, 0.6 * time, 24.0 + 1.3 * (time - 40.0))
    later = passed >= 15.0
    entered = np.interp(passed[later] - 15.0, passed, inside)
    assert np.abs(outside[later] - entered).max() <= 2e-3
