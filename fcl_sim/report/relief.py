"""A surface in space: its cells as tiles, seen from above and the side, the nearer ones over the farther."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from fcl_sim.loop.trace import Values
from fcl_sim.report import raster, style
from fcl_sim.report.canvas import Axes, Line, Shape, Text
from fcl_sim.report.frame import LINE, PAD, TICK, Ticks, ticks
from fcl_sim.report.lettering import cut, text_width, wrapped
from fcl_sim.report.words import number

FIRST, SECOND = (0.58, 0.16), (-0.42, 0.25)
"""Where the range of the first and that of the second input lead, in parts of the cube's drawing."""
RISE = 1.0 - FIRST[1] - SECOND[1]
"""What the range of the output rises, in parts of the drawing's height."""
CLEARLY = 1.25
"""A surface is turned where so many times as much of it is to be seen."""
NEAREST = (-SECOND[0], 0.0)
"""Where the corner of the least values stands."""

LETTERS = 2.3
"""Height of a number at a tick in mm."""
DOWN, BELOW = 0.6, 0.8
"""What a tick on the floor leads aside and down, and what its number stands below it, in mm."""
APART = 1.4
"""What lies between two numbers of an axis in mm, at least."""
MOST = 5
"""Intervals of an axis, at most."""
ONE = 0.4
"""A name that is wider than this part of the drawing may take a second line."""


