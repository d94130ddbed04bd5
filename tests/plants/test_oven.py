"""The tunnel oven against closed forms: plug flow, browning at one temperature, the path of the colour."""

from math import exp

import numpy as np
import pytest

from fcl_sim.loop.diagram import Diagram, Integration, Node, PlantNode, Wire
from fcl_sim.loop.run import run
from fcl_sim.plant.catalog import find
from fcl_sim.units import parse_quantity
from tests.loop.diagrams import timing

AT_REST = {
    "heater_1": "0 %",
    "heater_2": "0 %",
    "belt": "10 m/min",
    "dough": 0.25,
    "sugar": 1.0,
    "outside": "8 g/kg",
    "extraction": 1.0,
}
FROZEN = {"zone_heat": 1e15, "air_mass": 1e15}
"""Zones and air that nothing warms or wets."""


def oven(parameters, start, seconds, **nodes) -> Diagram:
    sources = {
        name: Node(name=name, type="constant", parameters={"value": parse_quantity(value)})
        for name, value in AT_REST.items()
    }
    plant = PlantNode(
        name="oven",
        model=find("oven"),
        parameters=parameters,
        start=start,
        inputs={name: Wire(name) for name in sources},
    )
    return Diagram(
        plant=plant,
        nodes=tuple({**sources, **nodes}.values()),
        timing=timing(1.0, seconds),
        integration=Integration(scheme="rk4", step=1.0),
    )


def test_a_piece_leaves_when_the_belt_has_gone_its_length_also_where_the_speed_changes():
    """From entry to exit the integral of the speed is 60 m, to a cell and the way of the belt in a scan."""
    quantities = [(parse_quantity(f"{t} s"), parse_quantity(f"{v} m/min")) for t, v in ((0, 10), (200, 20))]
    belt = Node(name="belt", type="staircase", parameters={"steps": tuple(quantities)})
    marked = [(parse_quantity(f"{t} s"), parse_quantity(x)) for t, x in ((0, 0.25), (60, 0.35))]
    dough = Node(name="dough", type="staircase", parameters={"steps": tuple(marked)})
    held = {**FROZEN, "drying": 0.0}
    trace = run(oven(held, {}, 400.0, belt=belt, dough=dough))
    seen = trace.time[np.argmax(trace["oven.residual"] >= 0.349)]
    # 140 s at 10 m/min are 23.33 m; the other 36.67 m take 110 s at 20 m/min.
    assert seen == pytest.approx(60 + 140 + 110, abs=0.5 / (20 / 60) + 0.5 / (10 / 60) + 1)


def test_dry_dough_at_one_temperature_browns_as_a_reaction_of_first_order():
    celsius = 150.0
    cells = {f"product_{i}": celsius for i in range(120)} | {f"moisture_{i}": 0.0 for i in range(120)}
    start = {**cells, "zone_1": celsius, "zone_2": celsius}
    parameters = {**FROZEN, "drying": 0.0, "recipe": 3.2, "ambient": celsius}
    steps = {"before": "0 m/min", "after": "10 m/min", "at": "100 s"}
    moved = Node(
        name="belt", type="step", parameters={name: parse_quantity(each) for name, each in steps.items()}
    )
    trace = run(oven(parameters, start, 120.0, belt=moved))
    left = np.flatnonzero(np.diff(trace["oven.colour"]))[0] + 1
    rate = 3.2 * 42_000.0 * exp(-64_151.0 / (8.314 * (celsius + 273.15)))
    assert trace["oven.colour"][left] == pytest.approx(52 * (1 - exp(-rate * trace.time[left])), rel=1e-6)


def test_the_prototypes_of_the_classifier_are_the_wanted_colour_and_two_on_either_side():
    model = find("oven")
    outputs = model.functions.ready()[1]
    declared = model.declaration
    wanted = {19.19: (189.7, 152.5, 111.8), 21.19: (186.0, 147.5, 107.4), 23.19: (182.2, 142.6, 103.3)}
    for difference, prototype in wanted.items():
        x = np.array([each.start for each in declared.states])
        x[-1] = difference / 52
        y = np.empty(len(declared.outputs))
        u, p = np.zeros(len(declared.inputs)), np.array([each.default for each in declared.parameters])
        outputs(0.0, x, u, p, 0, y)
        assert y[-3:] == pytest.approx(prototype, abs=0.1)
