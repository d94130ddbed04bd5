"""Small closed loops for tests."""

from collections.abc import Mapping
from pathlib import Path

import fcl_sim
from fcl_sim.loop.diagram import Diagram, FuzzyNode, Integration, Node, PlantNode, Timing, Wire
from fcl_sim.plant.catalog import PlantModel, find, load
from fcl_sim.units import parse_quantity

BENCH = Path(__file__).parents[2]

CONSTANT = """
FUNCTION_BLOCK constant
VAR_INPUT x: REAL; END_VAR
VAR_OUTPUT y: REAL; END_VAR
FUZZIFY x
  TERM any := (0, 1) (1, 1);
END_FUZZIFY
DEFUZZIFY y
  TERM only := {value};
  METHOD: CoGS;
  DEFAULT := 0;
END_DEFUZZIFY
RULEBLOCK No1
  AND: MIN;
  ACCU: MAX;
  RULE 1: IF x IS any THEN y IS only;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""


def timing(scan_ms: float = 50.0, seconds: float = 10.0, **further: int | bool) -> Timing:
    scan = round(scan_ms * 1e6)
    return Timing(scan=scan, duration=round(seconds * 1e9 / scan) * scan, **further)


def plant_of(folder: Path, text: str, name: str = "thing") -> PlantModel:
    path = folder / f"{name}.py"
    path.write_text("from fcl_sim.plant import *\nfrom math import *\n" + text, encoding="utf-8")
    return load(path)


def constant(name: str, value: float, source: str, units: Mapping[str, str]) -> FuzzyNode:
    """A fuzzy block that always gives `value`."""
    block = fcl_sim.loads(CONSTANT.format(value=value))
    return FuzzyNode(name=name, block=block, inputs={"x": Wire(source)}, units=units)


def alone(
    model: PlantModel, timing: Timing, integration: Integration | None = None, **start: float
) -> Diagram:
    """A plant whose inputs are all held at 0 by a gain on its first output."""
    first = model.declaration.outputs[0]
    nodes = tuple(
        Node(
            name=f"zero_{each.name}",
            type="gain",
            inputs={"input": Wire(f"plant.{first.name}")},
            parameters={"gain": parse_quantity(f"0 {each.unit}/{first.unit}")},
        )
        for each in model.declaration.inputs
    )
    wires = {each.name: Wire(f"zero_{each.name}") for each in model.declaration.inputs}
    plant = PlantNode(name="plant", model=model, start=start, inputs=wires)
    return Diagram(plant=plant, nodes=nodes, timing=timing, integration=integration or Integration())


def crane_alone(
    timing: Timing,
    parameters: Mapping[str, float],
    start: Mapping[str, float],
    power: float = 0.0,
    rtol: float = 1e-12,
) -> Diagram:
    """The crane at constant power, in kW."""
    node = constant("power", power, "crane.distance", {"x": "m", "y": "kW"})
    plant = PlantNode(
        name="crane",
        model=find("crane", BENCH),
        parameters=parameters,
        start=start,
        inputs={"power": Wire("power.y")},
    )
    return Diagram(plant=plant, nodes=(node,), timing=timing, integration=Integration(rtol=rtol))


def crane(
    rules: str = "crane_completed.fcl",
    *,
    timing: Timing,
    parameters: Mapping[str, float] | None = None,
    position: float = -25.0,
    prediction: float | None = 6.0,
    integration: Integration | None = None,
) -> Diagram:
    """The crane under a rule base; `prediction` seconds of speed are taken off the distance, None: raw."""
    block = fcl_sim.load(BENCH / "scenarios" / "crane" / rules)
    nodes = (
        Node(
            name="controller.speed",
            type="differentiator",
            inputs={"input": Wire("crane.distance", -1.0)},
            parameters={"filter": parse_quantity("0.05 s")},
        ),
        Node(
            name="controller.predicted",
            type="sum",
            inputs={"distance": Wire("crane.distance"), "speed": Wire("controller.speed")},
            parameters={
                "distance": parse_quantity(1.0),
                "speed": parse_quantity(f"{-(prediction or 0.0)} s"),
            },
        ),
        FuzzyNode(
            name="controller.rules",
            block=block,
            inputs={
                "distance": Wire("crane.distance" if prediction is None else "controller.predicted"),
                "angle": Wire("crane.angle"),
            },
            units={"distance": "m", "angle": "deg", "power": "kW"},
        ),
    )
    plant = PlantNode(
        name="crane",
        model=find("crane", BENCH),
        parameters=parameters or {},
        start={"position": position},
        inputs={"power": Wire("controller.rules.power")},
    )
    return Diagram(plant=plant, nodes=nodes, timing=timing, integration=integration or Integration())
