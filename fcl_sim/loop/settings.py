"""Nodes → what their blocks are set up with: ports, outputs, parameters as numbers in their units."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fcl_sim.loop.blocks import BLOCKS
from fcl_sim.loop.blocks.declaration import BlockOutput, BlockParameter, BlockType, UnitRule
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.diagram import FuzzyNode, Node, Timing, Wire
from fcl_sim.units import ONE, Quantity, Unit, UnitError, parse_quantity, parse_unit

AnyNode = Node | FuzzyNode


def type_of(node: AnyNode) -> BlockType:
    """Return the type of a node's block."""
    return BLOCKS["fuzzy" if isinstance(node, FuzzyNode) else node.type]


def signals_of(node: AnyNode) -> tuple[str, ...]:
    """Return the full names of the signals that a node gives."""
    if isinstance(node, FuzzyNode):
        return tuple(f"{node.name}.{each}" for each in node.block.program.output_names)
    outputs = type_of(node).outputs_of(node.parameters)
    return tuple(f"{node.name}.{each.name}" if each.name else node.name for each in outputs)


def outputs_of(node: AnyNode) -> tuple[tuple[str, BlockOutput], ...]:
    """Return the signals that a node gives, with their declarations; a fuzzy block declares none."""
    if isinstance(node, FuzzyNode):
        return ()
    return tuple(zip(signals_of(node), type_of(node).outputs_of(node.parameters), strict=True))


def members_of(node: Node) -> tuple[str, ...]:
    """Return the ports that belong to the group of a node's type, in the order they are written."""
    kind = type_of(node)
    own = {each.name for each in kind.named_inputs}
    return tuple(port for port in node.inputs if port not in own) if kind.group else ()


def ports_of(node: Node) -> tuple[str, ...]:
    """Return the ports of a node in its kernel's order: inputs, parameters that may be signals, group."""
    kind = type_of(node)
    return (*(each.name for each in kind.named_inputs), *members_of(node))


def waits_for(node: AnyNode, timing: Timing) -> tuple[Wire, ...]:
    """Return the wires whose signals of this scan a node takes: all but those of late inputs."""
    if isinstance(node, FuzzyNode):
        return tuple(node.inputs.values())
    late = type_of(node).late_inputs(early_setting(node, timing))
    return tuple(each for port, each in node.inputs.items() if port not in late)


def early_setting(node: Node, timing: Timing) -> Setting:
    """Return what is known of a block's setting before the units of its inputs are."""
    values = {}
    for parameter in type_of(node).parameters:
        if parameter.name not in node.inputs and not any(callable(each) for each in _units_in(parameter)):
            try:
                values[parameter.name] = _value(parameter, node, {}, {})
            except UnitError:
                continue  # told when all units are known
    return _setting(node, values, {}, timing)


def setting_of(
    node: Node, units: Mapping[str, Unit], timing: Timing
) -> tuple[Setting, list[tuple[str, UnitError]]]:
    """Return a block's setting, and the parameters whose units do not fit.

    `units` has the unit of every connected port.
    """
    kind, quantities = type_of(node), quantities_of(node)
    values, misfits = {}, []
    for parameter in kind.parameters:
        if parameter.name in node.inputs:
            continue
        try:
            values[parameter.name] = _value(parameter, node, units, quantities)
        except UnitError as error:
            misfits.append((parameter.name, error))
    return _setting(node, values, units, timing), misfits


def _setting(node: Node, values: Mapping[str, Any], units: Mapping[str, Unit], timing: Timing) -> Setting:
    return Setting(
        name=node.name,
        values=values,
        connected=tuple(node.inputs),
        units=units,
        scan=timing.scan,
        scans=timing.duration // timing.scan,
        seed=timing.seed,
    )


def quantities_of(node: Node) -> dict[str, Quantity]:
    """Return the parameters as unit rules know them: of a list its first entry, of a table each column's."""
    found = {name: each for name, each in node.parameters.items() if isinstance(each, Quantity)}
    for parameter in type_of(node).parameters:
        given = node.parameters.get(parameter.name, parameter.default)
        if parameter.kind == "quantity" and isinstance(given, str):
            found[parameter.name] = parse_quantity(given)
        elif parameter.kind == "list" and given:
            found[parameter.name] = given[0]
        elif parameter.kind == "table" and given:
            found |= {f"{parameter.name}.{i}": each for i, each in enumerate(given[0])}
        elif parameter.kind == "rows" and given:
            first = next(iter(given.values()))
            found |= {f"{parameter.name}.{i}": each for i, each in enumerate(first)}
    return found


def resolved(
    unit: str | UnitRule | None, inputs: Mapping[str, Unit], parameters: Mapping[str, Quantity]
) -> Unit | None:
    """Return the unit that a declaration means, None for any."""
    return parse_unit(unit) if isinstance(unit, str) else unit(inputs, parameters) if unit else None


def _units_in(parameter: BlockParameter) -> Iterator[str | UnitRule | None]:
    yield parameter.unit
    yield from parameter.columns


def _value(
    parameter: BlockParameter,
    node: Node,
    inputs: Mapping[str, Unit],
    parameters: Mapping[str, Quantity],
) -> Any:
    given = node.parameters.get(parameter.name, parameter.default)
    if parameter.kind == "quantity":
        given = parse_quantity(given) if isinstance(given, str) else given
        if not isinstance(given, Quantity):
            return float(given)
        return _number(given, resolved(parameter.unit, inputs, parameters))
    if parameter.kind == "list":
        unit = resolved(parameter.unit, inputs, parameters) or (given[0].unit if given else ONE)
        return np.array([_number(each, unit) for each in given])
    if parameter.kind == "table":
        return _table(parameter, given, inputs, parameters)
    if parameter.kind == "rows":
        return {name: _row(parameter, row, inputs, parameters) for name, row in given.items()}
    return given


def _table(
    parameter: BlockParameter,
    rows: Sequence[Sequence[Quantity]],
    inputs: Mapping[str, Unit],
    parameters: Mapping[str, Quantity],
) -> NDArray[np.float64]:
    """Return rows as numbers; columns of any unit are in that of the first row."""
    rules = parameter.columns
    if not rows:
        return np.empty((0, len(rules)))
    units = [resolved(each, inputs, parameters) or rows[0][i].unit for i, each in enumerate(rules)]
    return np.array([[_number(cell, unit) for cell, unit in zip(row, units, strict=True)] for row in rows])


def _row(
    parameter: BlockParameter,
    row: Sequence[Quantity],
    inputs: Mapping[str, Unit],
    parameters: Mapping[str, Quantity],
) -> NDArray[np.float64]:
    """Return a row of its own name as numbers; cells of any unit are in that of the first of them."""
    rules = parameter.columns or (parameter.unit,) * len(row)
    units = [resolved(each, inputs, parameters) for each in rules]
    free = [cell.unit for cell, unit in zip(row, units, strict=True) if unit is None]
    return np.array([_number(cell, unit or free[0]) for cell, unit in zip(row, units, strict=True)])


def _number(quantity: Quantity, unit: Unit | None) -> float:
    return quantity.value if unit is None else quantity.to(unit)
