"""Every constant that a run computes with, of its plant and of its blocks, whether it was given or not."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from fcl_sim.formula.text import Text as Formula
from fcl_sim.loop.blocks.declaration import BlockParameter
from fcl_sim.loop.diagram import Diagram, FuzzyNode, Node, PlantNode, Wire
from fcl_sim.loop.settings import AnyNode, type_of
from fcl_sim.report.words import MINUS, exactly, one_line, readably
from fcl_sim.scenario.model import Entries, PlantSetup
from fcl_sim.units import Quantity, UnitError, parse_quantity, parse_unit

ASSUMED = "[A]"
"""How the source of a parameter begins that nobody has told."""

MOST_ROWS = 12
"""Entries of a list that are told; of more the first and the last are."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Constant:
    """A constant of a plant, in its declared unit; `declared` is what it is unless it is `given`.

    `source` says where the declared value comes from, and whether it is assumed. A start value has none.
    `written` is the value as the scenario has it, in a unit of its own; None where it has none.
    """

    name: str
    value: float
    unit: str
    meaning: str
    source: str = ""
    declared: float
    given: bool
    minimum: float | None = None
    maximum: float | None = None
    written: Quantity | None = None

    @property
    def told(self) -> str:
        """The value for a reader, in the unit that the scenario gives it in."""
        if self.written is None:
            return readably(self.value, self.unit)
        return readably(self.written.value, self.written.unit.symbol)

    @property
    def is_assumed(self) -> bool:
        """Whether nobody has told the value: it is the declared one, and that is marked [A]."""
        return self.value == self.declared and self.source.startswith(ASSUMED)


def parameters_of(plant: PlantNode, setup: PlantSetup | None = None) -> list[Constant]:
    """Return all parameters of a plant, in their order; `setup` is what it was bound from."""
    written = {} if setup is None else setup.parameters
    return [
        Constant(
            name=each.name,
            value=plant.parameters.get(each.name, each.default),
            unit=each.unit,
            meaning=each.meaning,
            source=each.source,
            declared=each.default,
            given=each.name in plant.parameters,
            minimum=each.minimum,
            maximum=each.maximum,
            written=_written(each.name, each.unit, plant.parameters, written),
        )
        for each in plant.model.declaration.parameters
    ]


def starts_of(plant: PlantNode, setup: PlantSetup | None = None) -> list[Constant]:
    """Return the start values of all states, then those of inputs that nothing drives."""
    written = {} if setup is None else setup.start
    states = [
        Constant(
            name=each.name,
            value=plant.start.get(each.name, each.start),
            unit=each.unit,
            meaning=each.meaning,
            declared=each.start,
            given=each.name in plant.start,
            written=_written(each.name, each.unit, plant.start, written),
        )
        for each in plant.model.declaration.states
    ]
    still = [
        Constant(
            name=each.name,
            value=each.start,
            unit=each.unit,
            meaning=each.meaning,
            declared=each.start,
            given=False,
        )
        for each in plant.model.declaration.inputs
        if each.name not in plant.inputs
    ]
    return [*states, *still]


def _written(name: str, unit: str, values: Mapping[str, float], entries: Entries) -> Quantity | None:
    """Return a value as a scenario gives it, where that is the one which the plant has."""
    if name not in values or name not in entries:
        return None
    try:
        quantity = parse_quantity(entries[name].value)
        return quantity if quantity.to(parse_unit(unit)) == values[name] else None
    except UnitError:
        return None


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    """What a block is set to: what is `given`, what is `left` as its type declares, signals that are `wired`.

    Values are as a diagram has them, wires in words.
    """

    name: str
    type: str
    given: Mapping[str, Any]
    left: Mapping[str, Any] = field(default_factory=dict)
    wired: Mapping[str, str] = field(default_factory=dict)

    @property
    def values(self) -> dict[str, Any]:
        """Every parameter, whether it is given or not."""
        return {**self.given, **self.left}


def blocks_of(diagram: Diagram) -> list[Settings]:
    """Return what each block of a diagram is set to, in the diagram's order."""
    return [settings_of(each) for each in diagram.nodes]


def settings_of(node: AnyNode) -> Settings:
    """Return what a block is set to; a parameter that is a signal is among its wires."""
    if isinstance(node, FuzzyNode):
        return _fuzzy(node)
    declared = {each.name: each for each in type_of(node).parameters}
    left = {
        name: _default(each)
        for name, each in declared.items()
        if name not in node.parameters and name not in node.inputs and not _is_absent(each.default)
    }
    return Settings(name=node.name, type=node.type, given=node.parameters, left=left, wired=_wires(node))


def _fuzzy(node: FuzzyNode) -> Settings:
    given: dict[str, Any] = {"function block": node.block.function_block.name, "arithmetic": node.arithmetic}
    if node.in_int:
        given |= {"rounding": node.rounding, "scale": node.scale}
    if node.units:
        given["units"] = {name: each or "1" for name, each in node.units.items()}
    return Settings(name=node.name, type="fuzzy", given=given, wired=_wires(node))


def _wires(node: Node | FuzzyNode) -> dict[str, str]:
    return {port: source_of(each) for port, each in node.inputs.items()}


def source_of(wire: Wire) -> str:
    """Return what a wire comes from, with its sign."""
    return f"{MINUS if wire.sign < 0 else ''}{wire.source}"


def _default(parameter: BlockParameter) -> Any:
    """Return a parameter's default, with its unit where that is always the same."""
    if isinstance(parameter.default, float) and isinstance(parameter.unit, str):
        return Quantity(parameter.default, parse_unit(parameter.unit))
    return parameter.default


def _is_absent(default: Any) -> bool:
    """Return whether a default stands for a bound that there is not, or for nothing."""
    return default in {None, "", float("inf"), float("-inf")}


def told(value: Any) -> str:
    """Return a value of a block's parameter for a reader; of a long list its ends and how long it is."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Quantity):
        return readably(value.value, value.unit.symbol)
    if isinstance(value, int | float):
        return exactly(float(value), "")
    if isinstance(value, tuple | list):
        shown = [told(each) for each in value]
        if len(shown) > MOST_ROWS:
            shown = [*shown[:2], f"… {len(shown) - 3} more …", shown[-1]]
        return f"[{', '.join(shown)}]"
    if isinstance(value, Mapping):
        return ", ".join(f"{one_line(str(name))}: {told(each)}" for name, each in value.items())
    return one_line(value.text if isinstance(value, Formula) else str(value))


def changes(before: Mapping[str, Any], after: Mapping[str, Any]) -> Iterator[tuple[str, str, str]]:
    """Yield what is unlike: its name, old and new value, empty where there is none; of lists by place."""
    for name in dict.fromkeys((*before, *after)):
        old, new = before.get(name), after.get(name)
        if old == new:
            continue
        if isinstance(old, tuple) and isinstance(new, tuple) and len(old) == len(new):
            for place, (one, other) in enumerate(zip(old, new, strict=True), start=1):
                if one != other:
                    yield f"{name}[{place}]", told(one), told(other)
            continue
        yield name, told(old) if name in before else "", told(new) if name in after else ""
