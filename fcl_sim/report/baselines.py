"""A run beside its baseline, in words: what changed, how far, and why."""

from collections.abc import Iterator, Sequence

from fcl_sim.judge.baseline import Comparison, Figure, MetricChange, SignalChange
from fcl_sim.judge.verdict import Status
from fcl_sim.report.words import counted, exactly, one_line, with_unit
from fcl_sim.testbench import Outcome, Run


def lines(run: Run) -> Iterator[str]:
    """Yield what changed since a run's baseline, a line each; nothing where all is within its tolerance."""
    compared = run.compared
    if compared is None or compared.baseline is None or compared.status is Status.PASS:
        return
    for metric in compared.changed_metrics:
        yield metric_line(metric)
    for signal in compared.changed_signals:
        yield signal_line(signal)


def metric_line(change: MetricChange) -> str:
    """Return a figure that changed, with its reference: `25.4 s → 27.1 s (+1.7 s, allowed ±0.08 s)`."""
    name = one_line(f"{change.id}, {change.about}")
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
    here = f"at {exactly(change.time, 's')} it is {with_unit(change.value, change.unit)}"
    low, high = (with_unit(each, unit) for each, unit in ((change.low, ""), (change.high, change.unit)))
    farthest = with_unit(change.farthest, change.unit)
    return f"{name}: {here}, and {low} to {high} is allowed; farthest beyond: {farthest}"


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
