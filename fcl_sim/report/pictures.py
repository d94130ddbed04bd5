"""Which pictures of signals over time an outcome gets, each with its caption and alternative text."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from fcl_sim.report import alt
from fcl_sim.report.canvas import Figure
from fcl_sim.report.events import marks_of
from fcl_sim.report.time_plots import Lane, Shown, lanes, pages, time_plot
from fcl_sim.report.words import one_line, with_unit
from fcl_sim.testbench import Outcome, Run


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """A figure yet to be drawn: the stem of its file, its caption, its text for who cannot see it.

    `size` are its width and height in mm where it is not as wide as the column.
    """

    name: str
    caption: str
    alt: str
    draw: Callable[[], Figure]
    size: tuple[float, float] | None = None


def all_runs(outcome: Outcome) -> list[Picture]:
    """Return the judged signals with all runs overlaid; nothing where there is one run, or nothing judged."""
    runs = [view_of(run) for run in outcome.variants.values()]
    wanted = [lane for lane in lanes(runs[0]) if lane.judged] if len(runs) > 1 else []
    parted = pages(wanted)
    return [
        Picture(
            name=numbered("all-runs", index, len(parted)),
            caption="Judged signals, all runs overlaid. Bands are what the requirements allow, dashed lines "
            "their bounds; the bars at the upper edge, in the legend's order, mark where a run violates one.",
            alt=alt.of_runs(runs, page),
            draw=partial(time_plot, runs, page),
        )
        for index, page in enumerate(parted)
    ]


def over_time(run: Run) -> list[Picture]:
    """Return every signal of a run over time, as many figures as pages are needed.

    What is not judged and never changes is told in the first caption instead.
    """
    view = view_of(run)
    every = lanes(view)
    still = [each for each in every if not each.judged and _is_still(run, each)]
    if len(still) == len(every):
        still = []
    parted = pages([each for each in every if each not in still])
    return [
        Picture(
            name=numbered(f"{run.variant}-time", index, len(parted)),
            caption=_caption(run, page, index) + (_told(run, still) if index == 0 else ""),
            alt=alt.of_runs([view], page),
            draw=partial(time_plot, [view], page),
        )
        for index, page in enumerate(parted)
    ]


def numbered(stem: str, index: int, count: int) -> str:
    """Return the stem of a picture, numbered where there are several."""
    return stem if count == 1 else f"{stem}-{index + 1}"


def view_of(run: Run) -> Shown:
    """Return a run as a time plot takes it."""
    duration = run.diagram.timing.duration / 1e9
    return Shown(label=run.variant, trace=run.trace, duration=duration, verdicts=run.verdicts)


def _is_still(run: Run, lane: Lane) -> bool:
    values = run.trace[lane.signal]
    return bool(len(values) and np.isfinite(values[0]) and (values == values[0]).all())


def _told(run: Run, still: Sequence[Lane]) -> str:
    """Return the values of signals that never change."""
    values = [
        f"{one_line(' = '.join(each.names))} = {with_unit(float(run.trace[each.signal][0]), each.unit)}"
        for each in still
    ]
    return f" Constant: {'; '.join(values)}." if values else ""


def _caption(run: Run, page: Sequence[Lane], index: int) -> str:
    what = "every signal over time" if index == 0 else "further signals over time"
    parts = [f"Run {one_line(run.variant)}: {what}."]
    if any(lane.judged for lane in page):
        parts.append("Bands are what the requirements allow, dashed lines their bounds.")
        if any(verdict.violation for verdict in run.verdicts):
            parts.append("A shaded stretch with a bar at its upper edge violates a requirement.")
    if any(not record.active.all() for record in run.trace.fuzzy.values()):
        parts.append("Hatching at the foot of an output: no rule is active.")
    if marks_of(run.trace):
        parts.append("Dashed uprights: what blocks reported and what happened to the PLC.")
    if run.trace.fault is not None:
        fault = run.trace.fault
        parts.append(f"The run ended at {with_unit(fault.tick / 1e9, 's', 9)}: {one_line(fault.reason)}.")
    return " ".join(parts)
