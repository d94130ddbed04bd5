"""The one style of all figures: sizes, colours, strokes, ticks."""

import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import lru_cache
from types import MappingProxyType
from typing import Any

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

FONT = "DejaVu Sans"

WIDTH = 166.0
"""Width of a figure in mm: the text column of the report."""

INK = "#1b1f24"
FAINT = "#5c6670"
GRID = "#e6e8eb"
PAPER = "#ffffff"
BAND = "#e3edf5"
BOUND = "#3f5f7f"
VIOLATION = "#f9d8c4"
VIOLATION_EDGE = "#c2540a"
UNDEFINED = "#eceef0"

COLOURS = ("#0b5fa5", "#d55e00", "#00805f", "#b0568c", "#8a6d00", "#3a9bd0", "#4d4d4d")
"""Runs and terms in turn, after Okabe and Ito, darkened to 3:1 on white."""

Dash = str | tuple[float, tuple[float, ...]]

DASHES: tuple[Dash, ...] = ("solid", (0, (5, 1.6)), (0, (1.2, 1.2)), (0, (6, 1.5, 1.2, 1.5)), (0, (2.5, 1.2)))
"""Strokes in turn, so that runs differ in grey as well; coprime with the colours."""

HEAT = ("#3d6590", "#5a94a8", "#8fbfae", "#cfdfae", "#fbf3c9")

SMALL = 6.4
NORMAL = 7.2

HINTED = 1.08
"""Drawn on few pixels, text may be so much wider than measured."""

RC: Mapping[Any, object] = MappingProxyType(
    {
        "font.family": [FONT],
        "font.size": NORMAL,
        "text.parse_math": False,
        "text.color": INK,
        "hatch.linewidth": 0.45,
        "lines.linewidth": 1.0,
        "lines.solid_capstyle": "round",
        "lines.solid_joinstyle": "round",
        "svg.fonttype": "none",
        "svg.hashsalt": "fcl_sim",
        "path.simplify": True,
    }
)


@contextmanager
def styled() -> Iterator[None]:
    """Draw and save inside this; matplotlib's settings return to the caller's afterwards."""
    with mpl.rc_context(dict(RC)), warnings.catch_warnings():
        # A name may hold any character. What DejaVu lacks is drawn as a box in
        # a PNG; in the PDF the text itself is kept.
        warnings.filterwarnings("ignore", message=r"Glyph \d+ .* missing from font")
        yield


def blank(height: float, width: float = WIDTH) -> Figure:
    """Return an empty figure of `width` × `height` mm."""
    return Figure(figsize=(width / 25.4, height / 25.4), facecolor=PAPER)


def place(figure: Figure, left: float, top: float, width: float, height: float) -> Axes:
    """Add axes to a figure, all in mm from its upper left corner."""
    across, down = (each * 25.4 for each in figure.get_size_inches())
    return figure.add_axes((left / across, 1.0 - (top + height) / down, width / across, height / down))


def size(axes: Axes) -> tuple[float, float]:
    """Return width and height of axes in mm."""
    box = axes.get_position()
    across, down = axes.figure.bbox.width, axes.figure.bbox.height
    inch = axes.figure.dpi / 25.4
    return box.width * across / inch, box.height * down / inch


def stroke(index: int) -> tuple[str, Dash]:
    """Return colour and dashes of the run, or the term, number `index`."""
    return COLOURS[index % len(COLOURS)], DASHES[index % len(DASHES)]


def heat() -> LinearSegmentedColormap:
    """Return the colours of a heat map: they rise evenly in grey too, and are light enough to draw over."""
    return LinearSegmentedColormap.from_list("heat", HEAT, N=256)


def hatch_span(axes: Axes, start: float, end: float, top: float = 1.0) -> None:
    """Hatch an axis from `start` to `end`, up to the fraction `top` of its height: undefined."""
    axes.axvspan(
        start, end, 0.0, top, facecolor=UNDEFINED, edgecolor=FAINT, hatch="//////", linewidth=0, zorder=3
    )


@lru_cache(maxsize=4096)
def text_width(text: str, size: float = NORMAL) -> float:
    """Return the width of one line of text in mm."""
    width, _, _ = text_to_path.get_text_width_height_descent(
        text, FontProperties(family=[FONT], size=size), ismath=False
    )
    return float(width) / 72.0 * 25.4


def wrapped(text: str, width: float, size: float = NORMAL) -> str:
    """Break text into lines of at most `width` mm: at blanks, after `.`, `_`, `/`, else anywhere.

    A number is broken only where nothing else helps.
    """
    lines: list[str] = []
    line = ""
    for piece in _pieces(text):
        if line and text_width(line + piece, size) > width:
            lines.append(line.rstrip())
            line = ""
        line += piece if line else piece.lstrip()
        while text_width(line, size) > width and len(line) > 1:
            cut = max(1, int(len(line) * width / text_width(line, size)) - 1)
            lines.append(line[:cut])
            line = line[cut:]
    return "\n".join([*lines, line.rstrip()])


def _pieces(text: str) -> list[str]:
    pieces = [""]
    for character, after in zip(text, (text + " ")[1:], strict=True):
        pieces[-1] += character
        if character in " ._/," and not (character == "." and after.isdigit()):
            pieces.append("")
    return [piece for piece in pieces if piece]


def cut(text: str, width: float, size: float = NORMAL) -> str:
    """Return text of at most `width` mm: what is too long loses its middle to an ellipsis."""
    if text_width(text, size) <= width:
        return text
    kept = len(text)
    while kept > 2:
        kept = min(kept - 1, int(kept * width / max(text_width(text[:kept], size), 1e-9)))
        shorter = text[: (kept + 1) // 2] + "…" + text[len(text) - kept // 2 :]
        if text_width(shorter, size) <= width:
            return shorter
    return "…"
