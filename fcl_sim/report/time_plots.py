"""Signals over time, each against its requirement bands: stacked axes, one time."""

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, replace
from hashlib import blake2b
from typing import Any

import numpy as np

from fcl_sim.judge.verdict import Band, Corridor, Status, Verdict
from fcl_sim.loop.trace import Trace, Values
from fcl_sim.report import lettering, ranges, style
from fcl_sim.report.allowed import of_runs
from fcl_sim.report.bands import (
    FAR,
    MISSED_FAR,
    draw_allowed,
    draw_bounds,
    draw_corridors,
    draw_strip,
    draw_violations,
    focus_on,
    strip_of,
    worth_showing,
)
from fcl_sim.report.canvas import Axes, Dot, Figure, Line, Text, span, upright
from fcl_sim.report.events import Mark, marks_of
from fcl_sim.report.frame import draw_frame, room_below, scale_of, ticks
from fcl_sim.report.legend import draw_legend, legend_height
from fcl_sim.report.naming import FOOT, Name, Placed, arranged, draw_names, height_of
from fcl_sim.report.stretches import stretches
from fcl_sim.report.violations import Interval, all_violations
from fcl_sim.report.words import bracketed, number, one_line, with_unit

LEFT, RIGHT = 14.0, 18.0
ACROSS = style.WIDTH - LEFT - RIGHT
HEADING = 4.2
GAP = 1.9
AFTER = 3.0
LIFT = 0.45
TALL, LOW = 18.0, 11.0
"""Heights in mm of an axis with a requirement and of one without."""

SQUEEZE = 0.72
"""Axes are made lower by this at most to save a page."""

STRETCH = 1.6
"""Axes of several runs are made higher by this at most, where there is room."""

NOTHING = 1e-9
"""A signal that ends so far below its largest value ends at zero."""

BUCKETS = 400
"""A line is thinned to its extremes in so many stretches: each narrower than the line."""


STRIP = 0.6
"""What lies between the names of events and the first axis, in mm."""

