"""The page on blocks, made from their declarations."""

from collections.abc import Iterable, Iterator
from math import isinf
from typing import Any

from fcl_sim.diagnostics.spelling import listed
from fcl_sim.loop.blocks import FAMILIES
from fcl_sim.loop.blocks.declaration import BlockInput, BlockInputs, BlockParameter, BlockType, Like, UnitRule

HEAD = """\
# Blocks

What can stand around a rule base in `[blocks]` of a controller or a scenario, by `type`. Each runs once in
every scan, in the order of the wires. `u` is the input, `y` the output, `k` counts the scans, `T` is the
cycle time, nominal or measured as the scenario says. `fuzzy` is told in [Scenarios](scenarios.md#the-
controller-file).

A block with one output gives the signal that is called as the block; one with several gives `block.output`.
A quantity is written with its unit, `"0.5 m/s"`; where the unit is said to be that of an input, it may be
any that converts to it. A parameter that "may be a signal" takes the name of one instead. A block that
reads an input of the last scan may stand in a loop of wires without making it an algebraic one; where the
units of such a loop follow from each other, one parameter with its unit says where to begin.

| | |
|---|---|"""


def page() -> str:
    """Return the page."""
    lines = [HEAD]
    for family in FAMILIES:
        lines += [f"| [`{block.name}`](#{block.name.lower()}) | {block.summary} |" for block in family.table]
    for family in FAMILIES:
        lines += ["", f"## {family.title}"]
        for block in family.table:
            lines += _block(block)
    return "\n".join(lines) + "\n"


def _block(block: BlockType) -> Iterator[str]:
    yield from ("", f"### {block.name}", "", f"{block.summary[0].upper()}{block.summary[1:]}.", "")
    yield f"    {block.equation}"
    yield from ("", f"Source: {block.source}.{_late(block)}")
    rows = [*map(_input, block.inputs), *_alike((each.name, _parameter(each)) for each in block.parameters)]
    if block.group:
        rows.insert(len(block.inputs), _group(block.group))
    if rows:
        yield from ("", "| key | | unit | default |", "|---|---|---|---|", *rows)
    if isinstance(block.outputs, tuple) and (
        len(block.outputs) > 1 or any(each.name for each in block.outputs)
    ):
        yield from ("", "| output | | unit |", "|---|---|---|")
        yield from _alike((each.name, f"| {each.meaning} | {_unit(each.unit)} |") for each in block.outputs)


def _alike(rows: Iterable[tuple[str, str]]) -> Iterator[str]:
    """Yield rows of a table, each name before what it is; names of the same stand in one row."""
    names: dict[str, list[str]] = {}
    for name, told in rows:
        names.setdefault(told, []).append(f"`{name}`")
    for told, (first, *others) in names.items():
        several = [first, *others] if len(others) < 3 else [first, others[0], "..", others[-1]]
        yield f"| {', '.join(several).replace(', .., ', ' .. ')} {told}"


def _late(block: BlockType) -> str:
    if callable(block.late):
        return " Which inputs it reads as of the last scan depends on its parameters."
    return f" Of the last scan: {listed(block.late)}." if block.late else ""


def _input(each: BlockInput) -> str:
    default = "" if each.default is None else f"{each.default:g}"
    return f"| `{each.name}` | signal: {each.meaning} | {_unit(each.unit)} | {default} |"


def _group(each: BlockInputs) -> str:
    forms = {"gains": "signals, each with a factor", "named": "signals by name", "list": "a list of signals"}
    return f"| `{each.name}` | {forms[each.form]}: {each.meaning} | {_unit(each.unit)} | |"


def _parameter(each: BlockParameter) -> str:
    unit = ", ".join(_unit(column) or "any" for column in each.columns) or _unit(each.unit)
    unit = unit if each.kind in {"quantity", "list", "table", "rows"} else ""
    words = {"choice": f": {listed(each.choices)}", "table": ": rows of numbers", "list": ": a list"}
    words["rows"] = ": a list of numbers by name"
    told = (
        f"{each.meaning}{words.get(each.kind, '')}{'; may be a signal' if each.port else ''}{_bounds(each)}"
    )
    return f"| {told} | {unit} | {_default(each.default)} |"


def _bounds(each: BlockParameter) -> str:
    parts = []
    if each.above is not None:
        parts.append(f"greater than {each.above:g}")
    if each.minimum is not None:
        parts.append(f"at least {each.minimum:g}")
    if each.maximum is not None:
        parts.append(f"at most {each.maximum:g}")
    return f"; {' and '.join(parts)}" if parts else ""


def _default(value: Any) -> str:
    if value is None or value == "":
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return "none" if isinf(value) else f"{value:g}"
    return f"`{value}`"


def _unit(unit: str | UnitRule | None) -> str:
    if isinstance(unit, str):
        return unit or "1"
    if isinstance(unit, Like):
        return f"that of `{unit.name}`" + (f" times {unit.times}" if unit.times else "")
    return "any" if unit is None else "follows from the inputs"
