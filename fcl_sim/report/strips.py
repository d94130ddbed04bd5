"""Strips: a figure made of parts below one another, in one piece or on pages."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from fcl_sim.report import lettering, style
from fcl_sim.report.canvas import Across, Axes, Figure, Line, Text, rectangle

LINE = {style.NORMAL: 3.3, style.SMALL: 2.9}
"""Height of a line of text in mm, by its size."""
COLUMN = style.WIDTH / style.HINTED
"""Width for lines of text in mm."""
EDGE = 0.4
"""What strokes keep from the edge of the figure, in mm."""
BASE = 0.74
"""Where its letters stand, as a share of that."""


@dataclass(frozen=True, slots=True)
class Strip:
    """A part of `height` mm over the whole width, painted on a figure, its page, from a place downwards.

    A heading stays with the strip below it.
    """

    height: float
    paint: Callable[[Figure, Axes, float], None]
    heading: bool = False


def stacked(strips: Sequence[Strip]) -> Figure:
    """Return strips below one another."""
    figure = Figure(max(sum(each.height for each in strips), 1.0))
    page = figure.page()
    top = 0.0
    for each in strips:
        each.paint(figure, page, top)
        top += each.height
    return figure


def parted(strips: Sequence[Strip], height: float) -> list[list[Strip]]:
    """Return strips on pages of at most `height` mm; a strip that is higher has one of its own."""
    pages: list[list[Strip]] = [[]]
    for index, each in enumerate(strips):
        needed = each.height
        if each.heading and index + 1 < len(strips):
            needed += strips[index + 1].height
        follows = bool(pages[-1]) and pages[-1][-1].heading
        if pages[-1] and not follows and sum(strip.height for strip in pages[-1]) + needed > height:
            pages.append([])
        pages[-1].append(each)
    return pages


def text_height(text: str, size: float = style.NORMAL) -> float:
    """Return the mm that lines of text take."""
    return LINE[size] * (text.count("\n") + 1) if text else 0.0


def write(
    page: Axes,
    at: tuple[float, float],
    text: str,
    *,
    size: float = style.NORMAL,
    colour: str = style.INK,
    align: Across = "left",
) -> None:
    """Write lines of text on a page; `at` is their upper left corner, or with `align` another, in mm."""
    x, top = at
    for row, line in enumerate(text.split("\n") if text else []):
        page.add(Text(x, top + LINE[size] * (row + BASE), line, size, colour, across=align))


def draw_bar(page: Axes, corner: tuple[float, float], size: tuple[float, float], degree: float) -> None:
    """Draw a degree as a bar, filled along its longer side; `corner` is its upper left one, all in mm."""
    (x, y), (width, height) = corner, size
    part = min(max(degree, 0.0), 1.0)
    along = width >= height
    across, down = (width * part, 0.0) if along else (width, height * (1.0 - part))
    label = f"degree {degree!r}"
    page.add(rectangle((x, x + across), (y + down, y + height), style.BOUND, z=3, label=label))
    page.add(rectangle((x, x + width), (y, y + height), edge=style.FAINT))


def headline(text: str, more: str = "") -> Strip:
    """Return the heading of a section, with `more` in small letters below it."""
    small = lettering.wrapped(more, COLUMN, style.SMALL) if more else ""

    def paint(_: Figure, page: Axes, top: float) -> None:
        page.add(Line([0.0, style.WIDTH], [top + 1.6, top + 1.6], style.FAINT, 0.5))
        write(page, (0.0, top + 2.4), text)
        write(page, (0.0, top + 2.4 + LINE[style.NORMAL]), small, size=style.SMALL, colour=style.FAINT)

    return Strip(2.4 + LINE[style.NORMAL] + text_height(small, style.SMALL) + 1.2, paint, heading=True)
