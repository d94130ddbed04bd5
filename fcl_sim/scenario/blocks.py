"""A block of a scenario → Node: what its type declares, read from its table."""

from collections.abc import Callable, Mapping
from typing import Any

from fcl_sim.diagnostics import Diagnostic
from fcl_sim.formula.text import Text as Formula
from fcl_sim.loop.blocks import BLOCKS
from fcl_sim.loop.blocks.declaration import BlockParameter, BlockType
from fcl_sim.loop.blocks.setting import Text
from fcl_sim.loop.diagram import Node, Wire
from fcl_sim.scenario.fields import is_wire
from fcl_sim.scenario.model import SourceFile
from fcl_sim.scenario.quantities import converted
from fcl_sim.toml.strings import offsets
from fcl_sim.toml.tree import Entry, finding
from fcl_sim.units import parse_quantity, parse_unit

Faults = list[Diagnostic]
Files = Mapping[tuple[str, str], SourceFile]


def plain_node(name: str, block: Entry, files: Files, wired: Callable[[Entry], Wire], faults: Faults) -> Node:
    """Return the node of a block that has the shape of its type; `wired` gives the wire that an entry names.

    Units that depend on signals are the wiring's to check; others are checked here.
    """
    kind = BLOCKS[str(block.table["type"].value)]
    inputs = _wires(kind, block, wired)
    parameters: dict[str, Any] = {}
    places = {}
    for parameter in kind.parameters:
        entry = block.get(parameter.name)
        if entry is not None and parameter.name not in inputs:
            parameters[parameter.name] = _value(parameter, entry, files.get((name, parameter.name)), faults)
            places[parameter.name] = entry.span
    if kind.group and kind.group.form == "gains":
        gains = block.table[kind.group.name].table
        parameters |= {term: parse_quantity(entry.value) for term, entry in gains.items()}
    return Node(
        name=name, type=kind.name, inputs=inputs, parameters=parameters, places=places, span=block.key
    )


def _wires(kind: BlockType, block: Entry, wired: Callable[[Entry], Wire]) -> dict[str, Wire]:
    wires = {each.name: wired(entry) for each in kind.inputs if (entry := block.get(each.name))}
    for each in kind.ports:
        entry = block.get(each.name)
        if entry is not None and is_wire(entry.value):
            wires[each.name] = wired(entry)
    group = block.get(kind.group.name) if kind.group else None
    if kind.group is None or group is None:
        return wires
    if kind.group.form == "gains":
        return wires | {name: wired(Entry(name, each.key, each.key)) for name, each in group.table.items()}
    if kind.group.form == "named":
        return wires | {name: wired(each) for name, each in group.table.items()}
    return wires | {str(number): wired(each) for number, each in enumerate(group.items, start=1)}


def _value(parameter: BlockParameter, entry: Entry, file: SourceFile | None, faults: Faults) -> Any:
    if parameter.kind == "formula":
        return Formula(str(entry.value), entry.span.source, offsets(entry.span, str(entry.value)))
    if parameter.kind == "rows":
        return {name: _row(parameter, row, faults) for name, row in entry.table.items()}
    return _single(parameter, entry, file, faults)


def _single(parameter: BlockParameter, entry: Entry, file: SourceFile | None, faults: Faults) -> Any:
    if parameter.kind == "file":
        return Text(file.name, file.source.text) if file else Text(str(entry.value), "")
    if parameter.kind == "units":
        return {name: str(each.value) for name, each in entry.table.items()}
    if parameter.kind == "table":
        return tuple(_row(parameter, row, faults) for row in entry.items)
    if parameter.kind == "list":
        return tuple(_quantity(parameter.name, each, parameter.unit, faults) for each in entry.items)
    if parameter.kind == "quantity":
        return _quantity(parameter.name, entry, parameter.unit, faults)
    return entry.value


def _row(parameter: BlockParameter, row: Entry, faults: Faults) -> tuple[Any, ...]:
    columns = parameter.columns or (parameter.unit,) * len(row.items)
    if len(row.items) != len(columns):
        message = f"a row of `{parameter.name}` has {len(columns)} numbers, not {len(row.items)}"
        faults.append(finding("SCN203", message, row, parameter.meaning))
    return tuple(
        _quantity(parameter.name, cell, unit, faults) for cell, unit in zip(row.items, columns, strict=False)
    )


def _quantity(name: str, entry: Entry, unit: Any, faults: Faults) -> Any:
    if isinstance(unit, str):
        converted(entry, parse_unit(unit), f"`{name}`", faults)
    return parse_quantity(entry.value)
