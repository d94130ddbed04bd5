"""Requirement bands and violations, drawn into an axis over time."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from fcl_sim.judge.verdict import Band, Corridor
from fcl_sim.loop.trace import Values
from fcl_sim.report import lettering, style
from fcl_sim.report.canvas import Axes, Line, Text, between, rectangle, span
from fcl_sim.report.ranges import NOISE, moves, width
from fcl_sim.report.violations import Interval
from fcl_sim.report.words import number, one_line

FAR, MISSED_FAR = 1.5, 5.0
"""So many spans outside of the data a bound is named and not drawn; one that is missed, only further away."""

NARROW = 8.0
"""Bounds are narrow when the data span so many times their distance."""

RIGHT = 16.0
"""Width in mm of what names bounds."""

LABEL = 2.7
"""Height of a label in mm, for keeping them apart."""

ROW = 1.1
"""Height in mm of what marks the violations of a run among others."""

ABOVE = 2.7
"""Height in mm of a row that marks violations above axes."""

INSTANT = 4.0
"""Width in mm of a band that holds at an instant, at least."""

SHORTEST, DASH = 0.7, 5.0
"""Length in mm of the shortest stroke that is seen; one of fewer times that is solid."""

MOST_STRIP = 0.3
"""The part of an axis that such rows take at most."""


def worth_showing(limit: float, low: float, high: float, far: float = FAR) -> bool:
    """Return whether the axis of data from `low` to `high` is stretched by `far` spans to show `limit`."""
    span = high - low if moves(low, high, NOISE) else abs(limit)
    return low - far * span <= limit <= high + far * span


def focus_on(bands: Iterable[Band], values: Values) -> tuple[float, float] | None:
    """Return the range of a second look at `values` (n,), close to bounds that are narrow beside them."""
    finite = values[np.isfinite(values)]
    far = width(finite)
    closed = [(each.low, each.high) for each in bands if each.low is not None and each.high is not None]
    narrow = [each for each in closed if 0.0 < NARROW * (each[1] - each[0]) < far]
    if not narrow:
        return None
    low, high = min(each[0] for each in narrow), max(each[1] for each in narrow)
    if not NARROW * (high - low) < far:
        return None  # narrow ones here and there
    return low - 0.6 * (high - low), high + 0.6 * (high - low)


DASHED: style.Dashes = (4, 2)
"""Stroke of a bound."""


def draw_allowed(axes: Axes, bands: Sequence[Band]) -> None:
    """Shade what is allowed; what is at an instant is as wide as is seen, and hides nothing before it."""
    low, high = axes.y
    for band in bands:
        across = as_seen(axes, (band.start, band.end), INSTANT)
        bottom = low if band.low is None else max(band.low, low)
        top = high if band.high is None else min(band.high, high)
        if bottom < top:
            axes.add(rectangle(across, (bottom, top), style.BAND, z=1, label="allowed"))


def draw_bounds(axes: Axes, bands: Mapping[Band, Sequence[str]]) -> None:
    """Draw the bounds, name the requirements at the right."""
    low, high = axes.y
    labels: dict[float, list[str]] = {}
    for band, ids in bands.items():
        across = as_seen(axes, (band.start, band.end), INSTANT)
        limits = [limit for limit in (band.low, band.high) if limit is not None]
        for limit in limits:
            if low <= limit <= high:
                axes.add(Line(across, [limit, limit], style.BOUND, 0.7, DASHED))
        if limits:
            labels.setdefault(sum(limits) / len(limits), []).extend(ids)
    _name_bounds(axes, labels)


def as_seen(axes: Axes, interval: Interval, shortest: float) -> Interval:
    """Return from when to when an interval is drawn: one of an instant is made as wide as is seen, in mm.

    It ends at the instant, as behind it a signal may well go elsewhere.
    """
    begin, end = axes.x
    least = min(shortest / axes.width, 1.0) * (end - begin)
    if interval[1] - interval[0] >= least:
        return interval
    start = min(max(interval[1] - least, begin), end - least)
    return start, start + least


def draw_corridors(axes: Axes, corridors: Sequence[Corridor]) -> None:
    """Shade what lies between the edges of corridors, and draw them.

    An edge is there between two rows that both have one, as the judge takes it;
    where there is none on a side all of that side is allowed.
    """
    bottom, top = axes.y
    for corridor in corridors:
        time = np.array(corridor.ticks) / 1e9
        low, high = np.array(corridor.low), np.array(corridor.high)
        for rows in _alike(low, high):
            under, over = low[rows], high[rows]
            has_low, has_high = not np.isnan(under).any(), not np.isnan(over).any()
            under = np.clip(under if has_low else np.full(len(under), bottom), bottom, top)
            over = np.clip(over if has_high else np.full(len(over), top), bottom, top)
            if has_low or has_high:
                axes.add(between(time[rows], under, over, style.BAND, z=1))
        for edge in (low, high):
            axes.add(Line(time, edge, style.BOUND, 0.7, DASHED))


def _alike(low: Values, high: Values) -> list[slice]:
    """Return the stretches of rows in which the same edges of a corridor (n,) are there throughout."""
    there = [~np.isnan(each[:-1]) & ~np.isnan(each[1:]) for each in (low, high)]
    changes = np.flatnonzero(np.diff(2 * there[0] + there[1])) + 1
    return [slice(first, last + 1) for first, last in pairwise([0, *changes.tolist(), len(low) - 1])]


def _name_bounds(axes: Axes, labels: Mapping[float, Sequence[str]]) -> None:
    """Write the requirements beside their bounds, moved apart where they would meet.

    Each has a line of its own where there is room for all.
    """
    low, high = axes.y
    named = {middle: [one_line(each) for each in dict.fromkeys(labels[middle])] for middle in sorted(labels)}
    wanted = list(named.items())
    single = [(middle, [each]) for middle, ids in wanted for each in reversed(ids)]
    if len(single) <= axes.height / LABEL:
        wanted = single
    places = [min(max((middle - low) / (high - low), 0.0), 1.0) for middle, _ in wanted]
    for at, (middle, ids) in zip(apart(places, LABEL / axes.height), wanted, strict=True):
        where = ""
        if not low <= middle <= high:
            arrow = "\N{DOWNWARDS ARROW}" if middle < low else "\N{UPWARDS ARROW}"
            where = f" {arrow}{number(middle, 3)}"
        shown = listed(ids, where)
        axes.add(Text(1.0, at, shown, style.SMALL, style.BOUND, up="center", shift=(1.4, 0.0), parts=True))


def listed(ids: Sequence[str], where: str) -> str:
    """Return names beside a bound, and `where` it lies: whole ones, the first where not all fit."""
    tails = [(count, f", …{where}") for count in range(len(ids) - 1, 0, -1)]
    if tails:
        tails.append((1, f", …{where[:2]}"))  # the arrow alone
    for count, tail in [(len(ids), where), *tails]:
        text = ", ".join(ids[:count]) + tail
        if lettering.text_width(text, style.SMALL) <= RIGHT:
            return text
    return lettering.cut(ids[0], RIGHT - lettering.text_width(tail, style.SMALL), style.SMALL) + tail


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


def draw_violations(axes: Axes, violations: Sequence[Interval]) -> None:
    """Shade each violated interval of a lone run, with a bar along the upper edge."""
    for each in violations:
        across = as_seen(axes, each, SHORTEST)
        axes.add(span(axes, across, style.VIOLATION, opacity=0.7, z=1.5))
        axes.add(span(axes, across, style.VIOLATION_EDGE, (0.955, 1.0), z=4))


@dataclass(frozen=True, slots=True, kw_only=True)
class Missed:
    """When a requirement is violated; `is_meant` says that it is to be missed."""

    label: str
    stretches: tuple[Interval, ...]
    is_meant: bool


def draw_above(axes: Axes, missed: Sequence[Missed]) -> None:
    """Put a bar above the axes over each violated interval, a row of `ABOVE` mm for each requirement.

    Bars of what is to be missed are open.
    """
    for row, each in enumerate(reversed(missed)):
        low, high = (1.0 + (row + part) * ABOVE / axes.height for part in (0.2, 0.75))
        face = style.PAPER if each.is_meant else style.VIOLATION_EDGE
        look: dict[str, Any] = {"edge": style.VIOLATION_EDGE, "z": 4, "free": True, "label": "violation"}
        for stretch in each.stretches:
            axes.add(span(axes, as_seen(axes, stretch, SHORTEST), face, (low, high), **look))
        spot: dict[str, Any] = {"across": "right", "up": "middle", "shift": (-1.5, 0.0), "parts": True}
        label = lettering.cut(each.label, axes.left / style.HINTED - 2.0, style.LEAST)
        axes.add(Text(0.0, (low + high) / 2.0, label, style.LEAST, **spot))


def strip_of(count: int, height: float) -> float:
    """Return the part of an axis, `height` mm high, that the violations of so many runs take at its top."""
    return min((count + 0.5) * ROW / height, MOST_STRIP) if count else 0.0


def draw_strip(axes: Axes, found: Sequence[tuple[int, Sequence[Interval]]], part: float) -> None:
    """Mark the violated intervals of runs, each by its number, in the top `part` of an axis: a row a run."""
    for row, (index, violations) in enumerate(found):
        colour, dashes = style.stroke(index)
        at = axes.part(1.0 - part * (row + 0.75) / (len(found) + 0.5))
        least = SHORTEST / axes.width * (axes.x[1] - axes.x[0])
        for start, end in violations:
            is_short = end - start < DASH * least
            begin = min(start, axes.x[1] - least)
            shown = [begin, max(end, begin + least)]
            axes.add(Line(shown, [at, at], colour, 1.3, () if is_short else dashes, z=4, label="violation"))
