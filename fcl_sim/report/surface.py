"""The characteristic of a block, as a heat map or a curve, with a run drawn over it."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from fcl_sim.loop.trace import Values
from fcl_sim.report import style
from fcl_sim.report.frame import draw_frame, draw_scale, room_below, room_left, ticks
from fcl_sim.report.sampling import Curve, Surface, Track
from fcl_sim.report.stretches import stretches
from fcl_sim.report.words import bracketed

TOP, HEIGHT = 5.0, 58.0
BAR, BESIDE = 3.0, 3.0
EDGE = 4.0
"""Room to the right of a map in mm, for half a label."""

HALO = [withStroke(linewidth=2.6, foreground=style.PAPER)]


def surface_plot(surfaces: Sequence[Surface], track: Track | None = None) -> Figure:
    """Return one or two heat maps of an output over two inputs, side by side on one scale.

    Where no rule is active the map is hatched; `track` is drawn over it from an
    open circle to a filled square.
    """
    with style.styled():
        first, (least, most) = surfaces[0], _range(surfaces)
        up = style.wrapped(bracketed(first.up.name, first.up.unit), HEIGHT)
        beside = style.wrapped(bracketed(first.name, first.unit), HEIGHT)
        marks = [ticks(each.y[0], each.y[-1], 6) for each in surfaces]
        levels, scale = ticks(least, most, 9), Normalize(least, most)
        left = max(room_left(each, up) for each in marks)
        bar = BESIDE + BAR + room_left(levels, beside)
        width = (style.WIDTH - bar) / len(surfaces) - left - EDGE
        across = style.wrapped(bracketed(first.across.name, first.across.unit), width)
        figure = style.blank(TOP + HEIGHT + room_below(across))
        for index, surface in enumerate(surfaces):
            axes = style.place(figure, left + index * (left + width + EDGE), TOP, width, HEIGHT)
            _draw_map(axes, surface, scale, [each.at for each in levels])
            _draw_undefined(axes, surface)
            if track is not None:
                _draw_track(axes, track)
            below = ticks(surface.x[0], surface.x[-1], int(width / 9.0))
            draw_frame(axes, below, marks[index], (across, up), grid=False)
            quiet: dict[str, Any] = {"fontsize": style.SMALL, "color": style.FAINT}
            axes.text(0.0, 1.0 + 1.2 / HEIGHT, surface.title, transform=axes.transAxes, **quiet)
        axes = style.place(figure, style.WIDTH - bar + BESIDE, TOP, BAR, HEIGHT)
        edges = np.linspace(least, most, 257)
        middles = (edges[:-1] + edges[1:]) / 2.0
        axes.pcolormesh([0, 1], edges, middles[:, None], cmap=style.heat(), norm=scale, rasterized=True)
        draw_scale(axes, levels, beside)
    return figure


def curve_plot(curve: Curve, track: Track | None = None) -> Figure:
    """Return the output over the one input, hatched where no rule is active, with the visited stretch."""
    with style.styled():
        values = np.where(curve.undefined, np.nan, curve.values)
        low, high = _limits(values, track)
        name = style.wrapped(bracketed(curve.name, curve.unit), HEIGHT)
        marks = ticks(low, high, 7)
        margin = room_left(marks, name)
        width = style.WIDTH - margin - EDGE
        across = style.wrapped(bracketed(curve.across.name, curve.across.unit), width)
        figure = style.blank(TOP + HEIGHT + room_below(across))
        axes = style.place(figure, margin, TOP, width, HEIGHT)
        axes.set(xlim=(curve.x[0], curve.x[-1]), ylim=(low, high))
        axes.plot(curve.x, values, color=style.COLOURS[0], linewidth=1.3, zorder=4)
        for start, end in stretches(curve.undefined):
            left, right = curve.x[[max(start - 1, 0), min(end, len(curve.x) - 1)]]
            style.hatch_span(axes, float(left), float(right))
        if track is not None:
            _draw_track(axes, track)
        draw_frame(axes, ticks(curve.x[0], curve.x[-1], 14), marks, (across, name))
    return figure


def _limits(values: Values, track: Track | None) -> tuple[float, float]:
    """Return the range of what is drawn, with some room."""
    shown = values if track is None else np.concatenate([values, track.y])
    finite = shown[np.isfinite(shown)]
    low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 1.0)
    margin = 0.06 * (high - low) or 0.1 * abs(high) or 1.0
    return low - margin, high + margin


def _range(surfaces: Sequence[Surface]) -> tuple[float, float]:
    defined = np.concatenate([each.values[~each.undefined & np.isfinite(each.values)] for each in surfaces])
    low, high = (float(defined.min()), float(defined.max())) if len(defined) else (0.0, 1.0)
    return low, high if high > low else low + 1.0


def _draw_map(axes: Axes, surface: Surface, scale: Normalize, levels: Sequence[float]) -> None:
    shown = np.ma.masked_where(surface.undefined | ~np.isfinite(surface.values), surface.values)
    axes.pcolormesh(surface.x, surface.y, shown, cmap=style.heat(), norm=scale, rasterized=True, zorder=1)
    middles = [(edges[:-1] + edges[1:]) / 2.0 for edges in (surface.x, surface.y)]
    if levels and shown.count() and float(np.ptp(shown.compressed())) > 0.0:
        axes.contour(
            *middles,
            shown,
            levels=levels,
            colors=style.INK,
            linewidths=0.35,
            linestyles="solid",
            alpha=0.55,
            zorder=2,
        )
    axes.set_xlim(surface.x[0], surface.x[-1])
    axes.set_ylim(surface.y[0], surface.y[-1])


def _draw_undefined(axes: Axes, surface: Surface) -> None:
    """Hatch the cells in which no rule is active, and outline them."""
    if not surface.undefined.any():
        return
    vertices: list[tuple[float, float]] = []
    for bottom, top, row in _bands(surface.undefined):
        for start, end in row:
            left, right = float(surface.x[start]), float(surface.x[end])
            low, high = float(surface.y[bottom]), float(surface.y[top])
            vertices += [(left, low), (right, low), (right, high), (left, high), (left, low)]
    codes = [Path.MOVETO, *[Path.LINETO] * 3, Path.CLOSEPOLY] * (len(vertices) // 5)
    axes.add_patch(
        PathPatch(
            Path(vertices, codes),
            facecolor=style.UNDEFINED,
            edgecolor=style.FAINT,
            hatch="//////",
            linewidth=0,
            zorder=3,
        )
    )
    axes.add_collection(LineCollection(_outline(surface), colors=style.FAINT, linewidths=0.6, zorder=3.1))


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
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    x, y, active = thinned_path(track, (right - left, high - low))
    if not len(x):
        return
    line: dict[str, Any] = {"linewidth": 1.0, "path_effects": HALO, "solid_joinstyle": "round"}
    axes.plot(x, y, color=style.INK, zorder=5, **line)
    for start, end in stretches(~active):
        lost = slice(max(start - 1, 0), end + 1)
        axes.plot(x[lost], y[lost], color=style.VIOLATION_EDGE, zorder=5.1, **line)
    mark: dict[str, Any] = {"color": style.INK, "linestyle": "none", "clip_on": False, "zorder": 6}
    if left <= x[0] <= right and low <= y[0] <= high:
        axes.plot(x[:1], y[:1], "o", markersize=6.2, markerfacecolor=style.PAPER, markeredgewidth=0.9, **mark)
    if left <= x[-1] <= right and low <= y[-1] <= high:
        axes.plot(x[-1:], y[-1:], "s", markersize=3.4, path_effects=HALO, **mark)
    axes.set_xlim(left, right)
    axes.set_ylim(low, high)


def thinned_path(
    track: Track, spans: tuple[float, float], cells: int = 1500
) -> tuple[Values, Values, NDArray[np.bool_]]:
    """Return the points of a track that are finite and leave their `cells`-th of the spans, and its last."""
    finite = np.isfinite(track.x) & np.isfinite(track.y)
    x, y, active = track.x[finite], track.y[finite], track.active[finite]
    if len(x) < 2:
        return x, y, active
    places = np.stack([np.round(x / spans[0] * cells), np.round(y / spans[1] * cells), active])
    keep = np.concatenate(([True], (np.diff(places, axis=1) != 0).any(axis=0)))
    keep[-1] = True
    return x[keep], y[keep], active[keep]
