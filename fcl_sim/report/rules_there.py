"""What the rules do where a requirement is first missed: the first thing that is asked of a miss."""

from collections.abc import Iterator, Sequence

import numpy as np

from fcl_sim.judge.verdict import Status, Verdict
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.report.provenance import fuzzy_nodes
from fcl_sim.report.violations import Interval, merged, violations
from fcl_sim.report.words import joined, number, one_line, together, with_unit
from fcl_sim.testbench import Outcome, Run

MOST = 4
"""Rules that are named, those of the largest degrees; of more, how many there are."""

MOST_OUTPUTS = 3


def first_miss(run: Run) -> Verdict | None:
    """Return the requirement that a run is the first to violate in time, where that is not expected of it."""
    found = [each for each in run.verdicts if _is_missed(each) and each.violation is not None]
    return min(found, key=lambda each: (each.violation or (np.inf,))[0], default=None)


def missed_stretches(run: Run) -> list[Interval]:
    """Return where a run violates any requirement, in whatever signal: stretches that do not overlap."""
    return merged(
        stretch
        for verdict in run.verdicts
        for stretch in violations(run.trace, verdict, verdict.requirement.signals)
    )


def sample_at(run: Run, time: float) -> int:
    """Return the last sample that is not later than a time in seconds."""
    return max(int(np.searchsorted(run.trace.ticks, round(time * 1e9), side="right")) - 1, 0)


def rules_there(run: Run, verdict: Verdict) -> str:
    """Return what rules fire where a requirement is first violated, and what they give; else nothing.

    They need not be to blame: what a rule does takes its time through the plant.
    """
    nodes = fuzzy_nodes(run)
    if verdict.violation is None or not nodes or not len(run.trace.ticks):
        return ""
    sample = sample_at(run, verdict.violation[0])
    told = [_rules(run, node, sample, alone=len(nodes) == 1) for node in nodes]
    at = with_unit(verdict.violation[0], "s", 9)
    return together(f"At {at} {'; '.join(told)}.")


def _rules(run: Run, node: FuzzyNode, sample: int, *, alone: bool) -> str:
    record = run.trace.fuzzy[node.name]
    degrees = record.degrees[sample]
    order = [rule for rule in np.argsort(-degrees, kind="stable").tolist() if degrees[rule] > 0.0]
    named = [f"{one_line(record.rule_labels[rule])} ({number(float(degrees[rule]), 2)})" for rule in order]
    more = [f"{len(named) - MOST} more"] if len(named) > MOST else []
    of = "" if alone else f" of {one_line(node.name)}"
    word = "rule" if len(named) == 1 else "rules"
    fired = f"{word} {joined([*named[:MOST], *more])}{of} {'fires' if len(named) == 1 else 'fire'}"
    values = zip(record.output_names, record.outputs[sample].tolist(), strict=True)
    unit_of = {name.casefold(): unit for name, unit in node.units.items()}
    given = [
        f"{one_line(name)} = {with_unit(value, unit_of.get(name.casefold(), ''))}" for name, value in values
    ]
    return ", ".join([fired if named else f"no rule{of} fires", *given[:MOST_OUTPUTS]])


def misses(outcomes: Sequence[Outcome]) -> Iterator[str]:
    """Yield a sentence or two for each requirement that a run misses though it is not expected to."""
    for outcome in outcomes:
        for run in outcome.variants.values():
            for verdict in run.verdicts:
                if _is_missed(verdict):
                    name = f"{outcome.scenario.name} {run.variant}, {verdict.requirement.id}"
                    told = f"{name}: {one_line(verdict.reason)} {rules_there(run, verdict)}"
                    yield one_line(told).rstrip()


def _is_missed(verdict: Verdict) -> bool:
    return verdict.status is Status.FAIL and verdict.measured is Status.FAIL
