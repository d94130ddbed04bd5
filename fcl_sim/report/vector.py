"""Figure → SVG whose text is text, the same bytes every time."""

from base64 import b64encode
from collections.abc import Iterator, Sequence
from functools import singledispatch
from itertools import groupby
from math import isfinite
from xml.sax.saxutils import escape

import numpy as np
from numpy.typing import NDArray

from fcl_sim.loop.trace import Values
from fcl_sim.report import style
from fcl_sim.report.canvas import Axes, Dot, Figure, Image, Line, Mark, Series, Shape, Text
from fcl_sim.report.lettering import ASCENT, CAPITALS, DESCENT, STEP, known, text_width

UNIT = 100
"""Coordinates are whole hundredths of a millimetre."""
POINT = 25.4 / 72.0
"""Millimetres."""
FAR = 20_000.0
"""What lies further off than so many mm is drawn there; nothing of it is seen."""

LAST_RESORT = "Last Resort High-Efficiency"
"""The font that has a box for every character."""

HATCH = 1.25
"""Distance of the lines of a hatching along the axes, in mm."""

ROUND = 'stroke-linecap="round" stroke-linejoin="round"'
COMMON = f'fill="none" {ROUND} xml:space="preserve"'
ELSEWHERE = ", Verdana, sans-serif"
"""What stands for our font where it is lacking."""

RIM = 0.9
"""Width of the edge of a dot that is filled otherwise, in points."""

ANCHORS = {"left": "start", "center": "middle", "right": "end"}
BEFORE = {"left": 0.0, "center": 0.5, "right": 1.0}


def svg(figure: Figure, *, alone: bool = False) -> bytes:
    """Return a figure as SVG; one that stands `alone` may be shown where our font is not."""
    marks = [each for axes in figure.axes for each in axes.marks]
    hatched = any(isinstance(each, Shape) and each.hatched for each in marks)
    width, height = _length(figure.width), _length(figure.height)
    size = f'width="{figure.width:.2f}mm" height="{figure.height:.2f}mm" viewBox="0 0 {width} {height}"'
    families = style.FONT + (ELSEWHERE if alone else "")
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="{families}" {COMMON}>',
        _hatching() if hatched else "",
        f'<path d="M0 0H{width}V{height}H0Z" fill="{style.PAPER}"/>',
        *(line for index, axes in enumerate(figure.axes) for line in _axes(axes, f"a{index}")),
        "</svg>\n",
    ]
    return "\n".join(each for each in lines if each).encode()


def _axes(axes: Axes, name: str) -> Iterator[str]:
    """Yield the marks of axes from the lowest to the highest; what reaches over the edge is cut there."""
    marks = sorted(axes.marks, key=lambda each: each.z)
    drawn = [(_reaches_over(axes, mark), "\n".join(_drawn(mark, axes))) for mark in marks]
    if any(cut for cut, _ in drawn):
        left, top, width, height = (_length(each) for each in (axes.left, axes.top, axes.width, axes.height))
        yield f'<clipPath id="{name}"><path d="M{left} {top}h{width}v{height}h{-width}Z"/></clipPath>'
    for cut, group in groupby(drawn, key=lambda each: each[0]):
        inside = "\n".join(text for _, text in group if text)
        yield f'<g clip-path="url(#{name})">\n{inside}\n</g>' if cut and inside else inside


def _reaches_over(axes: Axes, mark: Mark) -> bool:
    if mark.free or not isinstance(mark, Line | Shape):
        return False
    for series, (low, high) in ((mark.x, axes.x), (mark.y, axes.y)):
        ends = (0.0, 1.0) if mark.parts else (min(low, high), max(low, high))
        hair = 1e-6 * (ends[1] - ends[0])
        least, most = ends[0] - hair, ends[1] + hair
        if len(series) <= FEW:
            if any(each < least or each > most for each in _numbers(series)):
                return True
            continue
        values = np.asarray(series, dtype=np.float64)
        if ((values < least) | (values > most)).any():
            return True
    return False


