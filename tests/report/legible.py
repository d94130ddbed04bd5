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
        shown = []
        for artist in figure.findobj(Text):
            if artist.get_visible() and artist.get_text().strip():
                box = artist.get_window_extent(canvas.get_renderer())
                if box.width > 0 and _drawn(artist, figure):
                    shown.append((artist.get_text(), box))
    return shown


def _drawn(artist: Text, figure: Figure) -> bool:
    """Return whether matplotlib draws a text: ticks outside of an axis, and hidden labels, are not."""
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            ticks = axis.get_major_ticks() + axis.get_minor_ticks()
            if any(artist in (tick.label1, tick.label2) for tick in ticks):
                drawn = axis._update_ticks()
                return any(
                    (artist is tick.label1 and tick.label1.get_visible())
                    or (artist is tick.label2 and tick.label2.get_visible())
                    for tick in drawn
                )
    return True


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
