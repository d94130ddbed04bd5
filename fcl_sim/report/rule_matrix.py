"""The rules of a block as tables (figure A.8): terms of one input down, of another across."""

from typing import Any

from fcl_sim.diagnostics import InputFault
from fcl_sim.matrix import matrices
from fcl_sim.matrix.matrix import ANY, Cell, Matrix
from fcl_sim.model import FunctionBlock
from fcl_sim.report.words import counted, number, one_line

Data = dict[str, Any]


def rule_tables(block: FunctionBlock) -> list[Data]:
    """Return a table for each output; none where the rules take terms of more than two inputs."""
    try:
        found = matrices(block)
    except InputFault:
        return []
    beside = counted(len(found.beside), "rule") if found.beside else ""
    rest = f"{beside} of another form {'stand' if len(found.beside) > 1 else 'stands'} in no cell."
    return [_table(each) | {"rest": rest if beside else ""} for each in found.matrices]


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
