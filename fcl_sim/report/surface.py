"""The characteristic of a block, as a heat map or a curve, with a run drawn over it."""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from fcl_sim.loop.trace import Values
from fcl_sim.report import lettering, ranges, raster, style
from fcl_sim.report.canvas import Axes, Dot, Figure, Image, Line, Shape, Text, joined, span
from fcl_sim.report.exits import draw_exits
from fcl_sim.report.frame import draw_frame, draw_scale, room_below, room_left, ticks
from fcl_sim.report.relief import Relief, draw_relief
from fcl_sim.report.sampling import Curve, Surface, Track
from fcl_sim.report.stretches import stretches
from fcl_sim.report.track_times import draw_times
from fcl_sim.report.words import bracketed

TOP, HEIGHT = 5.0, 58.0
BAR, BESIDE = 3.0, 3.0
EDGE = 4.0
"""Room to the right of a map in mm, for half a label."""

PIXELS = 4.0
"""Of a map, to the millimetre."""

HALO = 2.6

TILES = 19
"""Corners of tiles of a surface in space, each way."""

CELLS = 700
"""Parts of the width and height of a map by which points of a track are told apart: a tenth of a mm."""


def surface_plot(
    surfaces: Sequence[Surface], track: Track | None = None, *, in_space: bool = False
) -> Figure:
    """Return one or two heat maps of an output over two inputs, side by side on one scale.

    Where no rule is active the map is hatched; `track` is drawn over it from an
    open circle to a filled square, the darker the later, an arrow head where it leaves
    the map. With `in_space` the first surface stands beside them, seen from above and
    the side, and has holes there.
    """
    panels = len(surfaces) + in_space
    first, (least, most) = surfaces[0], _range(surfaces)
    up = lettering.wrapped(bracketed(first.up.name, first.up.unit), HEIGHT)
    beside = lettering.wrapped(bracketed(first.name, first.unit), HEIGHT)
    marks = [ticks(each.y[0], each.y[-1], 6) for each in surfaces]
    levels = ticks(least, most, 9)
    left = max(room_left(each, up) for each in marks)
    bar = BESIDE + BAR + room_left(levels, beside)
    width = (style.WIDTH - bar) / panels - left - EDGE
    across = lettering.wrapped(bracketed(first.across.name, first.across.unit), width)
    figure = Figure(TOP + HEIGHT + room_below(across))
    for index, surface in enumerate(surfaces):
        axes = figure.place(left + index * (left + width + EDGE), TOP, width, HEIGHT, "map")
        _draw_map(axes, surface, (least, most), [each.at for each in levels])
        _draw_undefined(axes, surface)
        if track is not None:
            _draw_track(axes, track)
        below = ticks(surface.x[0], surface.x[-1], max(int(width / 9.0), 1))
        draw_frame(axes, below, marks[index], (across, up), grid=False)
        axes.add(Text(0.0, 1.0, surface.title, style.SMALL, style.FAINT, shift=(0.0, 1.2), parts=True))
    if in_space:
        start = len(surfaces) * (left + width + EDGE) + EDGE
        axes = figure.place(start, TOP, style.WIDTH - bar - start - EDGE, figure.height - TOP, "space")
        draw_relief(axes, _relief(first), (least, most))
    axes = figure.place(style.WIDTH - bar + BESIDE, TOP, BAR, HEIGHT, "scale")
    axes.y = (least, most)
    axes.add(Image((0.0, 1.0), (least, most), raster.scale((1, raster.SHADES)), z=1))
    draw_scale(axes, levels, beside)
    return figure


