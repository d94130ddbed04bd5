"""The constants of a run as rows of tables: those of its plant, and what its blocks are set to."""

import re
from collections.abc import Iterator, Sequence
from itertools import groupby, pairwise
from math import isclose
from typing import Any

from fcl_sim.loop.diagram import Diagram, PlantNode
from fcl_sim.report.constants import Constant, blocks_of, parameters_of, starts_of, told
from fcl_sim.report.words import exactly, one_line, readably
from fcl_sim.scenario.model import PlantSetup

SERIES = 6
"""So many constants that are alike but for their number, as the cells of a belt are, share a row."""

FROM_ELSEWHERE = ("degC", "degF")
"""Units whose zero is not that of others."""

NUMBERED = re.compile(r"(.*?)(\d+)")


def plant_rows(plant: PlantNode, setup: PlantSetup | None = None) -> list[dict[str, Any]]:
    """Return the parameters of a plant, then its start values, as rows of a table.

    Values are in the units of `setup`, where this is what the plant was bound from.
    """
    return [
        row
        for kind, constants in (
            ("parameter", parameters_of(plant, setup)),
            ("start", starts_of(plant, setup)),
        )
        for series in _series(constants)
        for row in _rows(series, kind)
    ]


def _series(constants: Sequence[Constant]) -> Iterator[list[Constant]]:
    """Yield constants in their order, those together that differ in number and value alone."""
    for _, group in groupby(constants, key=_likeness):
        series: list[Constant] = []
        for each in group:
            if series and _number(each) != _number(series[-1]) + 1:
                yield series
                series = []
            series.append(each)
        yield series


def _likeness(constant: Constant) -> tuple[Any, ...]:
    stem = NUMBERED.fullmatch(constant.name)
    own = (stem[1], constant.value == constant.declared) if stem else constant.name
    return own, constant.unit, constant.meaning, constant.source, constant.minimum, constant.maximum


def _number(constant: Constant) -> int:
    found = NUMBERED.fullmatch(constant.name)
    return int(found[2]) if found else 0


def _rows(series: Sequence[Constant], kind: str) -> list[dict[str, Any]]:
    if len(series) < SERIES:
        return [_row(each, kind) for each in series]
    first, last = series[0], series[-1]
    values = [each.value for each in series]
    steps = [after - before for before, after in pairwise(values)]
    scale = max(abs(each) for each in values)
    if values.count(values[0]) == len(values):
        spread, value = "each", first.told
    elif all(isclose(each, steps[0], rel_tol=1e-6, abs_tol=1e-9 * scale) for each in steps):
        spread, value = f"{len(values)} values in equal steps", f"{first.told} … {last.told}"
    else:
        spread = f"{len(values)} values between these"
        value = f"{exactly(min(values), first.unit)} … {exactly(max(values), first.unit)}"
    return [
        _row(first, kind)
        | {
            "name": f"{one_line(first.name)} … {one_line(last.name)}",
            "value": value,
            "meaning": ", ".join(each for each in (one_line(first.meaning), spread) if each),
            "source": "" if first.value == first.declared else "set by the scenario",
        }
    ]


def _row(constant: Constant, kind: str) -> dict[str, Any]:
    return {
        "kind": kind,
        "name": one_line(constant.name),
        "value": constant.told,
        "meaning": one_line(constant.meaning),
        "source": _origin(constant),
        "assumed": constant.is_assumed,
        "limits": _limits(constant),
    }


def _origin(constant: Constant) -> str:
    """Return where a value comes from: the scenario, or what the plant's file says."""
    source = one_line(constant.source)
    if constant.value == constant.declared:
        return source
    kept = readably(constant.declared, constant.unit)
    return f"set by the scenario; by itself {kept}{f', {source}' if source else ''}"


def _limits(constant: Constant) -> str:
    """Return what a value may be, in the declared unit, which is not always the one that it is told in."""
    low, high = (_limit(each, constant.unit) for each in (constant.minimum, constant.maximum))
    if low and high:
        return f"{low} to {high}"
    if low:
        return f"at least {low}"
    return f"at most {high}" if high else ""


def _limit(value: float | None, unit: str) -> str:
    if value is None:
        return ""
    return "0" if value == 0.0 and unit not in FROM_ELSEWHERE else readably(value, unit)


def block_rows(diagram: Diagram) -> list[dict[str, Any]]:
    """Return the blocks that are set to anything, as rows of a table."""
    return [
        {
            "name": one_line(each.name),
            "type": each.type,
            "given": [f"{one_line(name)} = {told(value)}" for name, value in each.given.items()],
            "left": ", ".join(f"{name} = {told(value)}" for name, value in each.left.items()),
        }
        for each in blocks_of(diagram)
        if each.values
    ]
