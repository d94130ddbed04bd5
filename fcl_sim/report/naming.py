"""Names above an axis, in as many rows as it takes that no two meet."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from fcl_sim.report import lettering, style
from fcl_sim.report.canvas import Axes, Line, Text

ROW = 3.1
"""Height of a row of names in mm."""
APART = 2.0
"""What lies between two names of a row, in mm."""
FOOT = 0.9
"""Room between the axis and the lowest row, in mm."""


@dataclass(frozen=True, slots=True)
class Name:
    """A text that belongs to the place `anchor` of an axis, in parts of its width."""

    text: str
    anchor: float
    colour: str = style.INK


@dataclass(frozen=True, slots=True)
class Placed:
    """A name, cut where it must be, with its row from 0 upwards and the mm of its middle from the left."""

    name: Name
    text: str
    row: int
    middle: float


def arranged(names: Sequence[Name], width: float) -> list[Placed]:
    """Return names over an axis of `width` mm, from left to right, each as low as there is room."""
    ends: list[float] = []
    placed = []
    for name in sorted(names, key=lambda each: each.anchor):
        text = lettering.cut(name.text, width / style.HINTED, style.SMALL)
        half = style.HINTED * lettering.text_width(text, style.SMALL) / 2.0
        middle = min(max(name.anchor * width, half), width - half)
        row = next((row for row, end in enumerate(ends) if end < middle - half), len(ends))
        ends[row : row + 1] = [middle + half + APART]
        placed.append(Placed(name, text, row, middle))
    return placed


def height_of(placed: Sequence[Placed]) -> float:
    """Return the mm that names take above their axis: a row even where there is none."""
    return ROW * (max((each.row for each in placed), default=0) + 1)


def draw_names(axes: Axes, placed: Sequence[Placed], top: float = 1.0) -> None:
    """Write names above axes; those of higher rows have a leader to `top`, in parts of the axes' height."""
    for each in placed:
        foot = 1.0 + (FOOT + ROW * each.row) / axes.height
        at = (each.middle / axes.width, foot)
        # A leader passes behind the names below it.
        name = Text(*at, each.text, style.SMALL, across="center", up="bottom", backed=0.1, z=5, parts=True)
        axes.add(replace(name, colour=each.name.colour))
        if each.row:
            leader = Line([each.name.anchor] * 2, [top, foot], each.name.colour, 0.4, parts=True, free=True)
            axes.add(leader)