def _relief(surface: Surface) -> Relief:
    """Return a surface in tiles, as many as can be told apart, without those where no rule is active."""
    x, y = ((edges[:-1] + edges[1:]) / 2.0 for edges in (surface.x, surface.y))
    columns, rows = (np.unique(np.linspace(0, len(each) - 1, TILES).round().astype(int)) for each in (x, y))
    shown = np.where(surface.undefined, np.nan, surface.values)
    across, up = (bracketed(each.name, each.unit) for each in (surface.across, surface.up))
    names = (across, up, bracketed(surface.name, surface.unit))
    for ends, edges in ((x, surface.x), (y, surface.y)):  # a cell at the rim reaches there
        ends[0], ends[-1] = edges[0], edges[-1]
    return Relief(x=x[columns], y=y[rows], values=shown[np.ix_(rows, columns)], names=names)


def curve_plot(curve: Curve, track: Track | None = None) -> Figure:
    """Return the output over the one input, hatched where no rule is active, with the visited stretch."""
    values = np.where(curve.undefined, np.nan, curve.values)
    low, high = _limits(values, track)
    name = lettering.wrapped(bracketed(curve.name, curve.unit), HEIGHT)
    marks = ticks(low, high, 7)
    margin = room_left(marks, name)
    width = style.WIDTH - margin - EDGE
    across = lettering.wrapped(bracketed(curve.across.name, curve.across.unit), width)
    figure = Figure(TOP + HEIGHT + room_below(across))
    axes = figure.place(margin, TOP, width, HEIGHT, "curve")
    axes.x, axes.y = (float(curve.x[0]), float(curve.x[-1])), (low, high)
    axes.add(Line(curve.x, values, style.COLOURS[0], 1.3, z=4, label="curve"))
    for start, end in stretches(curve.undefined):
        left, right = curve.x[[max(start - 1, 0), min(end, len(curve.x) - 1)]]
        axes.add(span(axes, (float(left), float(right)), style.UNDEFINED, hatched=True, z=3))
    if track is not None:
        _draw_track(axes, track)
    draw_frame(axes, ticks(curve.x[0], curve.x[-1], 14), marks, (across, name))
    return figure


def _limits(values: Values, track: Track | None) -> tuple[float, float]:
    """Return the range of what is drawn, with some room."""
    shown = ranges.finite([values] if track is None else [values, track.y])
    low, high = (float(shown.min()), float(shown.max())) if len(shown) else (0.0, 1.0)
    return ranges.widened(low, high, 0.06)


def _range(surfaces: Sequence[Surface]) -> tuple[float, float]:
    defined = ranges.finite(each.values[~each.undefined] for each in surfaces)
    low, high = (float(defined.min()), float(defined.max())) if len(defined) else (0.0, 1.0)
    if not ranges.moves(low, high):
        return low, low + max(1.0, abs(low))
    around_zero = raster.FLAT * (high - low)
    low, high = (0.0 if abs(end) <= around_zero else end for end in (low, high))
    return low, high


def _draw_map(axes: Axes, surface: Surface, scale: tuple[float, float], levels: Sequence[float]) -> None:
    axes.x, axes.y = ((float(each[0]), float(each[-1])) for each in (surface.x, surface.y))
    shown = np.where(surface.undefined, np.nan, surface.values)
    size = (round(axes.width * PIXELS), round(axes.height * PIXELS))
    axes.add(Image(axes.x, axes.y, raster.cells(surface.x, surface.y, shown, scale, size), z=1))
    x, y = ((edges[:-1] + edges[1:]) / 2.0 for edges in (surface.x, surface.y))
    lines = raster.contours(x, y, shown, levels)
    axes.add(Line(*joined(lines), style.INK, 0.35, opacity=0.55, label="contours"))


def _draw_undefined(axes: Axes, surface: Surface) -> None:
    """Hatch the cells in which no rule is active, and outline them."""
    if not surface.undefined.any():
        return
    boxes: list[Values] = []
    for bottom, top, row in _bands(surface.undefined):
        low, high = surface.y[bottom], surface.y[top]
        for start, end in row:
            left, right = surface.x[start], surface.x[end]
            boxes.append(np.array([(left, low), (right, low), (right, high), (left, high)]))
    axes.add(Shape(*joined(boxes), style.UNDEFINED, hatched=True, z=3))
    outline = joined([np.array(each) for each in _outline(surface)])
    axes.add(Line(*outline, style.FAINT, 0.6, z=3.1))


