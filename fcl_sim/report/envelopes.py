"""An envelope in the report: its axes in words, its verdicts as rows, the figures of all points drawn."""

from collections.abc import Sequence
from functools import partial
from math import isfinite
from typing import Any

import numpy as np

from fcl_sim.envelope.envelope import Envelope
from fcl_sim.envelope.grid import written
from fcl_sim.judge.envelope import EnvelopeVerdict
from fcl_sim.judge.metrics import METRICS
from fcl_sim.judge.verdict import Over, Status
from fcl_sim.judge.wording import relation
from fcl_sim.report import alt, lettering, style, summary
from fcl_sim.report.canvas import Axes, Dot, Figure, Text, span, upright
from fcl_sim.report.frame import draw_frame, room_below, ticks
from fcl_sim.report.pictures import Picture, numbered
from fcl_sim.report.time_plots import Shown, lanes_of, pages, time_plot
from fcl_sim.report.words import bound, bracketed, counted, figure, joined, metric_name, one_line, together
from fcl_sim.testbench import Run

LEFT, RIGHT = 4.0, 4.0
ACROSS = style.WIDTH - LEFT - RIGHT
LANE, HEADING = 9.0, 5.6
MARGIN = 0.06
"""Share of the range that is kept free at both ends."""
ON_A_PAGE = int((style.TALLEST - 1.0) / (HEADING + LANE + room_below()))
"""Requirements to a figure."""
MOST_RUNS = 4
"""Worst runs that are drawn over time."""
MOST_VALUES = 9
"""Values of an axis that are listed."""


def envelope_text(run: Run, envelope: Envelope) -> str:
    """Return what the points of an envelope are."""
    axes = []
    for label, axis in zip(envelope.grid.labels, envelope.grid.axes, strict=True):
        values = [together(written(each.plain())) for each in axis.values]
        told = (
            joined(values) if len(values) <= MOST_VALUES else f"{values[0]} to {values[-1]} in {len(values)}"
        )
        axes.append(one_line(f"{label} = {told}"))
    every = "every combination of " if len(axes) > 1 else ""
    return f"Run {one_line(run.variant)} at {counted(len(envelope), 'point')}, {every}{'; '.join(axes)}."


def envelope_rows(envelope: Envelope) -> list[dict[str, Any]]:
    """Return each requirement with its verdict over the points, as the template lays it out."""
    return [
        {
            "id": one_line(each.requirement.id),
            "asked": one_line(f"{_about(each)}: {summary.envelope_bound(each)}"),
            "reason": _reason(each),
            "passed": summary.passed(each),
            "worst": "" if each.worst is None else one_line(_worst(envelope, each)),
            "status": summary.shown(each),
        }
        for each in envelope.verdicts
    ]


def _reason(verdict: EnvelopeVerdict) -> str:
    """Return the words of a requirement that need not hold everywhere, or is to be missed: they say why."""
    asked = verdict.requirement
    lowered = asked.over is not Over.MEAN and verdict.needed < verdict.points
    return together(one_line(asked.text)) if lowered or asked.expect_fail else ""


def _about(verdict: EnvelopeVerdict) -> str:
    asked = verdict.requirement
    if asked.formula is not None:
        return asked.formula.statement.words or asked.formula.statement.formula
    return f"{_named(verdict)} of {joined(list(asked.signals))}"


def _named(verdict: EnvelopeVerdict) -> str:
    """Return what is measured, and where that is beside another run, how."""
    asked = verdict.requirement
    name = metric_name(asked.metric) or "corridor"
    return name if asked.relative_to is None else f"{name} ({relation(asked.relative_to).replace('`', '')})"


def _worst(envelope: Envelope, verdict: EnvelopeVerdict) -> str:
    place = "" if verdict.worst is None else together(envelope.grid.told(verdict.worst))
    return f"{_decisive(verdict)}: {summary.at_worst(verdict)} at {place}"


