"""The legend of several runs: strokes with their labels, in rows above the axes."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from fcl_sim.report import style
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
    axes = style.place(figure, 0.0, 0.0, style.WIDTH, len(rows) * ROW)
    axes.set_axis_off()
    axes.set_xlim(0.0, style.WIDTH)
    axes.set_ylim(len(rows) * ROW, 0.0)
    for row, entries in enumerate(rows):
        x, y = LEFT, (row + 0.5) * ROW
        for index, label in entries:
            colour, dashes = style.stroke(index)
            axes.plot([x, x + STROKE], [y, y], color=colour, linestyle=dashes, linewidth=1.3)
            axes.text(x + STROKE + 1.5, y, label, va="center_baseline")
            x += _width(label)


def _rows(labels: Sequence[str]) -> list[list[tuple[int, str]]]:
    rows: list[list[tuple[int, str]]] = [[]]
    used = 0.0
    for index, full in enumerate(labels):
        label = style.cut(one_line(full), style.WIDTH - LEFT - RIGHT - STROKE - AFTER)
        if rows[-1] and used + _width(label) > style.WIDTH - LEFT - RIGHT:
            rows.append([])
            used = 0.0
        rows[-1].append((index, label))
        used += _width(label)
    return rows


def _width(label: str) -> float:
    return STROKE + 1.5 + style.text_width(label) + AFTER