STEP = 0.9
"""What changes by this part of a stretch's range from one sample to the next is a step."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Shown:
    """One run of a time plot: label, trace, planned duration in seconds, verdicts with their bands."""

    label: str
    trace: Trace
    duration: float
    verdicts: Sequence[Verdict] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Lane:
    """One axis: a signal, all the names it goes by, its unit.

    `focus` is the range of a second look at a signal, close to its bounds.
    """

    signal: str
    names: tuple[str, ...]
    unit: str
    judged: bool = False
    focus: tuple[float, float] | None = None

    @property
    def height(self) -> float:
        """Height of the axis in mm."""
        return TALL if self.judged else LOW


def lanes(run: Shown) -> list[Lane]:
    """Return the axes of a run alone, as `lanes_of` does."""
    return lanes_of([run])


def lanes_of(runs: Sequence[Shown], older: Sequence[Shown] = ()) -> list[Lane]:
    """Return the axes of runs over one another: judged ones first, equal signals once under all their names.

    Judged is what any of the runs is judged by; equal is what is so in each of them
    and in those that are `older`, which are drawn behind. A judged signal whose bounds
    are narrow beside its range gets a second axis close to them. A clock, which is the
    time itself, gets none.
    """
    judged = {name for run in runs for verdict in run.verdicts for name in verdict.requirement.signals}
    found: dict[tuple[object, ...], list[str]] = {}
    for name in dict.fromkeys(name for run in runs for name in run.trace.names):
        found.setdefault(tuple(_told_by(run.trace, name) for run in (*runs, *older)), []).append(name)
    first: list[Lane] = []
    others: list[Lane] = []
    for names in found.values():
        names.sort(key=lambda name: name not in judged)
        traces = [run.trace for run in runs if names[0] in run.trace]
        if names[0] not in judged and all(_is_clock(each, names[0]) for each in traces):
            continue
        unit = traces[0].units[names[0]]
        lane = Lane(signal=names[0], names=tuple(names), unit=unit, judged=names[0] in judged)
        (first if lane.judged else others).append(lane)
        focus = focus_on(bands_of(lane, runs), np.concatenate([each[lane.signal] for each in traces]))
        if focus is not None:
            first.append(replace(lane, focus=focus))
    return first + others


def _told_by(trace: Trace, name: str) -> tuple[str, bytes] | None:
    """Return what two signals of a run have in common where they are equal; None of one that it lacks."""
    if name not in trace:
        return None
    return trace.units[name], blake2b(trace[name].tobytes(), digest_size=16).digest()


def _is_clock(trace: Trace, name: str) -> bool:
    return trace.units[name] == "s" and np.allclose(trace[name], trace.time, rtol=NOTHING, atol=NOTHING)


def thinned(time: Values, values: Values, buckets: int = BUCKETS) -> tuple[Values, Values]:
    """Return the points (m,) of a line (n,) that the eye sees.

    They are each bucket's first, least and largest, and of a step the point before it, so that it is upright.
    """
    if len(time) <= 3 * buckets:
        return time, values
    width = -(-len(time) // buckets)
    padded = np.full(-(-len(time) // width) * width, np.nan)
    padded[: len(values)] = values
    pieces = np.where(np.isfinite(padded), padded, np.nan).reshape(-1, width)
    starts = np.arange(len(pieces)) * width
    least = np.where(np.isnan(pieces), np.inf, pieces).argmin(axis=1)
    largest = np.where(np.isnan(pieces), -np.inf, pieces).argmax(axis=1)
    extremes = np.concatenate([starts + least, starts + largest])
    flat = pieces.ravel()
    with np.errstate(over="ignore"):  # a run that grew without bounds
        span = flat[starts + largest] - flat[starts + least]
        jump = np.abs(flat[extremes] - flat[extremes - 1])
    before = extremes[(extremes > 0) & (jump >= STEP * np.tile(span, 2))] - 1
    chosen = np.zeros(len(time), dtype=bool)
    for each in (starts, extremes, before, [-1]):
        chosen[each] = True
    return time[chosen], values[chosen]


def pages(shown: Sequence[Lane], runs: Sequence[Shown]) -> list[list[Lane]]:
    """Part lanes into figures of these runs that fit a page each."""
    parted: list[list[Lane]] = [[]]
    least = _head(runs)[0] + room_below("time [s]")
    height = least
    for lane in shown:
        heading, _ = _heading_texts(lane, runs)
        needed = SQUEEZE * lane.height + HEADING * (heading.count("\n") + 1) + GAP
        if parted[-1] and height + needed > style.TALLEST:
            parted.append([])
            height = least
        parted[-1].append(lane)
        height += needed
    return [page for page in parted if page]


def time_plot(runs: Sequence[Shown], shown: Sequence[Lane]) -> Figure:
    """Return stacked axes, one a lane, with the runs in each, the first drawn strongest.

    A lone run has its violations shaded over the height of the axis; those of several
    are marked above the lines, a row for each run that has any.
    """
    headings = [_heading_texts(lane, runs) for lane in shown]
    end = max(run.duration for run in runs)
    top, labels, names = _head(runs)
    above = [HEADING * (text.count("\n") + 1) for text, _ in headings]
    fixed = top + sum(above) + (len(shown) - 1) * GAP + room_below("time [s]")
    whole = sum(lane.height for lane in shown)
    scale = max(SQUEEZE, min(STRETCH if labels else 1.0, (style.TALLEST - fixed) / whole))
    figure = Figure(fixed + scale * whole)
    draw_legend(figure, labels)
    if names:
        draw_names(figure.place(LEFT, top - STRIP, ACROSS, STRIP, "events"), names)
    happened = _happened(runs)
    for lane, texts, heading in zip(shown, headings, above, strict=True):
        top += heading
        axes = figure.place(LEFT, top, ACROSS, scale * lane.height, lane.signal)
        axes.x = (0.0, end)
        _draw_lane(axes, lane, runs)
        for each in happened:
            axes.add(upright(axes, each.time, style.FAINT, width=0.6, dashes=(2, 1.5), z=3.5, label="event"))
        bottom = lane is shown[-1]
        up = scale_of(*axes.y, 4 if lane.judged else 3)
        draw_frame(axes, ticks(0.0, end, 9), up, ("time [s]" if bottom else "", ""), labels=bottom)
        _heading(axes, texts, lane, runs)
        top += axes.height + GAP
    return figure


def _head(runs: Sequence[Shown]) -> tuple[float, list[str], list[Placed]]:
    """Return the height of what stands above the axes in mm: labels of several runs, events of one."""
    labels = [_legend_text(run) for run in runs] if len(runs) > 1 else []
    end = max(run.duration for run in runs)
    names = arranged([Name(each.text, each.time / end, style.FAINT) for each in _happened(runs)], ACROSS)
    return legend_height(labels) + (height_of(names) + FOOT + STRIP if names else 0.0), labels, names


def _happened(runs: Sequence[Shown]) -> list[Mark]:
    return marks_of(runs[0].trace) if len(runs) == 1 else []


def _draw_lane(axes: Axes, lane: Lane, runs: Sequence[Shown]) -> None:
    bands = bands_of(lane, runs)
    present = [(index, run) for index, run in enumerate(runs) if lane.signal in run.trace]
    shown = _within(lane, [run for _, run in present])
    shown += [edge for each in corridors_of(lane, runs) for edge in (np.array(each.low), np.array(each.high))]
    low, high = lane.focus or _limits(shown, bands, missed_bands(runs))
    several = len(runs) > 1 and lane.focus is None
    missed = [(index, found) for index, run in present if several and (found := _violations(lane, run))]
    strip = strip_of(len(missed), axes.height)
    axes.y = low, high + (high - low) * strip / (1.0 - strip)
    draw_allowed(axes, of_runs([list(bands_of(lane, [run])) for run in runs]))
    draw_bounds(axes, bands)
    draw_corridors(axes, corridors_of(lane, runs))
    draw_strip(axes, missed, strip)
    for index, run in reversed(present):
        _draw_run(axes, lane, run, index, alone=len(runs) == 1)


def _within(lane: Lane, runs: Sequence[Shown]) -> list[Values]:
    """Return the values of runs, of one that broke down as far as the others leave something to see."""
    sound = ranges.finite(run.trace[lane.signal] for run in runs if run.trace.fault is None)
    if not len(sound):
        return [run.trace[lane.signal] for run in runs]
    room = ranges.width(sound) or 1.0
    low, high = float(sound.min()) - room, float(sound.max()) + room
    return [sound, *(np.clip(run.trace[lane.signal], low, high) for run in runs if run.trace.fault)]


def _draw_run(axes: Axes, lane: Lane, run: Shown, index: int, *, alone: bool) -> None:
    time, values = thinned(run.trace.time, run.trace[lane.signal])
    colour, dashes = style.stroke(index)
    width = 1.1 if index == 0 else 0.9
    line = ranges.drawable(values)
    axes.add(Line(time, line, colour, width, dashes, z=5 - 0.1 * index, label="run"))
    low, high = axes.y
    if len(time) and low <= values[-1] <= high:
        last = (float(time[-1]), float(values[-1]))
        broke = run.trace.fault is not None
        axes.add(Dot(*last, "cross", colour, 6.0, z=6) if broke else Dot(*last, "circle", colour, 4.2, z=6))
    if alone:
        draw_violations(axes, _violations(lane, run))
    if alone and run.trace.fault is not None:
        _mark_fault(axes, run.trace.fault.tick / 1e9, run.duration)
    if alone:
        _mark_undefined(axes, lane, run.trace)


def _violations(lane: Lane, run: Shown) -> list[Interval]:
    return all_violations(run.trace, run.verdicts, lane.names)


def bands_of(lane: Lane, runs: Sequence[Shown]) -> dict[Band, list[str]]:
    """Return each band once, with the requirements that ask for it."""
    bands: dict[Band, list[str]] = {}
    for verdict in (each for run in runs for each in run.verdicts):
        if verdict.band is not None and verdict.band.signal in lane.names:
            ids = bands.setdefault(verdict.band, [])
            if verdict.requirement.id not in ids:
                ids.append(verdict.requirement.id)
    return bands


def corridors_of(lane: Lane, runs: Sequence[Shown]) -> list[Corridor]:
    """Return each corridor of a lane's signals once."""
    asked = (verdict.requirement.corridor for run in runs for verdict in run.verdicts)
    return list(dict.fromkeys(each for each in asked if each is not None and each.signal in lane.names))


