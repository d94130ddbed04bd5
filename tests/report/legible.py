"""Whether a figure can be read: no text is cut, no two meet."""

from itertools import combinations

from fcl_sim.report.canvas import Axes, Figure, Text
from fcl_sim.report.vector import extent

SLACK = 0.15
"""Millimetres by which extents may overlap: the box of a text is larger than its letters."""

Box = tuple[float, float, float, float]


def texts(figure: Figure) -> list[tuple[str, Box]]:
    """Return every text that is drawn, with its left, upper, right and lower end in mm."""
    return [
        (each.text, box(axes, each)) for axes in figure.axes for each in axes.of(Text) if each.text.strip()
    ]


def box(axes: Axes, text: Text) -> Box:
    (left, right), (low, high) = ((0.0, 1.0), (0.0, 1.0)) if text.parts else (axes.x, axes.y)
    x = axes.left + axes.width * (text.x - left) / (right - left) + text.shift[0]
    y = axes.top + axes.height * (1.0 - (text.y - low) / (high - low)) - text.shift[1]
    first, upper, last, lower = extent(text)
    if text.turned:
        return x + upper, y - last, x + lower, y - first
    return x + first, y + upper, x + last, y + lower


def cut(figure: Figure) -> list[str]:
    """Return the texts that reach over the edge of a figure."""
    return [
        text
        for text, (left, upper, right, lower) in texts(figure)
        if min(left, upper) < -SLACK or right > figure.width + SLACK or lower > figure.height + SLACK
    ]


def clashes(figure: Figure) -> list[tuple[str, str]]:
    """Return the pairs of texts that meet."""
    return [
        (one, other)
        for (one, a), (other, b) in combinations(texts(figure), 2)
        if min(a[2], b[2]) - max(a[0], b[0]) > SLACK and min(a[3], b[3]) - max(a[1], b[1]) > SLACK
    ]