@singledispatch
def _drawn(mark: Mark, axes: Axes) -> Iterator[str]:
    """Yield the elements of a mark."""
    raise NotImplementedError(type(mark), axes)


@_drawn.register
def _line(mark: Line, axes: Axes) -> Iterator[str]:
    path = _path(axes, mark)
    if not path:
        return
    flat = ' stroke-linecap="butt"' if mark.flat or mark.dashes else ""
    if mark.halo:
        yield f'<path d="{path}" stroke="{style.PAPER}" stroke-width="{_points(mark.halo)}"/>'
    given = f'stroke="{mark.colour}" stroke-width="{_points(mark.width)}"{flat}'
    if mark.dashes:
        given += ' stroke-dasharray="{}"'.format(
            " ".join(str(_points(each * mark.width)) for each in mark.dashes)
        )
    if mark.opacity < 1.0:
        given += f' stroke-opacity="{mark.opacity:g}"'
    yield f'<path d="{path}" {given}/>'


@_drawn.register
def _shape(mark: Shape, axes: Axes) -> Iterator[str]:
    path = _path(axes, mark, closed=True)
    if not path:
        return
    given = f' fill="{mark.face}"' if mark.face else ""
    if mark.opacity < 1.0:
        given += f' fill-opacity="{mark.opacity:g}"'
    if mark.edge:
        given += f' stroke="{mark.edge}" stroke-width="{_points(mark.width)}" stroke-linejoin="miter"'
    yield f'<path d="{path}"{given}/>'
    if mark.hatched:
        yield f'<path d="{path}" fill="url(#hatch)"/>'


@_drawn.register
def _dot(mark: Dot, axes: Axes) -> Iterator[str]:
    x, y = _place(axes, mark.x, mark.y, parts=mark.parts)
    half = _points(mark.size / 2.0)
    given = f'fill="{mark.face or mark.colour}"'
    if mark.face:
        given += f' stroke="{mark.colour}" stroke-width="{_points(RIM)}"'
    if mark.kind == "circle":
        yield f'<circle cx="{x}" cy="{y}" r="{half}" {given}/>'
        return
    q, r = half // 2, -(half // 2)
    path = {
        "square": f"M{x - half} {y - half}h{2 * half}v{2 * half}h{-2 * half}Z",
        "left": f"M{x - half} {y}l{2 * half} {-half}v{2 * half}Z",
        "right": f"M{x + half} {y}l{-2 * half} {-half}v{2 * half}Z",
        "cross": f"M{x} {y + r}l{q} {r} {q} {q} {r} {q} {q} {q} {r} {q}"
        f" {r} {r} {r} {q} {r} {r} {q} {r} {r} {r}Z",
    }[mark.kind]
    if mark.halo:
        yield f'<path d="{path}" stroke="{style.PAPER}" stroke-width="{_points(mark.halo)}"/>'
    yield f'<path d="{path}" {given}/>'


@_drawn.register
def _image(mark: Image, axes: Axes) -> Iterator[str]:
    left, top = _place(axes, mark.x[0], mark.y[1], parts=mark.parts)
    right, bottom = _place(axes, mark.x[1], mark.y[0], parts=mark.parts)
    yield (
        f'<image x="{left}" y="{top}" width="{right - left}" height="{bottom - top}" '
        'preserveAspectRatio="none" style="image-rendering: pixelated" '
        f'href="data:image/png;base64,{b64encode(mark.png).decode()}"/>'
    )


@_drawn.register
def _text(mark: Text, axes: Axes) -> Iterator[str]:
    lines = mark.text.split("\n")
    x, y = _place(axes, mark.x, mark.y, parts=mark.parts)
    x, y = x + _length(mark.shift[0]), y - _length(mark.shift[1])
    turned = f' transform="rotate(-90 {x} {y})"' if mark.turned else ""
    if mark.backed:
        left, upper, right, lower = (_length(each) for each in extent(mark))
        pad = _length(mark.backed)
        box = f"M{x + left - pad} {y + upper - pad}H{x + right + pad}V{y + lower + pad}H{x + left - pad}Z"
        yield f'<path d="{box}" fill="{style.PAPER}"{turned}/>'
    given = f'font-size="{_points(mark.size)}" fill="{mark.colour}"{turned}'
    given += ' font-weight="bold"' if mark.bold else ""
    for row, line in enumerate(lines):
        if line.strip():
            yield _written(mark, line, (x, y + _length(baseline(mark, row))), given)


