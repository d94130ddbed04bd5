"""Matrices → text for people, CSV, TOML."""

import csv
import io
import json
from collections.abc import Sequence

from fcl_sim.matrix.matrix import Cell, Matrix

GAP = 2
EMPTY = "-"
"""What stands for no rule in a text."""


def as_text(found: Sequence[Matrix]) -> str:
    """Return matrices in aligned columns, each below the name of its output."""
    return "\n".join("".join(f"{line}\n" for line in _lines(each)) for each in found)


def _lines(matrix: Matrix) -> list[str]:
    rows = [[cell or EMPTY for cell in row] for row in _rows(matrix)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        "".join(cell.ljust(width + GAP) for cell, width in zip(row, widths, strict=True)) for row in rows
    ]
    return [matrix.output.text, *(line.rstrip() for line in lines)]


def as_csv(found: Sequence[Matrix]) -> str:
    """Return matrices as CSV, parted by empty lines."""
    out = io.StringIO()
    table = csv.writer(out, lineterminator="\n")
    for index, matrix in enumerate(found):
        if index:
            out.write("\n")
        table.writerow([matrix.output.text])
        table.writerows(_rows(matrix))
    return out.getvalue()


def as_toml(found: Sequence[Matrix]) -> str:
    """Return matrices as an array of tables in TOML, their cells in aligned columns."""
    return "\n".join(map(_table, found))


def _table(matrix: Matrix) -> str:
    rows = [[json.dumps(cell, ensure_ascii=False) for cell in row] for row in _rows(matrix)]
    rows[0][0] = '""'
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        "    ["
        + " ".join(f"{cell},".ljust(width + 1) for cell, width in zip(row, widths, strict=True)).rstrip(", ")
        + "],"
        for row in rows
    ]
    names = [("output", matrix.output), ("rows", matrix.down), ("columns", matrix.across)]
    given = [f"{key:<7} = {json.dumps(word.text, ensure_ascii=False)}" for key, word in names if word.text]
    return "\n".join(["[[matrix]]", *given, "rules   = [", *lines, "]", ""])


def _rows(matrix: Matrix) -> list[list[str]]:
    """Return the table: the inputs and the columns' names, then each row's name and cells."""
    corner = f"{matrix.down.text} \\ {matrix.across.text}" if matrix.across.text else matrix.down.text
    head = [corner, *(each.text for each in matrix.columns)]
    lines = zip(matrix.rows, matrix.cells, strict=True)
    return [head, *([row.text, *map(cell_text, cells)] for row, cells in lines)]


def cell_text(cell: Cell) -> str:
    """Return a cell as it is written: its terms, each with its weight where that is not 1."""
    return ", ".join(
        each.term.text if each.weight == 1.0 else f"{each.term.text} WITH {_weight(each.weight)}"
        for each in cell
    )


def _weight(weight: float | str) -> str:
    return weight if isinstance(weight, str) else repr(weight)
