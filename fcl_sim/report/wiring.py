"""A wiring as a figure: what is read, the blocks in their order of execution, what is written."""

from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any

from fcl_sim.loop.wiring import Wiring
from fcl_sim.report import style
from fcl_sim.report.canvas import Axes, Dot, Figure, Line, Shape, Text, rectangle
from fcl_sim.report.pictures import Picture
from fcl_sim.report.wiring_layout import GRID, HEAD, PAD, READ, WRITTEN, Box, Drawing, Path, Port, laid_out
from fcl_sim.report.words import one_line

FILLS = {READ: style.BAND, WRITTEN: style.BAND, "inside": style.PAPER, "beside": style.UNDEFINED}

LATE = (3.0, 2.0)
"""Dashes of a wire that carries the value of the last scan."""


def draw(wiring: Wiring) -> Figure:
    """Return a wiring as one figure, as large as it takes."""
    drawing = laid_out(wiring)
    figure = Figure(drawing.height, drawing.width)
    page = figure.page()
    colours = _colours(drawing)
    for signal, height, left, right in drawing.passing:
        page.add(_stroke([left, right], [height, height], colours[signal], late=signal in drawing.late))
    for path in drawing.paths:
        _wire(page, path, drawing, colours[path.signal])
    for box in drawing.boxes:
        _box(page, box)
    return figure


def picture(wiring: Wiring, title: str) -> Picture:
    """Return the figure of `draw` with its caption and its alternative text."""
    caption = (
        f"{one_line(title)}: blocks in the order of their execution, with their signals and units. "
        "The plant stands twice, as it is read and as it is written; what a block reads of the last scan "
        "comes by a dashed wire, or is named in it where that would run back; a constant is named where it "
        "is read. Blocks outside of the controller are shaded."
    )
    drawing = laid_out(wiring)
    return Picture(
        name="wiring",
        caption=caption,
        alt=alt(wiring),
        draw=partial(draw, wiring),
        size=(drawing.width, drawing.height),
    )


def alt(wiring: Wiring) -> str:
    """Return a wiring in words."""
    told = []
    for box in laid_out(wiring).boxes:
        read = [f"{port.text} of {port.signal}" if port.signal else port.text for port in box.entries]
        given = [port.text for port in box.exits]
        parts = [f"reads {', '.join(read)}"] if read else []
        parts += [f"gives {', '.join(given)}"] if given else []
        told.append(f"{box.title} ({box.text}) {' and '.join(parts)}".strip())
    return one_line(f"Block diagram. {'; '.join(told)}.")


def _colours(drawing: Drawing) -> dict[str, str]:
    signals = dict.fromkeys(path.signal for path in drawing.paths)
    return {signal: style.stroke(number)[0] for number, signal in enumerate(signals)}


def _stroke(x: Sequence[float], y: Sequence[float], colour: str, *, late: bool) -> Line:
    return Line(x, y, colour, 0.7, LATE if late else ())


def _wire(page: Axes, path: Path, drawing: Drawing, colour: str) -> None:
    """Draw a signal in its channel, with an arrow where it enters a box and a dot where it parts."""
    late = path.signal in drawing.late
    page.add(_stroke([path.left, path.track], [path.start, path.start], colour, late=late))
    heights = (path.start, *path.ends)
    page.add(_stroke([path.track, path.track], [min(heights), max(heights)], colour, late=late))
    for each in path.ends:
        box, port = next(_entered(drawing, path, each), (None, None))
        right = box.left if box is not None else path.right
        of_last = port.late if port is not None else late
        page.add(_stroke([path.track, right], [each, each], colour, late=of_last))
        if box is not None:
            page.add(Shape([right, right - 1.5, right - 1.5], [each, each - 0.55, each + 0.55], colour))
        if min(heights) < each < max(heights):
            page.add(Dot(path.track, each, "circle", colour, 2.8))


def _entered(drawing: Drawing, path: Path, height: float) -> Iterator[tuple[Box, Port]]:
    """Yield the box that a signal enters at a height, and its port there."""
    for box in drawing.boxes:
        for index, port in enumerate(box.entries):
            if port.signal == path.signal and box.entry(index) == height and box.left >= path.right:
                yield box, port


def _box(page: Axes, box: Box) -> None:
    sides = (box.left, box.left + box.width)
    fill = FILLS[box.kind]
    page.add(rectangle(sides, (box.top, box.bottom), fill, edge=style.INK, width=0.8, z=3))
    middle = box.left + box.width / 2
    page.add(Text(middle, box.top + 0.65 * GRID, box.title, across="center", up="center", z=4))
    small: dict[str, Any] = {"size": style.SMALL, "up": "center", "z": 4}
    page.add(Text(middle, box.top + 1.5 * GRID, box.text, colour=style.FAINT, across="center", **small))
    line = box.top + (HEAD - 0.9) * GRID
    page.add(Line(sides, [line, line], style.GRID, 0.6, flat=True, z=4))
    for index, port in enumerate(box.entries):
        page.add(Text(box.left + PAD, box.entry(index), port.text, **small))
    for index, port in enumerate(box.exits):
        page.add(Text(box.left + box.width - PAD, box.exit(index), port.text, across="right", **small))
