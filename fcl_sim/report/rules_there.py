"""What the rules do where a requirement is first missed: the first thing that is asked of a miss."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from operator import itemgetter

import numpy as np

from fcl_sim.judge.verdict import Status, Verdict
from fcl_sim.loop.diagram import Diagram, FuzzyNode
from fcl_sim.loop.settings import signals_of
from fcl_sim.model import Rule
from fcl_sim.report.bands import Missed
from fcl_sim.report.provenance import fuzzy_nodes
from fcl_sim.report.violations import merged, violations
from fcl_sim.report.words import NO_BREAK, joined, number, one_line, together, with_unit
from fcl_sim.testbench import Outcome, Run

MOST = 4
"""Rules that are named, those of the largest degrees; of more, how many there are."""

MOST_ROWS = 6
"""Requirements that have a bar of their own where they are violated, of those to be met and of the others."""

WEAK = 0.02
"""The part of the largest degree below which a rule is not named."""

MOST_OUTPUTS = 3


def first_miss(run: Run) -> Verdict | None:
    """Return the requirement that a run is the first to violate in time, where that is not expected of it."""
    missed = [each for each in run.verdicts if _is_missed(each)]
    found = [(each.violation[0], each) for each in missed if each.violation is not None]
    return min(found, key=itemgetter(0))[1] if found else None


def is_at_fault(run: Run) -> bool:
    """Return whether a run misses a requirement that it is to meet."""
    return any(map(_is_missed, run.verdicts))


def is_timeless(verdict: Verdict) -> bool:
    """Return whether a requirement is missed, and at no time of its own, as an integral is."""
    return verdict.measured is Status.FAIL and verdict.violation is None


def missed_when(run: Run) -> list[Missed]:
    """Return when a run violates which requirement: those it is to meet first; many of a kind in one."""
    found = [
        Missed(
            label=one_line(each.requirement.id),
            stretches=tuple(violations(run.trace, each, each.requirement.signals)),
            is_meant=each.requirement.expect_fail,
        )
        for each in run.verdicts
        if each.violation is not None
    ]
    kinds = [[each for each in found if each.is_meant is meant] for meant in (False, True)]
    return [row for kind in kinds for row in _few(kind)]


def _few(found: Sequence[Missed]) -> list[Missed]:
    if len(found) <= MOST_ROWS:
        return list(found)
    rest = found[MOST_ROWS - 1 :]
    stretches = merged(stretch for each in rest for stretch in each.stretches)
    more = replace(rest[0], label=f"{len(rest)} more", stretches=tuple(stretches))
    return [*found[: MOST_ROWS - 1], more]


def sample_at(run: Run, time: float) -> int:
    """Return the last sample that is not later than a time in seconds."""
    return max(int(np.searchsorted(run.trace.ticks, round(time * 1e9), side="right")) - 1, 0)


def rules_there(run: Run, verdict: Verdict) -> str:
    """Return what rules fire where a requirement is first violated, and what they give; else nothing.

    They need not be to blame: what a rule does takes its time through the plant.
    Nothing is said of rules that the plant does not hear of.
    """
    if verdict.violation is None or not len(run.trace.ticks):
        return ""
    heard = driving(run.diagram)
    nodes = [each for each in fuzzy_nodes(run) if each.name in heard]
    if not nodes:
        return ""
    sample = sample_at(run, verdict.violation[0])
    told = [_rules(run, node, sample, alone=len(nodes) == 1) for node in nodes]
    at = with_unit(verdict.violation[0], "s", 9)
    return together(f"At {at} {'; '.join(told)}.")


def driving(diagram: Diagram) -> set[str]:
    """Return the names of the blocks that the plant's inputs depend on, at whatever distance."""
    by_signal = {name: node for node in diagram.nodes for name in signals_of(node)}
    waiting = list(diagram.plant.inputs.values())
    seen: set[str] = set()
    found: set[str] = set()
    while waiting:
        name = waiting.pop().source
        if name in seen:
            continue
        seen.add(name)
        if name in diagram.aliases:
            waiting.append(diagram.aliases[name])
        elif name in by_signal:
            found.add(by_signal[name].name)
            waiting += by_signal[name].inputs.values()
    return found


def _rules(run: Run, node: FuzzyNode, sample: int, *, alone: bool) -> str:
    record = run.trace.fuzzy[node.name]
    degrees = record.degrees[sample]
    order = [rule for rule in np.argsort(-degrees, kind="stable").tolist() if degrees[rule] > 0.0]
    told = [rule for rule in order if degrees[rule] >= WEAK * degrees[order[0]]][:MOST]
    if len(order) == len(told) + 1:
        told = order  # its name takes no more room than that there is one
    of_block = [each for block in node.block.function_block.rule_blocks for each in block.rules]
    named = [_rule(record.rule_labels[each], of_block[each], float(degrees[each])) for each in told]
    more = [f"{len(order) - len(told)} more"] if len(order) > len(told) else []
    of = "" if alone else f" of {one_line(node.name)}"
    word, fire = ("rule", "fires") if len(order) == 1 else ("rules", "fire")
    fired = f"{word} {joined([*named, *more])}{of} {fire}"
    values = zip(record.output_names, record.outputs[sample].tolist(), strict=True)
    unit_of = {name.casefold(): unit for name, unit in node.units.items()}
    given = [
        f"{one_line(name)}{NO_BREAK}={NO_BREAK}{with_unit(value, unit_of.get(name.casefold(), ''))}"
        for name, value in values
    ]
    return ", ".join([fired if named else f"no rule{of} fires", *given[:MOST_OUTPUTS]])


def _rule(label: str, rule: Rule, degree: float) -> str:
    """Return a rule with what it concludes and its degree: `8 → hold (0.7)`."""
    terms = [one_line(each.term or each.variable) for each in rule.conclusions]
    return f"{one_line(label)} → {' and '.join(terms)} ({number(degree, 2)})"


def misses(outcomes: Sequence[Outcome]) -> Iterator[str]:
    """Yield a few sentences for each requirement that is missed though it is not expected to be.

    They tell of the first run that misses it, and name the others.
    """
    for outcome in outcomes:
        found: dict[str, list[tuple[Run, Verdict]]] = {}
        for run in outcome.variants.values():
            for verdict in run.verdicts:
                if _is_missed(verdict):
                    found.setdefault(verdict.requirement.id, []).append((run, verdict))
        for name, ((run, verdict), *others) in found.items():
            told = [f"{outcome.scenario.name} {run.variant}, {name}: {verdict.reason}"]
            told.append(rules_there(run, verdict))
            if others:
                names = joined([each.variant for each, _ in others])
                told.append(f"{names} {'misses' if len(others) == 1 else 'miss'} it, too.")
            yield one_line(" ".join(filter(None, told)))


def _is_missed(verdict: Verdict) -> bool:
    return verdict.status is Status.FAIL and verdict.measured is Status.FAIL
