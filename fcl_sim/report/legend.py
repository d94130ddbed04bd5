"""The legend of several runs: strokes with their labels, in rows above the axes."""

from collections.abc import Sequence

from fcl_sim.report import lettering, style
from fcl_sim.report.canvas import Figure, Line, Text
from fcl_sim.report.words import one_line

LEFT, RIGHT = 14.0, 2.0
STROKE = 9.0
AFTER = 7.0
ROW = 4.0
BELOW = 1.5


def legend_height(labels: Sequence[str]) -> float:
    """Return the height of the legend in mm, 0 without labels."""
    return len(_rows(labels)) * ROW + BELOW if labels else 0.0


def draw_legend(figure: Figure, labels: Sequence[str]) -> None:
    """Draw the strokes of the runs 0, 1 … with their labels along the upper edge of a figure."""
    if not labels:
        return
    rows = _rows(labels)
    page = figure.page()
    for row, entries in enumerate(rows):
        x, y = LEFT, (row + 0.5) * ROW
        for index, label in entries:
            colour, dashes = style.stroke(index)
            page.add(Line([x, x + STROKE], [y, y], colour, 1.3, dashes))
            page.add(Text(x + STROKE + 1.5, y, label, up="middle"))
            x += _width(label)


def _rows(labels: Sequence[str]) -> list[list[tuple[int, str]]]:
    rows: list[list[tuple[int, str]]] = [[]]
    used = 0.0
    for index, full in enumerate(labels):
        label = lettering.cut(one_line(full), style.WIDTH - LEFT - RIGHT - STROKE - AFTER)
        if rows[-1] and used + _width(label) > style.WIDTH - LEFT - RIGHT:
            rows.append([])
            used = 0.0
        rows[-1].append((index, label))
        used += _width(label)
    return rows


def _width(label: str) -> float:
    return STROKE + 1.5 + lettering.text_width(label) + AFTER