def missed_bands(runs: Sequence[Shown]) -> set[Band]:
    """Return the bands of requirements that any of the runs misses."""
    verdicts = [each for run in runs for each in run.verdicts if each.measured is Status.FAIL]
    return {each.band for each in verdicts if each.band is not None}


def _limits(
    values: Sequence[Values], bands: Mapping[Band, Sequence[str]], missed: Container[Band]
) -> tuple[float, float]:
    """Return from where to where an axis goes: what is drawn, and bounds, those that are missed from afar."""
    shown = ranges.finite(values)
    low, high = (float(shown.min()), float(shown.max())) if len(shown) else (0.0, 1.0)
    limits = [(limit, band in missed) for band in bands for limit in (band.low, band.high)]
    for limit, is_missed in limits:
        if limit is not None and worth_showing(limit, low, high, MISSED_FAR if is_missed else FAR):
            low, high = min(low, limit), max(high, limit)
    return ranges.widened(low, high, 0.08, ranges.NOISE)


def _heading_texts(lane: Lane, runs: Sequence[Shown]) -> tuple[str, str]:
    """Return what stands above an axis and a remark after it; long names take lines and the remark in."""
    name = bracketed(lane.names[0], lane.unit)
    remark = (
        "close to its bounds" if lane.focus else "".join(f"= {one_line(each)} " for each in lane.names[1:])
    )
    end = lettering.text_width(_end_text(lane, runs), style.SMALL)
    if lettering.text_width(f"{name}  {remark}") + end < ACROSS - AFTER:
        return name, remark
    return lettering.wrapped(f"{name}  {remark}", ACROSS - AFTER - end), ""


