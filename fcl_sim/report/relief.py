"""A surface in space: its cells as tiles, seen from above and the side, the nearer ones over the farther."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from fcl_sim.loop.trace import Values
from fcl_sim.report import raster, style
from fcl_sim.report.canvas import Axes, Line, Shape, Text
from fcl_sim.report.words import number

FIRST, SECOND = (0.48, 0.13), (-0.34, 0.21)
"""Where the range of the first and that of the second input lead, in parts of the drawing's sides."""
RISE = 0.5
"""What the range of the output rises, in parts of the drawing's height."""
CLEARLY = 1.25
"""A surface is turned where so many times as much of it is to be seen."""
NEAREST = (0.5, 0.1)
"""Where the corner of the least values stands."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Relief:
    """An output (m, n) at the corners of tiles over `x` (n,) and `y` (m,), with the names of all three."""

    x: Values
    y: Values
    values: Values
    names: tuple[str, str, str]


def draw_relief(axes: Axes, relief: Relief, range_: tuple[float, float]) -> None:
    """Draw a surface; the back corner has the largest values of both inputs, or, turned, the least.

    It is turned where so much more of it is to be seen. Not finite: no tile.
    """
    low, high = range_
    height = (relief.values - low) / (high - low)
    places = _seen(*np.meshgrid(_parts(relief.x), _parts(relief.y)), height)
    behind = height[::-1, ::-1]
    round_ = _seen(*np.meshgrid(1.0 - _parts(relief.x)[::-1], 1.0 - _parts(relief.y)[::-1]), behind)
    turned = _in_sight(round_) > CLEARLY * _in_sight(places)
    if turned:
        places, height = round_, behind
    _draw_base(axes, relief, range_, turned=turned)
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
                    axes.add(Shape(x, y, colour, style.FAINT, 0.25, parts=True, free=True))


def _parts(values: Values) -> Values:
    return np.asarray((values - values[0]) / (values[-1] - values[0]), np.float64)


def _seen(across: Values, up: Values, height: Values) -> Values:
    """Return where places in the unit cube are drawn, in parts of the drawing (2, ...)."""
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


def _draw_base(axes: Axes, relief: Relief, range_: tuple[float, float], *, turned: bool) -> None:
    """Draw the edges of the cube at the back and the foot, with the ends of each range."""

    def at(x: float, y: float, z: float) -> tuple[float, float]:
        seen = _seen(np.array(x), np.array(y), np.array(z))
        return float(seen[0]), float(seen[1])

    ends = [((0, 0, 0), (1, 0, 0)), ((0, 0, 0), (0, 1, 0)), ((1, 0, 0), (1, 1, 0)), ((0, 1, 0), (1, 1, 0))]
    ends += [((0, 1, 0), (0, 1, 1)), ((0, 1, 1), (1, 1, 1)), ((1, 1, 0), (1, 1, 1))]
    for start, end in ends:
        (x, y), (to_x, to_y) = at(*start), at(*end)
        axes.add(Line([x, to_x], [y, to_y], style.GRID, 0.6, z=0.5, parts=True, free=True))
    first, second, third = relief.names
    small: dict[str, Any] = {"size": style.SMALL, "parts": True}
    x, y = at(0.5, 0, 0)
    axes.add(
        Text(x + 0.04, y - 0.02, f"← {first}" if turned else f"{first} →", across="left", up="top", **small)
    )
    x, y = at(0, 0.5, 0)
    axes.add(
        Text(
            x - 0.04, y - 0.02, f"{second} →" if turned else f"← {second}", across="right", up="top", **small
        )
    )
    for level, value in ((0.0, range_[0]), (1.0, range_[1])):
        x, y = at(0, 1, level)
        axes.add(Text(x - 0.02, y, number(value), across="right", up="center", **small))
    x, y = at(0, 1, 1)
    axes.add(Text(x - 0.02, y, third, across="right", up="bottom", shift=(0.0, 1.6), **small))
