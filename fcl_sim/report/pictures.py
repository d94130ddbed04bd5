"""Which pictures of signals over time an outcome gets, each with its caption and alternative text."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from fcl_sim.judge.verdict import Verdict
from fcl_sim.loop.diagram import FuzzyNode, Node
from fcl_sim.report import alt
from fcl_sim.report.canvas import Figure
from fcl_sim.report.events import marks_of
from fcl_sim.report.ranges import NOISE, width
from fcl_sim.report.time_plots import Lane, Shown, lanes, lanes_of, pages, time_plot
from fcl_sim.report.words import joined, one_line, with_unit
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
    wanted = [lane for lane in lanes_of(runs) if lane.judged] if len(runs) > 1 else []
    parted = pages(wanted, runs)
    return [
        Picture(
            name=numbered("all-runs", index, len(parted)),
            caption="Judged signals, all runs overlaid. Bands are what the requirements allow, dashed lines "
            "their bounds; the strokes above the lines, as in the legend, mark where a run violates one.",
            alt=alt.of_runs(runs, page),
            draw=partial(time_plot, runs, page),
        )
        for index, page in enumerate(parted)
    ]


def over_time(run: Run, base: Run | None = None) -> list[Picture]:
    """Return what a reader asks of a run over time, as many figures as pages are needed.

    That is what its requirements are about, what drives its plant, what is set,
    what its rule bases read and give, and the signal at which it ended early. What is not
    judged and never changes, or is as in the `base` run, is told in the first
    caption instead; where nothing is asked every signal is drawn.
    """
    view = view_of(run)
    every = lanes(view)
    still = [each for each in every if not each.judged and _is_still(run, each)]
    if len(still) == len(every):
        still = []
    moving = [each for each in every if each not in still]
    telling = _telling(run)
    asked = [each for each in moving if each.judged or not telling.isdisjoint(each.names)] or moving
    same = [each for each in asked if base is not None and not each.judged and _is_same(run, base, each)]
    drawn = [each for each in asked if each not in same] or asked
    parted = pages(drawn, [view])
    left = [each for each in moving if each not in asked]
    rest = f"{_told(run, still)}{_named(SAME, same if drawn is not asked else [])}{_named(LEFT, left)}"
    return [
        Picture(
            name=numbered(f"{run.variant}-time", index, len(parted)),
            caption=_caption(run, page, index) + (rest if index == 0 else ""),
            alt=alt.of_runs([view], page),
            draw=partial(time_plot, [view], page),
        )
        for index, page in enumerate(parted)
    ]


SAME = "As in the base run"
LEFT = "Recorded and not drawn"

MOST_NAMES = 8
"""Signals that a caption names; of more it gives the number."""


def _telling(run: Run) -> set[str]:
    """Return the signals that drive the plant, are set, are read and given by rules, or named by a fault."""
    diagram = run.diagram
    found = {f"{diagram.plant.name}.{each}" for each in diagram.plant.inputs}
    for node in (each for each in diagram.nodes if isinstance(each, FuzzyNode)):
        found |= {each.source for each in node.inputs.values()}
        found |= {node.name, *(f"{node.name}.{each}" for each in node.block.outputs)}
    sources = (each for each in diagram.nodes if isinstance(each, Node) and not each.inputs)
    found |= {each.name for each in sources if each.type != "noise"}
    return found if run.trace.fault is None else found | {run.trace.fault.signal}


def _is_same(run: Run, base: Run, lane: Lane) -> bool:
    """Return whether a signal is what it is in the base run, for binary32."""
    if lane.signal not in base.trace or len(run.trace.ticks) != len(base.trace.ticks):
        return False
    mine, theirs = run.trace[lane.signal], base.trace[lane.signal]
    return bool(np.allclose(mine, theirs, rtol=NOISE, atol=0.0))


def _named(what: str, left: Sequence[Lane]) -> str:
    names = [one_line(each.names[0]) for each in left if each.focus is None]
    if not names:
        return ""
    return f" {what}: {joined(names) if len(names) <= MOST_NAMES else f'{len(names)} further signals'}."


def numbered(stem: str, index: int, count: int) -> str:
    """Return the stem of a picture, numbered where there are several."""
    return stem if count == 1 else f"{stem}-{index + 1}"


def view_of(run: Run) -> Shown:
    """Return a run as a time plot takes it."""
    duration = run.diagram.timing.duration / 1e9
    return Shown(label=run.variant, trace=run.trace, duration=duration, verdicts=run.verdicts)


def _is_still(run: Run, lane: Lane) -> bool:
    values = run.trace[lane.signal]
    if not len(values) or not np.isfinite(values).all():
        return False
    return bool(width(values) <= NOISE * abs(values[0]))


def _told(run: Run, still: Sequence[Lane]) -> str:
    """Return the values of signals that never change."""
    values = [
        f"{one_line(' = '.join(each.names))} = {with_unit(float(run.trace[each.signal][0]), each.unit)}"
        for each in still
    ]
    return f" Constant: {'; '.join(values)}." if values else ""


def _is_seen(verdict: Verdict, page: Sequence[Lane]) -> bool:
    """Return whether a lane of a figure shows where a requirement is violated."""
    about = verdict.blamed or verdict.requirement.signals
    return any(not set(about).isdisjoint(lane.names) for lane in page)


def _caption(run: Run, page: Sequence[Lane], index: int) -> str:
    what = "signals over time" if index == 0 else "further signals over time"
    parts = [f"Run {one_line(run.variant)}: {what}."]
    if any(lane.judged for lane in page):
        parts.append("Bands are what the requirements allow, dashed lines their bounds.")
        seen = [each for each in run.verdicts if _is_seen(each, page)]
        formulas = [one_line(each.requirement.id) for each in seen if each.requirement.formula is not None]
        if formulas:
            is_one = len(formulas) == 1
            kind = "which is a formula, has" if is_one else "which are formulas, have"
            parts.append(f"{joined(formulas)}, {kind} no band.")
        if any(each.violation for each in seen):
            parts.append(
                "A shaded stretch with a bar at its upper edge violates a requirement"
                + (", of a formula the first that does, in what is to blame." if formulas else ".")
            )
    if any(not record.active.all() for record in run.trace.fuzzy.values()):
        parts.append("Hatching at the foot of an output: no rule is active.")
    if marks_of(run.trace):
        parts.append("Dashed uprights: what blocks reported and what happened to the PLC.")
    if not len(run.trace.ticks):
        parts.append("No scan was recorded.")
    if run.trace.fault is not None:
        fault = run.trace.fault
        reason = one_line(fault.reason).replace("`", "")
        parts.append(f"The run ended at {with_unit(fault.tick / 1e9, 's', 9)}: {reason}.")
    return " ".join(parts)
