"""A drawing as data: a figure in millimetres, axes placed on it, marks upon them.

Nothing is drawn here: `vector` writes a figure as SVG. A page of a report has
tens of axes with a dozen marks each, which a general plotting library takes a
quarter of a second to set up, and this a few milliseconds.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from fcl_sim.loop.trace import Values
from fcl_sim.report import style

Series = Values | Sequence[float]
Across = Literal["left", "center", "right"]
Up = Literal["top", "center", "middle", "bottom", "baseline"]
"""How a text stands at its place: `center` is that of its whole line, `middle` that of its capitals."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Mark:
    """Something on axes.

    Places are values on the axes; with `parts`, parts of their width and height
    from the lower left corner. What reaches over the edge is cut unless it is
    `free`. What has a larger `z` lies above. `label` is what tests call it.
    """

    z: float = 2.0
    parts: bool = False
    free: bool = False
    label: str = ""


@dataclass(frozen=True, slots=True)
class Line(Mark):
    """A polyline, interrupted at NaN. `width` and `halo`, the paper around it, are in points.

    `dashes` are multiples of the width: stroke, gap, ....
    """

    x: Series
    y: Series
    colour: str
    width: float = 1.0
    dashes: style.Dashes = ()
    halo: float = 0.0
    opacity: float = 1.0
    flat: bool = False
    """Whether the line ends where its last point is, instead of half its width later."""


@dataclass(frozen=True, slots=True)
class Shape(Mark):
    """Polygons, parted by NaN: filled, hatched, outlined, as far as it is said."""

    x: Series
    y: Series
    face: str = ""
    edge: str = ""
    width: float = 0.5
    opacity: float = 1.0
    hatched: bool = False


@dataclass(frozen=True, slots=True)
class Dot(Mark):
    """A circle, a square, a cross, or an arrow head to the left or right, of `size` points."""

    x: float
    y: float
    kind: Literal["circle", "square", "cross", "left", "right"]
    colour: str
    size: float
    face: str = ""
    """What fills it, where that is not its colour; `none` leaves it open."""
    halo: float = 0.0


@dataclass(frozen=True, slots=True)
class Text(Mark):
    """Lines of text; `shift` moves them by mm to the right and upwards. Never cut at the edge.

    `turned` reads from below. Behind it is paper, `backed` mm around, where that is above 0.
    """

    x: float
    y: float
    text: str
    size: float = style.NORMAL
    colour: str = style.INK
    across: Across = "left"
    up: Up = "baseline"
    shift: tuple[float, float] = (0.0, 0.0)
    turned: bool = False
    bold: bool = False
    backed: float = 0.0


@dataclass(frozen=True, slots=True)
class Image(Mark):
    """A picture, as PNG, between `x` (left, right) and `y` (bottom, top)."""

    x: tuple[float, float]
    y: tuple[float, float]
    png: bytes


@dataclass(slots=True)
class Axes:
    """A rectangle on a figure, in mm from its upper left corner; the limits of its values, and its marks."""

    left: float
    top: float
    width: float
    height: float
    label: str = ""
    x: tuple[float, float] = (0.0, 1.0)
    y: tuple[float, float] = (0.0, 1.0)
    marks: list[Mark] = field(default_factory=list)

    def add(self, *marks: Mark) -> None:
        """Put marks on the axes."""
        self.marks += marks

    def of(self, kind: type[Any], label: str = "") -> list[Any]:
        """Return the marks of a kind in their order, those of a label where one is given."""
        return [each for each in self.marks if isinstance(each, kind) and label in {"", each.label}]

    def part(self, y: float) -> float:
        """Return the value at a part of the height, from below."""
        return self.y[0] + y * (self.y[1] - self.y[0])


class Figure:
    """An empty figure of `width` × `height` mm, and the axes that are placed on it."""

    def __init__(self, height: float, width: float = style.WIDTH) -> None:
        self.width, self.height = width, height
        self.axes: list[Axes] = []

    def place(self, left: float, top: float, width: float, height: float, label: str = "") -> Axes:
        """Add axes, all in mm from the upper left corner."""
        made = Axes(left, top, width, height, label)
        self.axes.append(made)
        return made

    def page(self) -> Axes:
        """Add axes over the whole figure whose values are mm from its upper left corner."""
        made = self.place(0.0, 0.0, self.width, self.height)
        made.x, made.y = (0.0, self.width), (self.height, 0.0)
        return made


def rectangle(x: tuple[float, float], y: tuple[float, float], face: str = "", **given: Any) -> Shape:
    """Return a rectangle from `x[0]` to `x[1]` and `y[0]` to `y[1]`."""
    return Shape([x[0], x[1], x[1], x[0]], [y[0], y[0], y[1], y[1]], face, **given)


def span(
    axes: Axes, x: tuple[float, float], face: str, parts: tuple[float, float] = (0.0, 1.0), **given: Any
) -> Shape:
    """Return a rectangle between two values, over `parts` of the height of axes whose limits are set."""
    return rectangle(x, (axes.part(parts[0]), axes.part(parts[1])), face, **given)


def between(x: Series, low: Series | float, high: Series | float, face: str, **given: Any) -> Shape:
    """Return what lies between two lines over `x` (n,)."""
    across = np.asarray(x, dtype=np.float64)
    lower, upper = (np.broadcast_to(np.asarray(each, dtype=np.float64), across.shape) for each in (low, high))
    outline = np.concatenate([lower, upper[::-1]])
    return Shape(np.concatenate([across, across[::-1]]), outline, face, **given)


def upright(axes: Axes, x: float, colour: str, **given: Any) -> Line:
    """Return a line over the whole height of axes whose limits are set."""
    return Line([x, x], [*axes.y], colour, flat=True, **given)


def joined(pieces: Sequence[Values]) -> tuple[Values, Values]:
    """Return polylines (n, 2) as the abscissae and ordinates of one, interrupted between them."""
    gap = np.full((1, 2), np.nan)
    rows = [row for piece in pieces for row in (piece, gap)][:-1]
    points = np.concatenate(rows) if rows else np.zeros((0, 2))
    return points[:, 0], points[:, 1]
