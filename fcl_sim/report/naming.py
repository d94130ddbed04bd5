"""Names above an axis, in as many rows as it takes that no two meet."""

from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.axes import Axes

from fcl_sim.report import style

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
        text = style.cut(name.text, width / style.HINTED, style.SMALL)
        half = style.HINTED * style.text_width(text, style.SMALL) / 2.0
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
    width, height = style.size(axes)
    for each in placed:
        foot = 1.0 + (FOOT + ROW * each.row) / height
        axes.text(
            each.middle / width,
            foot,
            each.text,
            transform=axes.transAxes,
            ha="center",
            va="bottom",
            fontsize=style.SMALL,
            color=each.name.colour,
            zorder=5,
            # A leader passes behind the names below it.
            bbox={"facecolor": style.PAPER, "edgecolor": "none", "pad": 0.2},
        )
        if each.row:
            axes.plot(
                [each.name.anchor] * 2,
                [top, foot],
                transform=axes.transAxes,
                color=each.name.colour,
                linewidth=0.4,
                clip_on=False,
                zorder=2,
            )
