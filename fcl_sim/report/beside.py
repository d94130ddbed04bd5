"""An outcome beside what it was: its baselines, and the older version that it is held against."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from fcl_sim.judge.baseline import Baseline, Figure
from fcl_sim.judge.metric import Better
from fcl_sim.judge.metrics import METRICS
from fcl_sim.judge.thin import line_at
from fcl_sim.judge.verdict import Status, Verdict
from fcl_sim.loop.trace import Trace
from fcl_sim.report import alt, baselines
from fcl_sim.report.pictures import Picture, numbered, view_of
from fcl_sim.report.time_plots import Lane, Shown, lanes_of, pages, time_plot
from fcl_sim.report.words import metric_name, one_line, with_unit
from fcl_sim.testbench import Outcome, Run

UNCHANGED = 1e-9
"""Part of a figure up to which it is the same: what another order of sums makes."""

MOST_LANES = 8
"""Signals of a run that are drawn beside an older one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Beside:
    """A figure or signal of a run beside what it was; `change` and `verdict` are words."""

    run: str
    about: str
    old: str
    new: str
    change: str
    verdict: str


def baseline_rows(outcome: Outcome) -> Iterator[Beside]:
    """Yield what left its baseline, or has none, run by run."""
    for run in outcome.variants.values():
        compared = run.compared
        if compared is None:
            continue
        if compared.baseline is None:
            about = "nobody has accepted this run yet"
            yield Beside(
                run=run.variant, about=about, old="", new="", change="", verdict=str(compared.status)
            )
        for each in compared.changed_metrics:
            yield Beside(
                run=run.variant,
                about=baselines.metric_about(each),
                old=baselines.told(each.old, each.unit),
                new=baselines.told(each.new, each.unit),
                change=_signed(each.change, each.unit),
                verdict=str(each.status),
            )
        for signal in compared.changed_signals:
            yield Beside(
                run=run.variant,
                about=baselines.signal_line(signal),
                old="",
                new="",
                change="",
                verdict=str(signal.status),
            )


def against_rows(outcome: Outcome) -> Iterator[Beside]:
    """Yield every figure of an outcome beside that of the older version."""
    if outcome.against is None:
        return
    for variant in dict.fromkeys((*outcome.variants, *outcome.against.runs)):
        new, old = outcome.variants.get(variant), outcome.against.runs.get(variant)
        pairs = [{each.requirement.id: each for each in run.verdicts} if run else {} for run in (old, new)]
        for key in dict.fromkeys((*pairs[1], *pairs[0])):
            yield _against(variant, pairs[0].get(key), pairs[1].get(key))


def _against(variant: str, old: Verdict | None, new: Verdict | None) -> Beside:
    one = new or old
    assert one is not None  # noqa: S101  a key of one of the two
    asked = one.requirement
    figures = [None if each is None else Figure.of(each) for each in (old, new)]
    units = [asked.unit if each is None else each.requirement.unit for each in (old, new)]
    return Beside(
        run=variant,
        about=f"{asked.id}, {_subject(one)}",
        old=baselines.told(figures[0], units[0]),
        new=baselines.told(figures[1], units[1]),
        change=_change(old, new),
        verdict=_verdicts(old, new),
    )


def _subject(verdict: Verdict) -> str:
    asked = verdict.requirement
    if asked.formula is not None:
        return "robustness of its formula"
    if asked.corridor is not None:
        return f"margin of {asked.corridor.signal}"
    return f"{metric_name(asked.metric)} of {asked.signal}"


def _change(old: Verdict | None, new: Verdict | None) -> str:
    """Return by how much a figure changed, and whether that is better; `none` where it did not."""
    if old is None or new is None:
        return "new" if old is None else "gone"
    if old.value is None or new.value is None or old.requirement.unit != new.requirement.unit:
        return "none" if Figure.of(old) == Figure.of(new) else ""
    change = new.value - old.value
    if abs(change) <= UNCHANGED * max(abs(old.value), abs(new.value)):
        return "none"
    metric = METRICS.get(new.requirement.metric)
    better = Better.HIGHER if metric is None else metric.better
    words = ""
    if better is not Better.NEITHER and new.requirement.relative_to is None:
        words = ", better" if (change > 0) == (better is Better.HIGHER) else ", worse"
    return _signed(change, new.requirement.unit) + words


