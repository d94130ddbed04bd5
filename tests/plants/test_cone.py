"""The conical tank against the closed form of its draining, and its linear model."""

from math import pi, sqrt

import numpy as np
import pytest

from fcl_sim.loop.diagram import Diagram, Node, PlantNode, Wire
from fcl_sim.loop.run import run
from fcl_sim.plant.catalog import find
from fcl_sim.units import parse_quantity
from tests.loop.diagrams import timing

OUTLET, CAPACITY, SLOPE = 4e-4, 5e-4, 0.2 / 0.8


def cone(start, seconds, pump="0", *, after=None) -> Diagram:
    given = {"before": pump, "after": pump if after is None else after, "at": "10 s"}
    nodes = (
        Node(name="pump", type="step", parameters={key: parse_quantity(each) for key, each in given.items()}),
        Node(name="leak", type="constant", parameters={"value": parse_quantity("0 m3/s")}),
    )
    plant = PlantNode(
        name="cone",
        model=find("cone"),
        parameters={},
        start=start,
        inputs={name: Wire(name) for name in ("pump", "leak")},
    )
    return Diagram(plant=plant, nodes=nodes, timing=timing(0.5, seconds))


def test_a_cone_drains_with_the_power_of_five_halves_of_its_level():
    trace = run(cone({"level": 0.7, "inflow": 0.0}, 60.0))
    expected = 0.7**2.5 - 2.5 * OUTLET * trace.time / (pi * SLOPE**2)
    assert np.abs(trace["cone.height"] ** 2.5 - expected).max() <= 1e-8


@pytest.mark.parametrize("level", [0.15, 0.4, 0.7])
def test_near_a_level_it_is_the_linear_plant_that_the_schedule_is_tuned_for(level):
    flow, small = OUTLET * sqrt(level), 1e-5
    pump = flow / CAPACITY
    diagram = cone({"level": level, "inflow": flow}, 200.0, f"{pump!r}", after=f"{pump + small!r}")
    trace = run(diagram)
    gain = 2 * sqrt(level) * CAPACITY / OUTLET
    lag, own = 2 * pi * (SLOPE * level) ** 2 * sqrt(level) / OUTLET, 1.5
    time = np.maximum(trace.time - 10.0, 0.0)
    response = 1 - (lag * np.exp(-time / lag) - own * np.exp(-time / own)) / (lag - own)
    assert np.abs(trace["cone.height"] - level - gain * small * response).max() <= 2e-3 * gain * small