def baseline(mark: Text, row: int) -> float:
    """Return how many mm below its place a line of a text stands."""
    size, more = mark.size * POINT, mark.text.count("\n") * STEP
    first = {
        "baseline": 0.0,
        "top": ASCENT,
        "bottom": -DESCENT - more,
        "center": (ASCENT - DESCENT - more) / 2.0,
        "middle": (CAPITALS - more) / 2.0,
    }[mark.up]
    return size * (first + row * STEP)


def extent(mark: Text) -> tuple[float, float, float, float]:
    """Return left, upper, right and lower end of a text in mm from its place, before it is turned."""
    lines = mark.text.split("\n")
    width = max(text_width(line, mark.size, bold=mark.bold) for line in lines)
    left = -BEFORE[mark.across] * width
    size = mark.size * POINT
    return (
        left,
        baseline(mark, 0) - ASCENT * size,
        left + width,
        baseline(mark, len(lines) - 1) + DESCENT * size,
    )


def _written(mark: Text, line: str, at: tuple[int, int], given: str) -> str:
    """Return a line of text; what the font lacks stands in pieces of their own, each with its place.

    The renderer would set all of the text in the font of last resort otherwise.
    """
    x, y = at
    pieces = [("".join(run), is_known) for is_known, run in groupby(line, key=known)]
    if all(is_known for _, is_known in pieces):
        anchor = "" if mark.across == "left" else f' text-anchor="{ANCHORS[mark.across]}"'
        return f'<text x="{x}" y="{y}" {given}{anchor}>{escape(line)}</text>'
    widths = [text_width(piece, mark.size, bold=mark.bold) for piece, _ in pieces]
    place = x - _length(BEFORE[mark.across] * sum(widths))
    spans = []
    for (piece, is_known), width in zip(pieces, widths, strict=True):
        font = style.FONT if is_known else LAST_RESORT
        spans.append(f'<tspan x="{place}" font-family="{font}">{escape(piece)}</tspan>')
        place += _length(width)
    return f'<text x="{x}" y="{y}" {given}>{"".join(spans)}</text>'


FEW = 8
"""Points up to which a polyline is written number by number."""

LONG = 12
"""Points from which on a polyline is written as steps."""


def _path(axes: Axes, mark: Line | Shape, *, closed: bool = False) -> str:
    """Return the outline of a mark, without the points that nothing would be missed of."""
    if len(mark.x) <= FEW:
        few = [*zip(_numbers(mark.x), _numbers(mark.y), strict=True)]
        if all(isfinite(x) and isfinite(y) for x, y in few):
            return _path_of_few(axes, few, parts=mark.parts) + ("Z" if closed and few else "")
    x, y = (np.asarray(each, dtype=np.float64) for each in (mark.x, mark.y))
    points = _on_page(axes, x, y, parts=mark.parts)
    seen: NDArray[np.bool_] = np.asarray(np.isfinite(points).all(axis=1))
    whole = np.round(np.clip(np.where(seen[:, None], points, 0.0), -FAR, FAR) * UNIT).astype(np.int64)
    ends = (
        [0, len(whole)] if seen.all() else np.flatnonzero(np.diff(seen, prepend=False, append=False)).tolist()
    )
    pieces = []
    for start, end in zip(ends[::2], ends[1::2], strict=True):
        piece = whole[start:end] if end - start < 3 else _bent(whole[start:end])
        pieces.append(_written_path(piece) + ("Z" if closed else ""))
    return "".join(pieces) if len(whole) else ""


