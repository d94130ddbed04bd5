"""The frame of axes: ticks, their labels, a faint grid, the names of both axes.

Drawn as a few lines and texts: matplotlib's own ticks are five artists each,
and took most of the time of a report.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.ticker import MaxNLocator

from fcl_sim.report import style
from fcl_sim.report.words import number

TICK = 0.8
"""Length of a tick in mm."""
PAD = 0.7
LINE = 3.4
"""Height of a line of a label in mm."""
DIGITS = 6


@dataclass(frozen=True, slots=True)
class Tick:
    """A place on an axis and what is written there."""

    at: float
    label: str


Ticks = Sequence[Tick]


def ticks(low: float, high: float, most: int) -> list[Tick]:
    """Return at most about `most` round ticks from `low` to `high`."""
    slack = 1e-9 * (high - low)
    found = MaxNLocator(most, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
    places = [float(at) for at in found if low - slack <= at <= high + slack]
    return [Tick(at, number(at, DIGITS)) for at in places]


def room_left(up: Ticks, label: str = "") -> float:
    """Return the mm that ticks, their labels and the lines of the axis' name take on the left."""
    widest = max((style.text_width(each.label, style.SMALL) for each in up), default=0.0)
    return TICK + 2 * PAD + widest + (PAD + LINE * lines(label) if label else 0.0)


def room_below(label: str = "") -> float:
    """Return the mm that ticks, their labels and the lines of the axis' name take below."""
    return TICK + PAD + LINE + (PAD + LINE * lines(label) if label else 0.0)


def lines(label: str) -> int:
    """Return the lines of a label."""
    return label.count("\n") + 1


def draw_frame(
    axes: Axes,
    across: Ticks,
    up: Ticks,
    names: tuple[str, str] = ("", ""),
    *,
    labels: bool = True,
    grid: bool = True,
) -> None:
    """Frame axes whose limits are set: grid, ticks, and with `labels` the labels of those below."""
    axes.set_axis_off()
    width, height = style.size(axes)
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    xs = [(each.at - left) / (right - left) for each in across]
    ys = [(each.at - low) / (high - low) for each in up]
    if grid:
        _lines(axes, [((x, 0), (x, 1)) for x in xs] + [((0, y), (1, y)) for y in ys], style.GRID, 0.4, 0.5)
    outside = [((x, 0), (x, -TICK / height)) for x in xs] + [((0, y), (-TICK / width, y)) for y in ys]
    _lines(axes, [*outside, ((0, 0), (1, 0)), ((0, 0), (0, 1))], style.FAINT, 0.5, 2.5)
    if labels:
        for x, each in zip(xs, across, strict=True):
            _text(axes, (x, -(TICK + PAD) / height), each.label, ha="center", va="top")
    for y, each in zip(ys, up, strict=True):
        _text(axes, (-(TICK + PAD) / width, y), each.label, ha="right", va="center")
    below, beside = names
    if below:
        at = (0.5, -room_below() / height)
        axes.text(*at, below, transform=axes.transAxes, ha="center", va="top")
    if beside:
        at = (-room_left(up) / width, 0.5)
        axes.text(*at, beside, transform=axes.transAxes, ha="right", va="center", rotation=90)


def draw_scale(axes: Axes, up: Ticks, name: str) -> None:
    """Put ticks, labels and a name to the right of axes whose limits are set: a colour bar."""
    axes.set_axis_off()
    width, _ = style.size(axes)
    low, high = axes.get_ylim()
    ys = [(each.at - low) / (high - low) for each in up]
    edge = [((0, 0), (1, 0)), ((1, 0), (1, 1)), ((1, 1), (0, 1)), ((0, 1), (0, 0))]
    _lines(axes, [*edge, *(((1, y), (1 + TICK / width, y)) for y in ys)], style.FAINT, 0.5, 2.5)
    for y, each in zip(ys, up, strict=True):
        _text(axes, (1 + (TICK + PAD) / width, y), each.label, ha="left", va="center")
    at = (1 + (room_left(up) + PAD) / width, 0.5)
    axes.text(*at, name, transform=axes.transAxes, ha="left", va="center", rotation=90)


Segment = tuple[tuple[float, float], tuple[float, float]]


def _lines(axes: Axes, segments: Sequence[Segment], colour: str, width: float, zorder: float) -> None:
    drawn = LineCollection(segments, colors=colour, linewidths=width, transform=axes.transAxes)
    drawn.set(zorder=zorder, clip_on=False)
    axes.add_collection(drawn, autolim=False)


def _text(axes: Axes, at: tuple[float, float], text: str, ha: str, va: str) -> None:
    axes.text(*at, text, transform=axes.transAxes, ha=ha, va=va, fontsize=style.SMALL)
