"""Requirement bands and violations, drawn into an axis over time."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes

from fcl_sim.judge.verdict import Band, Corridor
from fcl_sim.loop.trace import Values
from fcl_sim.report import style
from fcl_sim.report.words import number, one_line

FAR = 1.5
"""A bound that lies further outside than so many spans of the data is named, not drawn."""

NARROW = 8.0
"""Bounds are narrow when the data span so many times their distance."""

RIGHT = 16.0
"""Width in mm of what names bounds."""

LABEL = 2.7
"""Height of a label in mm, for keeping them apart."""


def worth_showing(limit: float, low: float, high: float) -> bool:
    """Return whether the axis of data from `low` to `high` is stretched to show `limit`."""
    span = (high - low) or abs(limit)
    return low - FAR * span <= limit <= high + FAR * span


def focus_on(bands: Mapping[Band, Sequence[str]], values: Values) -> tuple[float, float] | None:
    """Return the range of a second look at `values` (n,), close to bounds that are narrow beside them."""
    limits = [limit for band in bands for limit in (band.low, band.high) if limit is not None]
    closed = any(band.low is not None and band.high is not None for band in bands)
    finite = values[np.isfinite(values)]
    if not closed or not len(finite):
        return None
    low, high = min(limits), max(limits)
    if not 0.0 < NARROW * (high - low) < float(np.ptp(finite)):
        return None
    return low - 0.6 * (high - low), high + 0.6 * (high - low)


def draw_bands(axes: Axes, bands: Mapping[Band, Sequence[str]], height: float) -> None:
    """Shade what is allowed, draw the bounds, name the requirements at the right; `height` in mm."""
    low, high = axes.get_ylim()
    labels: dict[float, list[str]] = {}
    for band, ids in bands.items():
        bottom = low if band.low is None else max(band.low, low)
        top = high if band.high is None else min(band.high, high)
        if bottom < top:
            axes.fill_between([band.start, band.end], bottom, top, color=style.BAND, linewidth=0, zorder=1)
        limits = [limit for limit in (band.low, band.high) if limit is not None]
        for limit in limits:
            if low <= limit <= high:
                span = [band.start, band.end]
                axes.plot(span, [limit, limit], color=style.BOUND, linewidth=0.7, dashes=(4, 2), zorder=2)
        if limits:
            labels.setdefault(sum(limits) / len(limits), []).extend(ids)
    _name_bounds(axes, labels, height)


def draw_corridors(axes: Axes, corridors: Sequence[Corridor]) -> None:
    """Shade what lies between the edges of corridors, and draw them; an edge that is none is not drawn."""
    bottom, top = axes.get_ylim()
    for corridor in corridors:
        time = np.array(corridor.ticks) / 1e9
        low, high = np.array(corridor.low), np.array(corridor.high)
        under = np.clip(np.where(np.isnan(low), bottom, low), bottom, top)
        over = np.clip(np.where(np.isnan(high), top, high), bottom, top)
        axes.fill_between(time, under, over, color=style.BAND, linewidth=0, zorder=1)
        for edge in (low, high):
            axes.plot(time, edge, color=style.BOUND, linewidth=0.7, dashes=(4, 2), zorder=2)


def _name_bounds(axes: Axes, labels: Mapping[float, Sequence[str]], height: float) -> None:
    """Write the requirements beside their bounds, moved apart where they would meet."""
    low, high = axes.get_ylim()
    wanted = sorted(labels)
    places = [min(max((middle - low) / (high - low), 0.0), 1.0) for middle in wanted]
    for at, middle in zip(apart(places, LABEL / height), wanted, strict=True):
        text = one_line(", ".join(labels[middle]))
        if not low <= middle <= high:
            arrow = "\N{DOWNWARDS ARROW}" if middle < low else "\N{UPWARDS ARROW}"
            text = f"{text} {arrow}{number(middle, 3)}"
        axes.annotate(
            style.cut(text, RIGHT, style.SMALL),
            (1, at),
            (4, 0),
            "axes fraction",
            "offset points",
            va="center",
            color=style.BOUND,
            fontsize=style.SMALL,
            annotation_clip=False,
        )


def apart(places: Sequence[float], least: float) -> list[float]:
    """Return rising places in [0, 1] moved up, then down from 1, until `least` lies between any two."""
    moved: list[float] = []
    for place in places:
        moved.append(max(place, moved[-1] + least) if moved else place)
    ceiling = 1.0
    for index in range(len(moved) - 1, -1, -1):
        moved[index] = min(moved[index], ceiling)
        ceiling = moved[index] - least
    return moved


def draw_violations(
    axes: Axes, violations: Sequence[tuple[float, float]], run: tuple[int, str] | None = None
) -> None:
    """Shade each violated interval; of `run` (index, colour) among several, a bar along the upper edge."""
    for start, end in violations:
        if run is None:
            axes.axvspan(start, end, facecolor=style.VIOLATION, linewidth=0, alpha=0.6, zorder=1.5)
            axes.axvspan(start, end, 0.955, 1.0, facecolor=style.VIOLATION_EDGE, linewidth=0, zorder=4)
            continue
        index, colour = run
        top = 1.0 - 0.05 * index
        axes.axvspan(start, end, top - 0.035, top, facecolor=colour, linewidth=0, zorder=4)