Marks = Sequence[tuple[float, str]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Relief:
    """An output (m, n) at the corners of tiles over `x` (n,) and `y` (m,).

    `names` are those of both inputs and the output, each with its unit.
    """

    x: Values
    y: Values
    values: Values
    names: tuple[str, str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class Cube:
    """Where the cube around a surface is drawn on its axes, in mm from their lower left corner."""

    left: float
    foot: float
    width: float
    height: float

    def at(self, x: float, y: float, z: float) -> tuple[float, float]:
        """Return where a place in the unit cube is."""
        across, up = _seen(np.array(x), np.array(y), np.array(z))
        return self.left + float(across) * self.width, self.foot + float(up) * self.height


@dataclass(frozen=True, slots=True, kw_only=True)
class Scales:
    """The ticks of the three axes, each at its part of the range, and their names in lines."""

    marks: tuple[Marks, Marks, Marks]
    names: tuple[str, str, str]


def draw_relief(axes: Axes, relief: Relief, range_: tuple[float, float]) -> None:
    """Draw a surface; the back corner has the largest values of both inputs, or, turned, the least.

    It is turned where so much more of it is to be seen. Not finite: no tile.
    """
    low, high = range_
    axes.x, axes.y = (0.0, axes.width), (0.0, axes.height)
    height = (relief.values - low) / (high - low)
    places = _seen(*np.meshgrid(_parts(relief.x), _parts(relief.y)), height)
    behind = height[::-1, ::-1]
    round_ = _seen(*np.meshgrid(1.0 - _parts(relief.x)[::-1], 1.0 - _parts(relief.y)[::-1]), behind)
    turned = _in_sight(round_) > CLEARLY * _in_sight(places)
    if turned:
        places, height = round_, behind
    cube, scales = _placed(axes, relief, range_, turned=turned)
    _draw_edges(axes, cube)
    _draw_scales(axes, cube, scales)
    places = np.stack([cube.left + places[0] * cube.width, cube.foot + places[1] * cube.height])
    columns, rows = len(relief.x) - 1, len(relief.y) - 1
    for order in range(columns + rows - 2, -1, -1):  # from the back corner to the front
        for row in range(rows):
            column = order - row
            if 0 <= column < columns:
                corners = [places[:, row, column], places[:, row, column + 1]]
                corners += [places[:, row + 1, column + 1], places[:, row + 1, column]]
                x, y = np.array(corners).T
                if np.isfinite(y).all():
                    colour = raster.shade(float(np.mean(height[row : row + 2, column : column + 2])))
                    axes.add(Shape(x, y, colour, style.FAINT, 0.25, free=True))


def _parts(values: Values) -> Values:
    return np.asarray((values - values[0]) / (values[-1] - values[0]), np.float64)


def _seen(across: Values, up: Values, height: Values) -> Values:
    """Return where places in the unit cube are drawn, in parts of its drawing (2, ...)."""
    x = NEAREST[0] + across * FIRST[0] + up * SECOND[0]
    y = NEAREST[1] + across * FIRST[1] + up * SECOND[1] + height * RISE
    return np.stack([x, y])


def _in_sight(places: Values) -> float:
    """Return how much of the drawing the upper sides of tiles cover, each for itself, from their corners."""
    x, y = places
    one = x[1:, 1:] - x[:-1, :-1], y[1:, 1:] - y[:-1, :-1]
    other = x[1:, :-1] - x[:-1, 1:], y[1:, :-1] - y[:-1, 1:]
    areas = (one[0] * other[1] - one[1] * other[0]) / 2.0
    return float(areas[np.isfinite(areas)].clip(0.0).sum())


def _placed(axes: Axes, relief: Relief, range_: tuple[float, float], *, turned: bool) -> tuple[Cube, Scales]:
    """Return where the cube has its place between the numbers and names of its axes, and these."""
    first, second, third = relief.names
    spans = [(float(each[0]), float(each[-1])) for each in (relief.x, relief.y)]
    lines = 2 if max(text_width(each, style.SMALL) for each in (first, second)) > ONE * axes.width else 1
    foot = TICK + BELOW + LETTERS + PAD + LINE * lines
    height = axes.height - foot - LETTERS / 2.0
    up = _marks(range_, RISE * height, LETTERS)
    away = _marks(spans[1], SECOND[1] * height, LETTERS)
    beside = _broken(third, RISE * height, 2)
    left = LINE * (beside.count("\n") + 1) + PAD + max(_widest(up), _widest(away)) + PAD + TICK
    possible = [*_parted(ticks(*spans[0], MOST), spans[0]), *_ends(spans[0])]
    width = axes.width - left - TICK - _widest(possible)
    across = _marks(spans[0], FIRST[0] * width)
    if turned:
        across, away = ([(1.0 - part, label) for part, label in each] for each in (across, away))
    cube = Cube(left=left, foot=foot, width=width, height=height)
    front = cube.at(0, 0, 0)[0]
    names = (_broken(first, axes.width - front - PAD, lines), _broken(second, front - PAD, lines), beside)
    return cube, Scales(marks=(across, away, up), names=names)


def _marks(span: tuple[float, float], length: float, size: float = 0.0) -> Marks:
    """Return round ticks whose numbers stand apart on `length` mm; one takes `size`, or its width.

    Where not even two have room, they are the ends of the range.
    """
    for most in range(MOST, 0, -1):
        found = _parted(ticks(*span, most), span)
        if len(found) > 1 and (found[1][0] - found[0][0]) * length >= (size or _widest(found)) + APART:
            return found
    return _ends(span)


def _ends(span: tuple[float, float]) -> Marks:
    return [(0.0, number(span[0])), (1.0, number(span[1]))]


def _parted(found: Ticks, span: tuple[float, float]) -> Marks:
    return [((each.at - span[0]) / (span[1] - span[0]), each.label) for each in found]


def _widest(marks: Marks) -> float:
    return max((text_width(label, style.SMALL) for _, label in marks), default=0.0)


def _broken(text: str, room: float, most: int) -> str:
    """Return a text in at most so many lines, without its middle where these do not hold it."""
    kept = most * room
    while (told := wrapped(cut(text, kept, style.SMALL), room, style.SMALL)).count("\n") >= most:
        kept *= 0.9
    return told


def _draw_edges(axes: Axes, cube: Cube) -> None:
    """Draw the edges of the cube at the back and the foot, three of them darker: its axes."""
    scaled = [((0, 0, 0), (1, 0, 0)), ((0, 0, 0), (0, 1, 0)), ((0, 1, 0), (0, 1, 1))]
    others = [((1, 0, 0), (1, 1, 0)), ((0, 1, 0), (1, 1, 0)), ((0, 1, 1), (1, 1, 1)), ((1, 1, 0), (1, 1, 1))]
    for edges, colour in ((others, style.GRID), (scaled, style.FAINT)):
        for start, end in edges:
            (x, y), (to_x, to_y) = cube.at(*start), cube.at(*end)
            axes.add(Line([x, to_x], [y, to_y], colour, 0.5, z=0.5, free=True))


def _draw_scales(axes: Axes, cube: Cube, scales: Scales) -> None:
    """Draw ticks with their numbers outside of the three axes, and the name of each beside it."""
    across, away, up = scales.marks
    small: dict[str, Any] = {"size": style.SMALL}
    for part, label in across:
        x, y = cube.at(part, 0, 0)
        axes.add(_tick((x, y), (DOWN, -DOWN)))
        axes.add(Text(x + DOWN, y - DOWN - BELOW, label, up="top", **small))
    for part, label in away:
        x, y = cube.at(0, part, 0)
        axes.add(_tick((x, y), (-DOWN, -DOWN)))
        axes.add(Text(x - DOWN - PAD, y - DOWN, label, across="right", up="top", **small))
    for part, label in up:
        x, y = cube.at(0, 1, part)
        axes.add(_tick((x, y), (-TICK, 0.0)))
        least = y if part * RISE * cube.height < LETTERS / 2.0 else y - LETTERS / 2.0
        axes.add(Text(x - TICK - PAD, least, label, across="right", up="bottom", **small))
    first, second, third = scales.names
    front, middle = cube.at(0, 0, 0)[0], cube.at(0, 1, 0.5)[1]
    below = cube.foot - TICK - BELOW - LETTERS
    axes.add(Text((front + PAD + axes.width) / 2.0, below, first, up="top", across="center", **small))
    axes.add(Text((front - PAD) / 2.0, below, second, up="top", across="center", **small))
    beside = LINE * (third.count("\n") + 1) / 2.0
    axes.add(Text(beside, middle, third, up="center", across="center", turned=True, **small))


def _tick(at: tuple[float, float], step: tuple[float, float]) -> Line:
    (x, y), (right, above) = at, step
    return Line([x, x + right], [y, y + above], style.FAINT, 0.5, z=0.5, free=True)
