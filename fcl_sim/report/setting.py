"""How a run is set up, in words, and what sets it apart from another."""

from collections.abc import Mapping

from fcl_sim.loop.diagram import Diagram, FuzzyNode, Node, PlantNode
from fcl_sim.report.words import exactly, joined, one_line, with_unit


def parameters(plant: PlantNode) -> dict[str, str]:
    """Return the parameters that a run gives its plant, each with its unit."""
    units = {each.name: each.unit for each in plant.model.declaration.parameters}
    return _told(plant.parameters, units)


def starts(plant: PlantNode) -> dict[str, str]:
    """Return the start values that a run gives its plant, each with its unit."""
    units = {each.name: each.unit for each in plant.model.declaration.states}
    return _told(plant.start, units)


def _told(values: Mapping[str, float], units: Mapping[str, str]) -> dict[str, str]:
    return {one_line(name): exactly(value, units.get(name, "")) for name, value in values.items()}


def milliseconds(ticks: int) -> str:
    """Return a time of the PLC."""
    return with_unit(ticks / 1e6, "ms", 9)


def differences(base: Diagram, other: Diagram) -> list[str]:
    """Return what sets a diagram apart from the base: plant, parameters, start, timing, blocks, wires."""
    found = []
    if other.plant.model.digest != base.plant.model.digest:
        found.append(f"the plant is {one_line(other.plant.model.declaration.name)}")
    found += _changed(parameters(base.plant), parameters(other.plant))
    found += _changed(starts(base.plant), starts(other.plant), "start ")
    found += _timing(base, other)
    if other.integration != base.integration:
        found.append(f"integrated by {one_line(other.integration.scheme)}")
    found += _blocks(base, other)
    if (other.aliases, other.plant.inputs) != (base.aliases, base.plant.inputs):
        found.append("the controller is wired differently")
    return found


def _changed(base: Mapping[str, str], other: Mapping[str, str], before: str = "") -> list[str]:
    names = dict.fromkeys((*base, *other))
    return [
        f"{before}{name} = {other.get(name, 'as declared')}"
        for name in names
        if base.get(name) != other.get(name)
    ]


def _timing(base: Diagram, other: Diagram) -> list[str]:
    found = []
    for word in ("scan", "duration", "latency", "jitter"):
        value = getattr(other.timing, word)
        if value != getattr(base.timing, word):
            found.append(f"{word} {milliseconds(value)}")
    if other.timing.seed != base.timing.seed:
        found.append(f"seed {other.timing.seed}")
    if other.timing.measured != base.timing.measured:
        found.append("measured cycle time" if other.timing.measured else "nominal cycle time")
    return found


def _blocks(base: Diagram, other: Diagram) -> list[str]:
    before = {node.name: node for node in base.nodes}
    after = {node.name: node for node in other.nodes}
    found = []
    for words, names in (
        ("without", [name for name in before if name not in after]),
        ("with", [name for name in after if name not in before]),
        ("changed:", [name for name in after if name in before and _unlike(before[name], after[name])]),
    ):
        if names:
            found.append(f"{words} {joined([one_line(name) for name in names])}")
    return found


def _unlike(one: Node | FuzzyNode, other: Node | FuzzyNode) -> bool:
    if isinstance(one, FuzzyNode) and isinstance(other, FuzzyNode):
        same_rules = one.block.function_block == other.block.function_block
        fields = ("inputs", "units", "arithmetic", "scale", "rounding")
        return not same_rules or any(getattr(one, each) != getattr(other, each) for each in fields)
    return one != other