def _decisive(verdict: EnvelopeVerdict) -> str:
    """Return what the point that is told is: where all are to miss a bound, the one that nearly keeps it."""
    if verdict.requirement.over is Over.MEAN:
        return "Furthest"
    if not verdict.requirement.expect_fail:
        return "Worst"
    is_met = verdict.worst is not None and verdict.statuses[verdict.worst] is Status.FAIL
    return "Met most clearly" if is_met else "Nearest to its bound"


def _ringed(shown: Sequence[EnvelopeVerdict]) -> str:
    """Return what a ring is, where there is any."""
    meant = {each.requirement.expect_fail for each in shown if _ring(each) is not None}
    nearest = "that nearest to its bound, or furthest within"
    if not meant:
        return ""
    if meant == {True}:
        return f", the ring of what is to be missed {nearest}"
    return ", the ring the worst point" + (
        f" or, of what is to be missed, {nearest}" if len(meant) > 1 else ""
    )


def _ring(verdict: EnvelopeVerdict) -> tuple[float, int] | None:
    """Return where the worst point stands; None where it has no figure."""
    if verdict.worst is None or not np.isfinite(verdict.values[verdict.worst]):
        return None
    return float(verdict.values[verdict.worst]), verdict.worst


def _marks(shown: Sequence[EnvelopeVerdict]) -> str:
    """Return what further marks of a figure are."""
    off = any(_is_off(each, point) for each in shown for point in range(each.points))
    means = any(each.requirement.over is Over.MEAN and each.value is not None for each in shown)
    cross, line = ", a cross a point that is not as required", ", an upright line the mean"
    return (cross if off else "") + (line if means else "")


def _is_off(verdict: EnvelopeVerdict, point: int) -> bool:
    """Return whether a point has a figure and is not as required."""
    return verdict.statuses[point] is not Status.PASS and bool(np.isfinite(verdict.values[point]))


def envelope_pictures(run: Run, envelope: Envelope) -> list[Picture]:
    """Return the figures of all points, and the worst points over time beside the nominal run."""
    shown = [each for each in envelope.verdicts if np.isfinite(each.values).any()]
    found = []
    parts = parted(shown)
    for index, part in enumerate(parts):
        caption = (
            f"Run {one_line(run.variant)}: what each requirement measures at every point of its envelope, "
            "the points one above the other in their order. "
            f"The band is what the requirement allows{_ringed(part)}{_marks(part)}."
        )
        found.append(
            Picture(
                name=numbered(f"{run.variant}-envelope", index, len(parts)),
                caption=caption,
                alt=" ".join(_alt(envelope, each) for each in part),
                draw=partial(_draw, part),
            )
        )
    return found + _over_time(run, envelope)


def parted(shown: Sequence[EnvelopeVerdict]) -> list[Sequence[EnvelopeVerdict]]:
    """Part verdicts into figures that fit a page each."""
    return [shown[start : start + ON_A_PAGE] for start in range(0, len(shown), ON_A_PAGE)]


def _over_time(run: Run, envelope: Envelope) -> list[Picture]:
    order = sorted(envelope.verdicts, key=lambda each: list(Status).index(each.status))
    failing = [each.worst for each in order if each.status is not Status.PASS and each.worst is not None]
    chosen = list(dict.fromkeys(failing))[:MOST_RUNS]
    runs = [_shown("nominal", run)]
    runs += [_shown(envelope.worst_runs[index].label, envelope.worst_runs[index]) for index in chosen]
    judged = [lane for lane in lanes_of(runs) if lane.judged] if chosen else []
    return [
        Picture(
            name=f"{run.variant}-envelope-worst-{number + 1}",
            caption=f"Run {one_line(run.variant)}: the worst points of the requirements that are missed, "
            "beside the nominal run.",
            alt=alt.of_runs(runs, page),
            draw=partial(time_plot, runs, page),
        )
        for number, page in enumerate(pages(judged, runs) if judged else [])
    ]


def _shown(label: str, run: Any) -> Shown:
    duration = run.diagram.timing.duration / 1e9
    return Shown(label=label, trace=run.trace, duration=duration, verdicts=run.verdicts)