def _numbers(series: Series) -> list[float]:
    return series.tolist() if isinstance(series, np.ndarray) else [float(each) for each in series]


def _path_of_few(axes: Axes, given: Sequence[tuple[float, float]], *, parts: bool) -> str:
    """Return the outline of a few points, as of many: arrays for them would take ten times as long."""
    points = [_place(axes, x, y, parts=parts) for x, y in given]
    apart = [each for number, each in enumerate(points) if not number or each != points[number - 1]]
    if len(points) < 3:
        kept = points
    elif len(apart) < 3:
        kept = apart if len(apart) > 1 else points[:2]
    else:
        threes = zip(apart[:-2], apart[1:-1], apart[2:], strict=True)
        inner = [here for before, here, after in threes if _bends(before, here, after)]
        kept = [apart[0], *inner, apart[-1]]
    return f"M{' '.join(f'{x} {y}' for x, y in kept)}" if kept else ""


def _bends(before: tuple[int, int], here: tuple[int, int], after: tuple[int, int]) -> bool:
    x, y = here[0] - before[0], here[1] - before[1]
    next_x, next_y = after[0] - here[0], after[1] - here[1]
    return not (x * next_y == y * next_x and x * next_x + y * next_y > 0)


def _written_path(points: NDArray[np.int64]) -> str:
    """Return a polyline (n, 2); a long one as steps from point to point, which take fewer digits."""
    if len(points) < LONG:
        return "M" + " ".join(map(str, points.ravel().tolist()))
    x, y = points[0].tolist()
    return f"M{x} {y}l" + " ".join(map(str, np.diff(points, axis=0).ravel().tolist()))


def _bent(points: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the points (n, 2) of a polyline at which it changes its direction, and its ends."""
    moved = np.concatenate([[True], (np.diff(points, axis=0) != 0).any(axis=1)])
    apart: NDArray[np.int64] = points[moved]
    if len(apart) < 3:
        return apart if len(apart) > 1 else points[:2]
    steps = np.diff(apart, axis=0)
    (x, y), (next_x, next_y) = steps[:-1].T, steps[1:].T
    straight = (x * next_y == y * next_x) & (x * next_x + y * next_y > 0)
    kept: NDArray[np.int64] = apart[np.concatenate([[True], ~straight, [True]])]
    return kept


def _on_page(axes: Axes, x: Values, y: Values, *, parts: bool) -> NDArray[np.float64]:
    """Return places (n,) on the page (n, 2), in mm from its upper left corner."""
    (left, right), (low, high) = _limits(axes, parts=parts)
    made = np.empty((len(x), 2))
    made[:, 0] = axes.left + axes.width * ((x - left) / (right - left))
    made[:, 1] = axes.top + axes.height * (1.0 - (y - low) / (high - low))
    return made


def _place(axes: Axes, x: float, y: float, *, parts: bool) -> tuple[int, int]:
    (left, right), (low, high) = _limits(axes, parts=parts)
    across = axes.left + axes.width * ((x - left) / (right - left))
    down = axes.top + axes.height * (1.0 - (y - low) / (high - low))
    return _length(min(max(across, -FAR), FAR)), _length(min(max(down, -FAR), FAR))


def _limits(axes: Axes, *, parts: bool) -> tuple[tuple[float, float], tuple[float, float]]:
    return ((0.0, 1.0), (0.0, 1.0)) if parts else (axes.x, axes.y)


def _length(millimetres: float) -> int:
    return round(millimetres * UNIT)


def _points(points: float) -> int:
    return round(points * POINT * UNIT)


def _hatching() -> str:
    tile = _length(HATCH)
    return (
        f'<pattern id="hatch" patternUnits="userSpaceOnUse" width="{tile}" height="{tile}">'
        f'<path d="M{-tile} {tile}L{tile} {-tile}M0 {tile}L{tile} 0M0 {2 * tile}L{2 * tile} 0" '
        f'stroke="{style.FAINT}" stroke-width="{_points(0.45)}" stroke-linecap="butt"/></pattern>'
    )
