"""A run beside its baseline, in words: what changed, how far, and why."""

from collections.abc import Iterable, Iterator, Sequence

from fcl_sim.judge import wording
from fcl_sim.judge.baseline import Baseline, Comparison, Figure, MetricChange, SignalChange
from fcl_sim.judge.verdict import Status
from fcl_sim.report.words import counted, exactly, joined, number, one_line, printed, with_unit
from fcl_sim.testbench import Outcome, Run
from fcl_sim.verify.cause import Cause, Divergence, RuleChange
from fcl_sim.verify.edits import Edit


def lines(run: Run) -> Iterator[str]:
    """Yield what left a run's baseline, a line each; nothing where all is within its tolerance."""
    compared = run.compared
    if compared is None or compared.baseline is None or compared.status is Status.PASS:
        return
    for metric in compared.changed_metrics:
        yield metric_line(metric)
    yield from _some([signal_line(each) for each in compared.changed_signals], "signals", MOST_SIGNALS)


def accepted(baseline: Baseline | None) -> str:
    """Return when and why a baseline was accepted."""
    if baseline is None:
        return str(Status.NO_BASELINE)
    return f"accepted on {baseline.date}: {one_line(baseline.reason)}"


def figures(baseline: Baseline | None) -> Iterator[str]:
    """Yield the figures of a baseline and what else it keeps, a line each."""
    if baseline is None:
        return
    for each in baseline.metrics:
        allowed = f" ±{with_unit(each.allowed, each.unit, 2)}" if each.figure.value is not None else ""
        yield f"{one_line(each.id)}, {one_line(each.about)}: {told(each.figure, each.unit)}{allowed}"
    yield kept(baseline)


def kept(baseline: Baseline) -> str:
    """Return which signals a baseline keeps, or why none."""
    if not baseline.signals:
        return one_line(baseline.left_out) or "no signals"
    samples = sum(each.ticks.size for each in baseline.signals)
    names = joined([one_line(each.name) for each in baseline.signals])
    return f"{counted(len(baseline.signals), 'signal')} in {samples} samples: {names}"


def metric_line(change: MetricChange) -> str:
    """Return a figure that changed, with its reference: `25.4 s → 27.1 s (+1.7 s, allowed ±0.08 s)`."""
    name = metric_about(change)
    if change.new is None:
        return f"{name}: it was {told(change.old, change.unit)}, and is not asked any more"
    if change.old is None:
        return f"{name}: {told(change.new, change.unit)}, without a baseline"
    text = f"{name}: {told(change.old, change.unit)} → {told(change.new, change.unit)}"
    if change.change is None:
        return text
    moved, allowed = with_unit(change.change, change.unit), with_unit(change.allowed, change.unit, 2)
    sign = "+" if change.change > 0 else ""
    return f"{text} ({sign}{moved}, allowed ±{allowed})"


def metric_about(change: MetricChange) -> str:
    """Return what a figure is of: the requirement, and what it measures, cut where it is long."""
    about = one_line(change.about)
    return f"{one_line(change.id)}, {about if len(about) <= LONGEST else about[: LONGEST - 1] + ELLIPSIS}"


LONGEST, ELLIPSIS = 60, "\N{HORIZONTAL ELLIPSIS}"
"""Characters of what is measured; the whole formula stands in the baseline."""

MOST_EDITS, MOST_SIGNALS = 6, 2
"""Edits or changed rules, and signals, that are told; of more, how many there are."""


Told = dict[Cause, str]
"""What changed in the runs that were told of before: the first of them that it changed in."""


def causes(run: Run, before: Told) -> Iterator[str]:
    """Yield why a run left its baseline, where it did: what was edited, and the first scan that told.

    What changed is told once, and referred to by the runs after that, which are noted in `before`.
    """
    cause = run.cause
    if cause is None:
        return
    if not (cause.setting or cause.edits):
        yield (
            "Rule bases, wiring and parameters are what they were: look at the plant's file, "
            "at the tables that blocks read, and at the version of fcl_sim."
            if _does_otherwise(run.compared)
            else "The run does what it did: its scenario asks something else of it."
        )
        return
    first = before.setdefault(Cause(setting=cause.setting, edits=cause.edits), run.variant)
    if first == run.variant:
        yield from _changed(cause)
    else:
        yield f"changed as in run {one_line(first)}"
    yield from _divergence_lines(cause)


def cause_texts(runs: Iterable[Run]) -> Iterator[str]:
    """Yield why runs left their baselines, runs of one reason together, each in sentences."""
    by_text: dict[str, list[str]] = {}
    before: Told = {}
    for run in runs:
        told = list(causes(run, before))
        parts = "; ".join(each for each in told if not each.endswith("."))
        sentences = [each for each in told if each.endswith(".")]
        text = " ".join([f"{parts}."] * bool(parts) + sentences)
        if text:
            by_text.setdefault(text, []).append(one_line(run.variant))
    for text, names in by_text.items():
        yield f"{'Run' if len(names) == 1 else 'Runs'} {joined(names)}: {text}"