def _heading(axes: Axes, texts: tuple[str, str], lane: Lane, runs: Sequence[Shown]) -> None:
    text, remark = texts
    axes.add(Text(0.0, 1.0, text, up="bottom", shift=(0.0, LIFT), parts=True))
    quiet: dict[str, Any] = {"size": style.SMALL, "colour": style.FAINT, "up": "bottom", "parts": True}
    if remark:
        axes.add(Text(0.0, 1.0, remark, shift=(lettering.text_width(text) + AFTER, LIFT), **quiet))
    axes.add(Text(1.0, 1.0, _end_text(lane, runs), across="right", shift=(0.0, LIFT), **quiet))


def _end_text(lane: Lane, runs: Sequence[Shown]) -> str:
    if len(runs) > 1 or lane.focus or lane.signal not in runs[0].trace or not len(runs[0].trace.ticks):
        return ""
    values = runs[0].trace[lane.signal]
    last = float(values[-1])
    if abs(last) < NOTHING * float(np.max(np.abs(values), where=np.isfinite(values), initial=0.0)):
        last = 0.0
    return f"ends at {with_unit(last, lane.unit)}"


def _legend_text(run: Shown) -> str:
    fault = run.trace.fault
    return run.label if fault is None else f"{run.label} (FAULT at {number(fault.tick / 1e9)} s)"


def _mark_fault(axes: Axes, at: float, duration: float) -> None:
    """Draw where a run ended early; what is missing is grey."""
    axes.add(span(axes, (at, max(at, duration)), style.UNDEFINED, z=3))
    axes.add(upright(axes, at, style.INK, width=1.4, z=7))
    right = at > 0.7 * duration
    axes.add(
        Text(
            at,
            axes.part(0.86),
            f"FAULT at {number(at)} s",
            style.SMALL,
            across="right" if right else "left",
            up="center",
            shift=(-1.4 if right else 1.4, 0.0),
            bold=True,
            z=8,
        )
    )


def _mark_undefined(axes: Axes, lane: Lane, trace: Trace) -> None:
    """Hatch the foot of an output's axis over the scans in which no rule was active for it."""
    for path, record in trace.fuzzy.items():
        for column, output in enumerate(record.output_names):
            if not {f"{path}.{output}", path} & set(lane.names):
                continue
            last = len(trace.ticks) - 1
            for start, end in stretches(~record.active[:, column]):
                across = (float(trace.time[start]), float(trace.time[min(end, last)]))
                axes.add(span(axes, across, style.UNDEFINED, (0.0, 0.14), hatched=True, z=3))