Stretches = tuple[tuple[int, int], ...]


def _bands(flags: NDArray[np.bool_]) -> list[tuple[int, int, Stretches]]:
    """Return flags (m, n) as rectangles: first row, row after the last, stretches of columns."""
    bands: list[tuple[int, int, Stretches]] = []
    for index, row in enumerate(flags):
        columns = tuple(stretches(row))
        if bands and bands[-1][2] == columns:
            bands[-1] = (bands[-1][0], index + 1, columns)
        else:
            bands.append((index, index + 1, columns))
    return bands


def _outline(surface: Surface) -> list[list[tuple[float, float]]]:
    """Return the segments between a cell with a rule and one without, joined where they are straight."""
    segments: list[list[tuple[float, float]]] = []
    flags = surface.undefined
    for places, across, turned in ((surface.y, surface.x, False), (surface.x, surface.y, True)):
        grid = flags.T if turned else flags
        changes = grid[1:] != grid[:-1]
        for index, row in enumerate(changes):
            at = float(places[index + 1])
            for start, end in stretches(row):
                ends = [(float(across[start]), at), (float(across[end]), at)]
                segments.append([(y, x) for x, y in ends] if turned else ends)
    return segments


def _draw_track(axes: Axes, track: Track) -> None:
    (left, right), (low, high) = axes.x, axes.y
    kept = kept_points(track, (right - left, high - low))
    x, y, active = track.x[kept], track.y[kept], track.active[kept]
    if not len(x):
        return
    for start, end, colour in _ages(track, kept):
        axes.add(Line(x[start:end], y[start:end], colour, 1.0, halo=HALO, z=5, label="track"))
    for start, end in stretches(~active):
        lost = slice(max(start - 1, 0), end + 1)
        axes.add(Line(x[lost], y[lost], style.VIOLATION_EDGE, 1.0, halo=HALO, z=5.1, label="track"))
    draw_times(axes, track)
    draw_exits(axes, x, y)
    first, last = (float(x[0]), float(y[0])), (float(x[-1]), float(y[-1]))
    if left <= first[0] <= right and low <= first[1] <= high:
        axes.add(Dot(*first, "circle", style.INK, 6.2, style.PAPER, z=6))
    if left <= last[0] <= right and low <= last[1] <= high:
        colour, face = (style.INK, "") if active[-1] else (style.VIOLATION_EDGE, style.PAPER)
        axes.add(Dot(*last, "square", colour, 4.4, face, halo=HALO, z=6))


def _ages(track: Track, kept: NDArray[np.intp]) -> Iterator[tuple[int, int, str]]:
    """Yield stretches of the points that are kept, each with its colour: the darker the later."""
    if len(track.time) != len(track.x):
        yield 0, len(kept), style.INK
        return
    cuts = np.linspace(0, len(kept), len(style.AGES) + 1).round().astype(int)[1:-1]
    for start, end, colour in zip([0, *cuts], [*cuts, len(kept)], style.AGES, strict=True):
        if end > start:
            yield int(start), int(end) + 1, colour  # up to the next one's first point


def kept_points(track: Track, spans: tuple[float, float], cells: int = CELLS) -> NDArray[np.intp]:
    """Return which points of a track are finite and leave their `cells`-th of the spans, and its last."""
    finite = np.flatnonzero(np.isfinite(track.x) & np.isfinite(track.y))
    if len(finite) < 2:
        return finite
    x, y, active = track.x[finite], track.y[finite], track.active[finite]
    places = np.stack([np.round(x / spans[0] * cells), np.round(y / spans[1] * cells), active])
    keep = np.concatenate(([True], (np.diff(places, axis=1) != 0).any(axis=0)))
    keep[-1] = True
    return finite[keep]