def _alt(envelope: Envelope, verdict: EnvelopeVerdict) -> str:
    finite = verdict.values[np.isfinite(verdict.values)]
    ends = [figure(verdict.requirement, float(each)) for each in (finite.min(), finite.max())]
    where = "" if verdict.worst is None else f" {_worst(envelope, verdict)}."
    return one_line(
        f"{verdict.requirement.id}: {len(finite)} figures of {verdict.points} points, "
        f"from {ends[0]} to {ends[1]}; "
        f"{summary.envelope_bound(verdict)}; {summary.passed(verdict)}, {verdict.status}.{where}"
    )


def _draw(shown: Sequence[EnvelopeVerdict]) -> Figure:
    step = HEADING + LANE + room_below()
    picture = Figure(step * len(shown) + 1.0)
    for index, verdict in enumerate(shown):
        axes = picture.place(LEFT, index * step + HEADING, ACROSS, LANE, verdict.requirement.id)
        low, high = axes.x = _limits(verdict)
        axes.y = (-1.0, float(verdict.points))
        _draw_points(axes, verdict)
        draw_frame(axes, ticks(low, high, 9), [])
        _heading(axes, verdict)
    return picture


def _allowed(verdict: EnvelopeVerdict) -> tuple[float | None, float | None]:
    asked = verdict.requirement
    plain = asked.formula is None and asked.corridor is None
    return (asked.minimum, asked.maximum) if plain else (0.0, None)


def _limits(verdict: EnvelopeVerdict) -> tuple[float, float]:
    finite = verdict.values[np.isfinite(verdict.values)]
    places = [
        float(finite.min()),
        float(finite.max()),
        *(each for each in _allowed(verdict) if each is not None),
    ]
    low, high = min(places), max(places)
    room = MARGIN * (high - low) or max(abs(low), 1.0) * MARGIN
    return low - room, high + room


def _draw_points(axes: Axes, verdict: EnvelopeVerdict) -> None:
    low, high = _allowed(verdict)
    band = (axes.x[0] if low is None else low, axes.x[1] if high is None else high)
    axes.add(span(axes, band, style.BAND, z=1))
    axes.add(
        *(
            upright(axes, edge, style.BOUND, width=0.8, dashes=(4, 2))
            for edge in (low, high)
            if edge is not None
        )
    )
    for place, (value, status) in enumerate(zip(verdict.values.tolist(), verdict.statuses, strict=True)):
        if isfinite(value):
            off = status is not Status.PASS
            colour = style.VIOLATION_EDGE if off else style.COLOURS[0]
            axes.add(Dot(value, place, "cross" if off else "circle", colour, 3.2 if off else 2.2, z=4))
    ring = _ring(verdict)
    if ring is not None:
        axes.add(Dot(*ring, "circle", style.INK, 5.0, "none", z=5))
    if verdict.requirement.over is Over.MEAN and verdict.value is not None:
        axes.add(upright(axes, verdict.value, style.INK, z=3))


def _tail(count: int, words: str) -> str:
    return f"; {count} {words}" if count else ""


def _heading(axes: Axes, verdict: EnvelopeVerdict) -> None:
    asked = verdict.requirement
    name = "robustness" if asked.formula is not None else _named(verdict)
    mean = "mean " if asked.over is Over.MEAN else ""
    text = f"{one_line(asked.id)}   {bracketed(name, asked.unit)}, {mean}{bound(asked)}"
    metric = METRICS.get(asked.metric)
    never = f"never {metric.never}" if metric is not None and metric.never else "without a figure"
    without = np.isnan(verdict.values)
    ended = np.array([each in {Status.PASS, Status.FAIL} for each in verdict.statuses])
    tail = _tail(int((without & ended).sum()), never) + _tail(int((without & ~ended).sum()), "undecided")
    spot: dict[str, Any] = {"up": "bottom", "shift": (0.0, 0.8), "parts": True}
    axes.add(Text(0.0, 1.0, lettering.cut(text, 0.7 * ACROSS), **spot))
    told = f"{summary.passed(verdict)}{tail}"
    axes.add(Text(1.0, 1.0, told, colour=style.FAINT, across="right", **spot))
