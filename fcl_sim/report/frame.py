"""The frame of axes: ticks, their labels, a faint grid, the names of both axes."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor, inf, log10

import numpy as np

from fcl_sim.report import lettering, style
from fcl_sim.report.canvas import Across, Axes, Line, Text, Up, joined
from fcl_sim.report.words import number

TICK = 0.8
"""Length of a tick in mm."""
PAD = 0.7
LINE = 3.4
"""Height of a line of a label in mm."""
DIGITS = 6
STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)
"""What ticks may be apart, times a power of ten."""


@dataclass(frozen=True, slots=True)
class Tick:
    """A place on an axis and what is written there."""

    at: float
    label: str


Ticks = Sequence[Tick]


def ticks(low: float, high: float, most: int) -> list[Tick]:
    """Return round ticks from `low` to `high`, `most` intervals or fewer."""
    span = high - low
    if not 0.0 < span < inf:
        return [Tick(low, number(low, DIGITS))]
    power = 10.0 ** floor(log10(span / most))
    step = next(each * power for each in STEPS if each * power * most >= span * (1.0 - 1e-9))
    first, last = ceil(low / step - 1e-9), floor(high / step + 1e-9)
    return [Tick(index * step, number(index * step, DIGITS)) for index in range(first, last + 1)]


def scale_of(low: float, high: float, most: int) -> list[Tick]:
    """Return round ticks as `ticks` does, two at least: a lone one tells no scale."""
    for intervals in range(most, 3 * most):
        found = ticks(low, high, intervals)
        if len(found) > 1:
            return found
    return ticks(low, high, most)


def room_left(up: Ticks, label: str = "") -> float:
    """Return the mm that ticks, their labels and the lines of the axis' name take on the left."""
    widest = max((lettering.text_width(each.label, style.SMALL) for each in up), default=0.0)
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
    width, height = axes.width, axes.height
    (left, right), (low, high) = axes.x, axes.y
    xs = [(each.at - left) / (right - left) for each in across]
    ys = [(each.at - low) / (high - low) for each in up]
    if grid:
        _lines(axes, [((x, 0), (x, 1)) for x in xs] + [((0, y), (1, y)) for y in ys], style.GRID, 0.4, 0.5)
    outside = [((x, 0), (x, -TICK / height)) for x in xs] + [((0, y), (-TICK / width, y)) for y in ys]
    _lines(axes, [*outside, ((0, 0), (1, 0)), ((0, 0), (0, 1))], style.FAINT, 0.5, 2.5)
    if labels:
        for x, each in zip(xs, across, strict=True):
            axes.add(_label(x, -(TICK + PAD) / height, each.label, across="center", up="top"))
    for y, each in zip(ys, up, strict=True):
        axes.add(_label(-(TICK + PAD) / width, y, each.label, across="right", up="center"))
    below, beside = names
    if below:
        axes.add(Text(0.5, -room_below() / height, below, across="center", up="top", parts=True))
    if beside:
        axes.add(_turned(-(room_left(up) + LINE * lines(beside) / 2.0) / width, beside))


def draw_scale(axes: Axes, up: Ticks, name: str) -> None:
    """Put ticks, labels and a name to the right of axes whose limits are set: a colour bar."""
    width = axes.width
    low, high = axes.y
    ys = [(each.at - low) / (high - low) for each in up]
    edge = [((0, 0), (1, 0)), ((1, 0), (1, 1)), ((1, 1), (0, 1)), ((0, 1), (0, 0))]
    _lines(axes, [*edge, *(((1, y), (1 + TICK / width, y)) for y in ys)], style.FAINT, 0.5, 2.5)
    for y, each in zip(ys, up, strict=True):
        axes.add(_label(1 + (TICK + PAD) / width, y, each.label, across="left", up="center"))
    axes.add(_turned(1 + (room_left(up) + PAD + LINE * lines(name) / 2.0) / width, name))


Segment = tuple[tuple[float, float], tuple[float, float]]


def _lines(axes: Axes, segments: Sequence[Segment], colour: str, width: float, z: float) -> None:
    if segments:
        x, y = joined([np.array(each, dtype=np.float64) for each in segments])
        axes.add(Line(x, y, colour, width, flat=True, z=z, parts=True, free=True))


def _label(x: float, y: float, text: str, *, across: Across, up: Up) -> Text:
    return Text(x, y, text, style.SMALL, across=across, up=up, parts=True)


def _turned(x: float, text: str) -> Text:
    """Return a text that reads upwards, its middle line at `x`."""
    return Text(x, 0.5, text, across="center", up="center", turned=True, parts=True)
