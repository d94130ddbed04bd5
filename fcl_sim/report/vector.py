"""Figure → SVG whose text is text, the same bytes every time."""

import io
import re
from functools import cache
from html import unescape
from itertools import groupby

from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.font_manager import findfont, get_font

from fcl_sim.report.style import FONT, styled, text_width

FOREIGN = re.compile(r'<text style="([^"]*)"([^>]*)>([^<]*[^\x00-\x7f][^<]*)</text>')
LAST_RESORT = "Last Resort High-Efficiency"
"""The font that has a box for every character."""

BEFORE = {"start": 0.0, "middle": 0.5, "end": 1.0}


def svg(figure: Figure) -> bytes:
    """Return a figure as SVG."""
    out = io.StringIO()
    with styled():
        FigureCanvasSVG(figure)
        figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None})
        return FOREIGN.sub(_in_pieces, out.getvalue()).encode()


def _in_pieces(found: re.Match[str]) -> str:
    """Return a text in which what the font lacks stands in pieces of their own, each with its place.

    The renderer would set all of a text in the font of last resort otherwise.
    """
    style, rest, escaped = found.groups()
    runs = groupby(escaped, key=lambda each: ord(each) in _known())
    pieces = [("".join(run), known) for known, run in runs]
    if all(known for _, known in pieces):
        return found[0]
    size = _given(r"font-size: ([\d.]+)px", style, 10.0)
    widths = [text_width(unescape(piece), size) / 25.4 * 72.0 for piece, _ in pieces]
    anchor = re.search(r"text-anchor: (\w+)", style)
    x = _given(r' x="([-\d.]+)"', rest, 0.0) - BEFORE[anchor[1] if anchor else "start"] * sum(widths)
    spans = []
    for (piece, known), width in zip(pieces, widths, strict=True):
        font = f"font-family: '{FONT if known else LAST_RESORT}'; text-anchor: start"
        spans.append(f'<tspan x="{x:.3f}" style="{font}">{piece}</tspan>')
        x += width
    return f'<text style="{style}"{rest}>{"".join(spans)}</text>'


def _given(pattern: str, text: str, otherwise: float) -> float:
    found = re.search(pattern, text)
    return float(found[1]) if found else otherwise


@cache
def _known() -> frozenset[int]:
    """Return the characters of the figures' font."""
    return frozenset(get_font(findfont(FONT)).get_charmap())