def _signed(change: float | None, unit: str) -> str:
    if change is None:
        return ""
    return ("+" if change > 0 else "") + with_unit(change, unit)


def _verdicts(old: Verdict | None, new: Verdict | None) -> str:
    words = [str(each.status) for each in (old, new) if each is not None]
    return " → ".join(dict.fromkeys(words))


def baseline_pictures(run: Run) -> list[Picture]:
    """Return the signals of a run that left their references, each with its reference."""
    compared = run.compared
    if compared is None or compared.baseline is None:
        return []
    wanted = {each.name for each in compared.changed_signals if each.status is Status.FAIL}
    drawn = [each for each in compared.baseline.signals if each.name in wanted and each.name in run.trace]
    if not drawn:
        return []
    other = Shown(
        label=f"baseline of {compared.baseline.date}",
        trace=reference_trace(compared.baseline, run.trace),
        duration=run.diagram.timing.duration / 1e9,
    )
    view = view_of(run)
    shown = [lane for lane in lanes_of([view], [other]) if not wanted.isdisjoint(lane.names)]
    return _overlaid(run, [view, other], _named(shown, wanted), "baseline", other.label)


def reference_trace(baseline: Baseline, trace: Trace) -> Trace:
    """Return the reference signals of a baseline at the scans of a run, as a trace."""
    kept = [each for each in baseline.signals if each.name in trace and each.unit == trace.units[each.name]]
    columns = [line_at(each.ticks, each.values, trace.ticks) for each in kept]
    values = np.column_stack(columns) if columns else np.zeros((len(trace.ticks), 0))
    names = tuple(each.name for each in kept)
    return Trace(ticks=trace.ticks, names=names, units={each.name: each.unit for each in kept}, values=values)


def against_pictures(outcome: Outcome) -> list[Picture]:
    """Return the signals of every run that changed since the older version, overlaid with what they were."""
    found: list[Picture] = []
    for variant, old in outcome.against.runs.items() if outcome.against else ():
        run = outcome.variants.get(variant)
        if run is None or outcome.against is None:
            continue
        former = replace(view_of(old), label=outcome.against.label, verdicts=())
        views = [view_of(run), former]
        changed = [
            lane for lane in lanes_of(views[:1], views[1:]) if lane.focus is None and _differs(lane, run, old)
        ]
        found += _overlaid(run, views, changed[:MOST_LANES], "against", outcome.against.label)
    return found


def _differs(lane: Lane, run: Run, old: Run) -> bool:
    if lane.signal not in old.trace:
        return False
    one, other = run.trace[lane.signal], old.trace[lane.signal]
    return one.shape != other.shape or not np.allclose(one, other, rtol=UNCHANGED, atol=0.0, equal_nan=True)


def _named(shown: Sequence[Lane], wanted: set[str]) -> list[Lane]:
    """Return lanes under the name that the reference has, the second looks left out."""
    return [
        Lane(
            signal=next(name for name in lane.names if name in wanted),
            names=tuple(sorted(lane.names, key=lambda name: name not in wanted)),
            unit=lane.unit,
            judged=lane.judged,
        )
        for lane in shown
        if lane.focus is None
    ]


def _overlaid(
    run: Run, views: Sequence[Shown], shown: Sequence[Lane], stem: str, label: str
) -> list[Picture]:
    parted = pages(shown, views)
    return [
        Picture(
            name=numbered(f"{run.variant}-{stem}", index, len(parted)),
            caption=f"Run {one_line(run.variant)}: what changed, drawn over {one_line(label)}.",
            alt=alt.of_runs(views, page),
            draw=partial(time_plot, views, page),
        )
        for index, page in enumerate(parted)
    ]
