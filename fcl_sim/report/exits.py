"""Where a track leaves the picture that it is drawn in, and the arrow heads that say so."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fcl_sim.loop.trace import Values
from fcl_sim.report import style
from fcl_sim.report.canvas import Axes, Shape

LONG, WIDE = 2.6, 1.3
"""Length of an arrow head and half its width, in mm."""
APART = 4.0
"""What lies between two of them in mm, at least."""

Range = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Exit:
    """A place on an edge, and the unit vector that points out of the picture there."""

    x: float
    y: float
    out: tuple[float, float]


def told(x: Values, y: Values, across: Range, up: Range) -> str:
    """Return in a sentence that a way (n,) is outside of a picture from `across` to `up`, if it ever is."""
    finite = np.isfinite(x) & np.isfinite(y)
    x, y = x[finite], y[finite]
    inside = _inside(x, y, across, up)
    if inside.all():
        return ""
    if not inside.any():
        return "The run is outside of the picture all the time."
    if (inside[:-1] & ~inside[1:]).any():
        return "The run leaves the picture where an arrow head stands at its edge."
    return "The run begins outside of the picture."


def exits(x: Values, y: Values, across: Range, up: Range) -> Iterator[Exit]:
    """Yield where a way (n,) of finite points goes out of a picture, in its order."""
    inside = _inside(x, y, across, up)
    for at in np.flatnonzero(inside[:-1] & ~inside[1:]).tolist():
        start, way = (x[at], y[at]), (x[at + 1] - x[at], y[at + 1] - y[at])
        found = []
        for axis, ends in enumerate((across, up)):
            if way[axis]:
                sign = 1.0 if way[axis] > 0.0 else -1.0
                part = (ends[int(way[axis] > 0.0)] - start[axis]) / way[axis]
                found.append((float(part), (sign, 0.0) if axis == 0 else (0.0, sign)))
        part, out = min(found)
        yield Exit(float(start[0] + part * way[0]), float(start[1] + part * way[1]), out)


def _inside(x: Values, y: Values, across: Range, up: Range) -> NDArray[np.bool_]:
    return (x >= across[0]) & (x <= across[1]) & (y >= up[0]) & (y <= up[1])


def draw_exits(axes: Axes, x: Values, y: Values) -> None:
    """Draw an arrow head at the edge wherever a way of finite points goes out, where they do not meet."""
    wide, high = (axes.x[1] - axes.x[0]) / axes.width, (axes.y[1] - axes.y[0]) / axes.height
    taken: list[tuple[float, float]] = []
    for each in exits(x, y, axes.x, axes.y):
        if any(np.hypot((each.x - u) / wide, (each.y - v) / high) < APART for u, v in taken):
            continue
        taken.append((each.x, each.y))
        (dx, dy), foot = each.out, (each.x - LONG * each.out[0] * wide, each.y - LONG * each.out[1] * high)
        axes.add(
            Shape(
                [each.x, foot[0] - WIDE * dy * wide, foot[0] + WIDE * dy * wide],
                [each.y, foot[1] + WIDE * dx * high, foot[1] - WIDE * dx * high],
                style.INK,
                edge=style.PAPER,
                width=0.5,
                z=6.5,
                label="exit",
            )
        )
