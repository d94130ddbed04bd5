"""A wiring as figures: what is read, the blocks in their order of execution, what is written."""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from fcl_sim.loop.wiring import Wiring
from fcl_sim.report import style
from fcl_sim.report.canvas import Axes, Dot, Figure, Line, Shape, Text, rectangle
from fcl_sim.report.pictures import Picture, numbered
from fcl_sim.report.wiring_boxes import CONTINUED, GOES_ON, GRID, HEAD, PAD, READ, WRITTEN, Box, in_columns
from fcl_sim.report.wiring_layout import Drawing, Path
from fcl_sim.report.wiring_rows import Sheet, sheets
from fcl_sim.report.words import one_line

FILLS = {
    READ: style.BAND,
    WRITTEN: style.BAND,
    CONTINUED: style.PAPER,
    "inside": style.PAPER,
    "beside": style.UNDEFINED,
}

LATE = (3.0, 2.0)
"""Dashes of a wire that carries the value of the last scan."""


def draw(sheet: Sheet, colours: Mapping[str, str]) -> Figure:
    """Return rows of a wiring below one another as one figure, as large as they take."""
    figure = Figure(sum(each.height for each in sheet), max(each.width for each in sheet))
    top = 0.0
    for row in sheet:
        axes = figure.place(0.0, top, row.width, row.height)
        axes.x, axes.y = (0.0, row.width), (row.height, 0.0)
        _row(axes, row, colours)
        top += row.height
    return figure


def pictures(wiring: Wiring, title: str) -> list[Picture]:
    """Return the figures of a wiring, one for each sheet, with captions and alternative texts."""
    made = sheets(wiring)
    colours = colours_of(made)
    told = alt(wiring)
    found = []
    for index, sheet in enumerate(made):
        part = f", sheet {index + 1} of {len(made)}" if len(made) > 1 else ""
        found.append(
            Picture(
                name=numbered("wiring", index, len(made)),
                caption=f"{one_line(title)}{part}: {_caption(made) if index == 0 else CONTINUES}",
                alt=told if index == 0 else f"{one_line(title)}{part}: told with the first one.",
                draw=partial(draw, sheet, colours),
                size=(max(each.width for each in sheet), sum(each.height for each in sheet)),
            )
        )
    return found


CONTINUES = "the rows below those of the sheet before."


def _caption(made: Sequence[Sheet]) -> str:
    broken = sum(len(each) for each in made) > 1
    rows = (
        f" A signal with{GOES_ON} is read in a row below, too, which it enters by its name, from above."
        if broken
        else ""
    )
    return (
        "blocks in the order of their execution, with their signals and units. "
        f"The plant stands twice, as it is read and as it is written.{rows} What a block reads of the last "
        "scan comes by a dashed wire, or is named in it where that would run back; a constant is named where "
        "it is read. Blocks outside of the controller are shaded."
    )


def alt(wiring: Wiring) -> str:
    """Return a wiring in words."""
    told = []
    for box in (each for column in in_columns(wiring) for each in column):
        read = [f"{port.text} of {port.signal}" if port.signal else port.text for port in box.entries]
        given = [port.text for port in box.exits]
        parts = [f"reads {', '.join(read)}"] if read else []
        parts += [f"gives {', '.join(given)}"] if given else []
        told.append(f"{box.title} ({box.text}) {' and '.join(parts)}".strip())
    return one_line(f"Block diagram. {'; '.join(told)}.")


def colours_of(made: Sequence[Sheet]) -> dict[str, str]:
    """Return a colour for each signal, the same in every row."""
    signals = dict.fromkeys(path.signal for sheet in made for row in sheet for path in row.paths)
    return {signal: style.stroke(number)[0] for number, signal in enumerate(signals)}


def _row(page: Axes, row: Drawing, colours: Mapping[str, str]) -> None:
    for signal, height, left, right in row.passing:
        page.add(_stroke([left, right], [height, height], colours[signal], late=signal in row.late))
    for path in row.paths:
        page.add(*_wire(path, colours[path.signal], late=path.signal in row.late))
    for box in row.boxes:
        page.add(*_box(box))


def _stroke(x: Sequence[float], y: Sequence[float], colour: str, *, late: bool) -> Line:
    return Line(x, y, colour, 0.7, LATE if late else ())


def _wire(path: Path, colour: str, *, late: bool) -> Iterator[Line | Shape | Dot]:
    """Yield a signal in its channel, with an arrow where it enters a box and a dot where it parts."""
    low, high = path.span
    yield _stroke([path.left, path.track], [path.start, path.start], colour, late=late)
    yield _stroke([path.track, path.track], [low, high], colour, late=late)
    for each in path.ends:
        y, right = each.height, each.right
        yield _stroke([path.track, right], [y, y], colour, late=each.late)
        if each.enters:
            yield Shape([right, right - 1.5, right - 1.5], [y, y - 0.55, y + 0.55], colour)
        if low < y < high:
            yield Dot(path.track, y, "circle", colour, 2.8)


def _box(box: Box) -> Iterator[Line | Shape | Text]:
    sides = (box.left, box.left + box.width)
    yield rectangle(sides, (box.top, box.bottom), FILLS[box.kind], edge=style.INK, width=0.8, z=3)
    middle = box.left + box.width / 2
    yield Text(middle, box.top + 0.65 * GRID, box.title, across="center", up="center", z=4)
    small: dict[str, Any] = {"size": style.SMALL, "up": "center", "z": 4}
    yield Text(middle, box.top + 1.5 * GRID, box.text, colour=style.FAINT, across="center", **small)
    line = box.top + (HEAD - 0.9) * GRID
    yield Line(sides, [line, line], style.GRID, 0.6, flat=True, z=4)
    for index, port in enumerate(box.entries):
        yield Text(box.left + PAD, box.entry(index), port.text, **small)
    for index, port in enumerate(box.exits):
        yield Text(box.left + box.width - PAD, box.exit(index), port.text, across="right", **small)