def _does_otherwise(compared: Comparison | None) -> bool:
    """Return whether a figure or a signal is not what it was; one that only one side has tells nothing."""
    if compared is None:
        return False
    figures = [each for each in compared.changed_metrics if each.old is not None and each.new is not None]
    return bool(figures) or any(each.status is not Status.NO_BASELINE for each in compared.changed_signals)


def _changed(cause: Cause) -> Iterator[str]:
    for old, new in cause.setting:
        yield f"changed: {_from_to(old, new)}"
    edits = [f"edited in {one_line(block)}: {edited(edit)}" for block, edit in cause.edits]
    yield from _some(edits, "edits")


def _divergence_lines(cause: Cause) -> Iterator[str]:
    """Yield where what changed told first, and whether it is the whole reason."""
    if cause.divergence is not None:
        yield from _divergence(cause.divergence, "by the edits " if cause.setting else "")
    if cause.is_whole:
        yield "With the former rule base the run keeps its baseline: these edits are the whole reason."
    elif cause.edits and cause.divergence is None:
        yield "The former rule base does the same at every scan of this run: the reason lies elsewhere."
    elif cause.edits:
        why = "what else changed tells, too" if cause.setting else "there is another reason"
        yield f"With the former rule base the run does not keep its baseline either: {why}."


def edited(edit: Edit) -> str:
    """Return an edit in words."""
    where = {"term": f"{edit.owner}, ", "setting": f"{edit.owner}, "}.get(edit.kind, "")
    return where + _from_to(edit.old, edit.new)


def _from_to(old: str, new: str) -> str:
    if not old:
        return f"{one_line(new)} is new"
    return f"{one_line(old)} is gone" if not new else f"{one_line(old)} → {one_line(new)}"


def _divergence(found: Divergence, by: str) -> Iterator[str]:
    old, new = with_unit(found.old, ""), with_unit(found.new, found.unit)
    yield f"first diverging scan {by}".rstrip() + (
        f": {exactly(found.time, 's')}, {one_line(found.signal)} {old} → {new}"
    )
    yield from _some([_rule(each) for each in found.rules], "rules")


def _rule(change: RuleChange) -> str:
    name = f"rule {one_line(change.label)}"
    if change.new is None:
        return f"{name} is gone; it fired with {number(change.old or 0.0)}"
    if change.old is None:
        return f"{name} is new and fires with {number(change.new)}"
    if change.old == change.new:
        return f"{name} fires with {number(change.new)} as before, and concludes something else"
    return f"{name} fires with {number(change.new)} instead of {number(change.old)}"


def _some(told_lines: Sequence[str], what: str, most: int = MOST_EDITS) -> Iterator[str]:
    shown = len(told_lines) if len(told_lines) == most + 1 else most
    yield from told_lines[:shown]
    if len(told_lines) > shown:
        yield f"and {len(told_lines) - shown} further {what}"


def told(figure: Figure | None, unit: str) -> str:
    """Return a figure with its unit, or the word for why there is none."""
    if figure is None:
        return "\N{EM DASH}"
    return figure.word if figure.value is None else with_unit(figure.value, unit, 5)


def signal_line(change: SignalChange) -> str:
    """Return where a signal left its tolerance."""
    name = one_line(change.name)
    if change.reason:
        return f"{name}: {one_line(change.reason)}"
    above = change.value > change.high
    edge, word = (change.high, "at most") if above else (change.low, "at least")
    value, bound = _apart(change.value, edge, change.unit), _apart(edge, change.value, change.unit)
    farthest = with_unit(change.farthest, change.unit)
    return (
        f"{name}: {value} at {exactly(change.time, 's')}, where {word} {bound} is allowed; "
        f"up to {farthest} beyond"
    )


def _apart(number: float, other: float, unit: str) -> str:
    """Return a number with its unit, to as many digits as tell it from another."""
    return printed(wording.number(number, unit, other))


def sentence(outcomes: Sequence[Outcome]) -> str:
    """Return how the runs came out beside their baselines; nothing where none was compared."""
    compared = [run.compared for outcome in outcomes for run in outcome.variants.values() if run.compared]
    if not compared:
        return ""
    statuses = [each.status for each in compared]
    tally = ", ".join(f"{statuses.count(each)} {each}" for each in Status if each in statuses)
    return f"Baselines of {counted(len(compared), 'run')}: {tally}."


def is_missing(compared: Comparison | None) -> bool:
    """Return whether a run has no baseline at all."""
    return compared is not None and compared.baseline is None
