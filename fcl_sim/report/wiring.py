"""A wiring as a figure: what is read, the blocks in their order of execution, what is written."""

from functools import partial
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from fcl_sim.loop.wiring import Wiring
from fcl_sim.report import style
from fcl_sim.report.pictures import Picture
from fcl_sim.report.wiring_layout import GRID, HEAD, PAD, READ, WRITTEN, Box, Drawing, Path, laid_out
from fcl_sim.report.words import one_line

FILLS = {READ: style.BAND, WRITTEN: style.BAND, "inside": style.PAPER, "beside": style.UNDEFINED}


def draw(wiring: Wiring) -> Figure:
    """Return a wiring as one figure, as large as it takes."""
    drawing = laid_out(wiring)
    with style.styled():
        figure = style.blank(drawing.height, drawing.width)
        page = style.place(figure, 0.0, 0.0, drawing.width, drawing.height)
        page.set(xlim=(0.0, drawing.width), ylim=(drawing.height, 0.0))
        page.set_axis_off()
        colours = _colours(drawing)
        for signal, height, left, right in drawing.passing:
            page.plot([left, right], [height, height], color=colours[signal], linewidth=0.7)
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
        "is named in it. Blocks outside of the controller are shaded."
    )
    return Picture(name="wiring", caption=caption, alt=alt(wiring), draw=partial(draw, wiring))


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


def _wire(page: Axes, path: Path, drawing: Drawing, colour: str) -> None:
    """Draw a signal in its channel, with an arrow where it enters a box and a dot where it parts."""
    page.plot([path.left, path.track], [path.start, path.start], color=colour, linewidth=0.7)
    heights = (path.start, *path.ends)
    page.plot([path.track, path.track], [min(heights), max(heights)], color=colour, linewidth=0.7)
    for each in path.ends:
        box = next((box for box in drawing.boxes if _enters(box, path, each)), None)
        right = box.left if box is not None else path.right
        page.plot([path.track, right], [each, each], color=colour, linewidth=0.7)
        if box is not None:
            page.fill([right, right - 1.5, right - 1.5], [each, each - 0.55, each + 0.55], color=colour, lw=0)
        if min(heights) < each < max(heights):
            page.plot([path.track], [each], "o", color=colour, markersize=1.8)


def _enters(box: Box, path: Path, height: float) -> bool:
    return any(
        port.signal == path.signal and box.entry(index) == height and box.left >= path.right
        for index, port in enumerate(box.entries)
    )


def _box(page: Axes, box: Box) -> None:
    height = box.bottom - box.top
    page.add_patch(
        Rectangle(
            (box.left, box.top),
            box.width,
            height,
            facecolor=FILLS[box.kind],
            edgecolor=style.INK,
            linewidth=0.8,
            zorder=3,
        )
    )
    middle = box.left + box.width / 2
    words: dict[str, Any] = {"va": "center", "zorder": 4}
    page.text(middle, box.top + 0.65 * GRID, box.title, ha="center", fontsize=style.NORMAL, **words)
    small: dict[str, Any] = {"fontsize": style.SMALL, **words}
    page.text(middle, box.top + 1.5 * GRID, box.text, ha="center", color=style.FAINT, **small)
    line = box.top + (HEAD - 0.9) * GRID
    page.plot([box.left, box.left + box.width], [line, line], color=style.GRID, linewidth=0.6, zorder=4)
    for index, port in enumerate(box.entries):
        page.text(box.left + PAD, box.entry(index), port.text, ha="left", **small)
    for index, port in enumerate(box.exits):
        page.text(box.left + box.width - PAD, box.exit(index), port.text, ha="right", **small)
