"""The rows and sheets that a wiring is broken into, so that its letters can be read on paper.

A row takes as many columns as fit; what it reads of rows above enters it at its
left, by name. A sheet takes as many rows as a page.
"""

from collections.abc import Sequence
from math import inf

from fcl_sim.loop.wiring import Wiring
from fcl_sim.report.style import LEAST, SMALL, TALLEST, WIDTH
from fcl_sim.report.wiring_boxes import (
    GOES_ON,
    GRID,
    Box,
    Columns,
    Port,
    continued,
    in_columns,
    wanted,
)
from fcl_sim.report.wiring_layout import Drawing, laid_out

SHRUNK = SMALL / LEAST
"""A figure is so many times as wide and high as what it is shrunk to, at most."""
ROOM, TALL = WIDTH * SHRUNK, TALLEST * SHRUNK
"""Most mm across and down of a sheet before it is shrunk."""
COLUMN = 0.75 * TALL
"""Most mm of boxes below one another in a column."""

Sheet = Sequence[Drawing]


def sheets(wiring: Wiring) -> list[Sheet]:
    """Return the rows of a wiring from the first to the last, on the sheets that they take."""
    made: list[list[Drawing]] = [[]]
    for row in rows(wiring):
        if made[-1] and sum(each.height for each in (*made[-1], row)) > TALL:
            made.append([])
        made[-1].append(row)
    return [tuple(each) for each in made]


def rows(wiring: Wiring) -> list[Drawing]:
    """Return a wiring in rows: as few as are not too large, and of these the most even ones."""
    columns = _low(in_columns(wiring))
    best: list[tuple[int, float, int]] = [(0, 0.0, 0)] * (len(columns) + 1)
    for start in range(len(columns) - 1, -1, -1):
        found = (len(columns), inf, len(columns))
        for end in range(start + 1, len(columns) + 1):
            drawing = laid_out(_row(wiring, columns, start, end))
            if end > start + 1 and (drawing.width > ROOM or drawing.height > TALL):
                break
            count, uneven, _ = best[end]
            found = min(found, (count + 1, uneven + drawing.width**2, end))
        best[start] = found
    made, start = [], 0
    while start < len(columns):
        end = best[start][2]
        made.append(laid_out(_row(wiring, columns, start, end)))
        start = end
    return made


def _low(columns: Columns) -> list[list[Box]]:
    """Return columns of which none is too high: what stands too low in one has one of its own."""
    made: list[list[Box]] = []
    for column in columns:
        made.append([])
        for box in column:
            if made[-1] and sum(each.rows + 1 for each in (*made[-1], box)) * GRID > COLUMN:
                made.append([])
            made[-1].append(box)
    return made


def _row(wiring: Wiring, columns: Columns, start: int, end: int) -> list[list[Box]]:
    """Return the boxes of a row as they stand there: what goes on below is marked."""
    given = {port.signal for column in columns[:start] for box in column for port in box.exits}
    above = [each for each in wanted(columns[start:end]) if each in given]
    below = set(wanted(columns[end:]))
    first = [[continued(wiring, above)]] if above else []
    return [*first, *([_marked(box, below) for box in column] for column in columns[start:end])]


def _marked(box: Box, below: set[str]) -> Box:
    exits = [
        Port(f"{each.text}{GOES_ON}", each.signal) if each.signal in below else each for each in box.exits
    ]
    return Box(title=box.title, text=box.text, kind=box.kind, entries=box.entries, exits=exits)
