"""The rules of a block as tables (figure A.8): terms of one input down, of another across."""

from collections.abc import Sequence
from typing import Any

from fcl_sim.diagnostics import InputFault
from fcl_sim.matrix import matrices
from fcl_sim.matrix.matrix import ANY, Cell, Matrix
from fcl_sim.model import FunctionBlock, Rule
from fcl_sim.report.words import counted, joined, number, one_line

Data = dict[str, Any]


def rule_tables(block: FunctionBlock) -> list[Data]:
    """Return a table for each output; none where the rules take terms of more than two inputs."""
    try:
        found = matrices(block)
    except InputFault:
        return []
    return [_table(each) | {"rest": _rest(each, found.beside)} for each in found.matrices]


def _rest(matrix: Matrix, beside: Sequence[Rule]) -> str:
    """Return what shaded cells mean, and which rules stand in no cell."""
    shaded = any(not cell for cells in matrix.cells for cell in cells)
    if not beside:
        return "Shaded: no rule." if shaded else ""
    labels = joined([one_line(each.label) for each in beside])
    told = f"{counted(len(beside), 'rule')} of another form, {labels}, may fire in any cell and"
    told += f" {'stand' if len(beside) > 1 else 'stands'} in none."
    return f"Shaded: no rule for this cell alone. {told}" if shaded else told


def _table(matrix: Matrix) -> Data:
    columns = [_word(each.text) for each in matrix.columns] if matrix.across.text else [""]
    return {
        "output": one_line(matrix.output.text),
        "down": one_line(matrix.down.text),
        "across": one_line(matrix.across.text),
        "columns": columns,
        "rows": [
            {"term": _word(row.text), "cells": [_cell(cell) for cell in cells]}
            for row, cells in zip(matrix.rows, matrix.cells, strict=True)
        ],
    }


def _word(text: str) -> str:
    return "any" if text == ANY else one_line(text)


def _cell(cell: Cell) -> str:
    return ", ".join(
        one_line(each.term.text) + (f" × {_weight(each.weight)}" if each.weight != 1.0 else "")
        for each in cell
    )


def _weight(weight: float | str) -> str:
    return one_line(weight) if isinstance(weight, str) else number(weight)
