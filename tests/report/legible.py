"""Whether a figure can be read: no text is cut, no two meet."""

from itertools import combinations

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from fcl_sim.report.style import styled

SLACK = 0.6
"""Pixels by which extents may overlap: the box of a text is larger than its letters."""


def texts(figure: Figure) -> list[tuple[str, Bbox]]:
    """Return every text that is drawn, with its box in pixels."""
    with styled():
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        axis = [axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)]
        unused = {text for each in axis for text in each.findobj(Text)}
        artists = [each for each in figure.findobj(Text) if each.get_text().strip() and each not in unused]
        return [(each.get_text(), each.get_window_extent(canvas.get_renderer())) for each in artists]


def cut(figure: Figure) -> list[str]:
    """Return the texts that reach over the edge of a figure."""
    width, height = figure.bbox.width, figure.bbox.height
    return [
        text
        for text, box in texts(figure)
        if box.x0 < -SLACK or box.y0 < -SLACK or box.x1 > width + SLACK or box.y1 > height + SLACK
    ]


def clashes(figure: Figure) -> list[tuple[str, str]]:
    """Return the pairs of texts that meet."""
    return [
        (one, other)
        for (one, a), (other, b) in combinations(texts(figure), 2)
        if min(a.x1, b.x1) - max(a.x0, b.x0) > SLACK and min(a.y1, b.y1) - max(a.y0, b.y0) > SLACK
    ]
