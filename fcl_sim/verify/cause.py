"""A run that left its baseline → why: what was edited, and the scan at which the edit first told.

The former rule bases stand in the baseline. They are put back into the loop
and the run is made once more: up to the first scan at which the two runs
differ, plant and controller have seen the same, so what differs there is the
cause and not a consequence.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from fcl_sim.block import Block, loads
from fcl_sim.diagnostics import InputFault
from fcl_sim.judge.baseline import Baseline
from fcl_sim.judge.compare import compare
from fcl_sim.judge.judge import judge
from fcl_sim.judge.verdict import Requirement, Status
from fcl_sim.loop.diagram import Diagram, FuzzyNode, Node
from fcl_sim.loop.run import run
from fcl_sim.loop.trace import FuzzyRecord, Trace, Values
from fcl_sim.model.labels import unique_labels
from fcl_sim.verify.edits import RULE, TERM, Edit, edits
from fcl_sim.verify.record import canonical
from fcl_sim.verify.setting import setting_of

SAME = 1e-9
"""Part of a signal's size up to which two runs have the same value: what another order of sums makes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RuleChange:
    """A rule that does not fire as it did, or says something else: its degrees, None where there is none."""

    label: str
    old: float | None
    new: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Divergence:
    """The first scan at which a signal is not what the former rule bases make of it.

    `time` in seconds; `signal` with its values `old` and `new`. Where it is an
    output of a fuzzy block, `block` is that and `rules` are those of its rules
    that fire otherwise, or fire and were edited.
    """

    time: float
    signal: str
    unit: str
    old: float
    new: float
    block: str = ""
    rules: tuple[RuleChange, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Cause:
    """Why a run is not what its baseline says.

    `setting` has the lines that changed, as they were and as they are, either
    empty; `edits` what was edited in the rule base of each block. With
    `is_whole`, the former rule bases alone bring the run back to its baseline.
    """

    setting: tuple[tuple[str, str], ...] = ()
    edits: tuple[tuple[str, Edit], ...] = ()
    divergence: Divergence | None = None
    is_whole: bool = False


def cause_of(
    diagram: Diagram,
    trace: Trace,
    baseline: Baseline,
    requirements: Sequence[Requirement],
    runs: Mapping[str, Trace],
) -> Cause:
    """Return why a run differs from its baseline; `runs` are the traces by variant, as `judge` takes them."""
    setting = tuple(_changed(baseline.setting, tuple(setting_of(diagram))))
    former = dict(_former(diagram, baseline))
    found = tuple((name, edit) for name, block in former.items() for edit in _edits(diagram, name, block))
    if not found:
        return Cause(setting=setting)
    before = with_rule_bases(diagram, former)
    try:
        other = run(before)
    except InputFault:  # the former rule base has other variables: it does not fit this loop
        return Cause(setting=setting, edits=found)
    compared = compare(other, judge(other, requirements, runs), baseline)
    return Cause(
        setting=setting,
        edits=found,
        divergence=first_divergence(other, trace, _touched(diagram, former, found)),
        is_whole=compared.status is Status.PASS,
    )


def with_rule_bases(diagram: Diagram, blocks: Mapping[str, Block]) -> Diagram:
    """Return a diagram with other function blocks in some of its fuzzy blocks, by their names."""

    def with_block(node: Node | FuzzyNode) -> Node | FuzzyNode:
        if isinstance(node, FuzzyNode) and node.name in blocks:
            return replace(node, block=blocks[node.name])
        return node

    return replace(diagram, nodes=tuple(map(with_block, diagram.nodes)))


def _former(diagram: Diagram, baseline: Baseline) -> Iterator[tuple[str, Block]]:
    """Yield the rule bases that a baseline has and the loop has otherwise."""
    nodes = {node.name: node for node in diagram.nodes if isinstance(node, FuzzyNode)}
    for each in baseline.rule_bases:
        if each.block in nodes and each.text != canonical(nodes[each.block]):
            yield each.block, loads(each.text, f"{baseline.file}: {each.block}")


def _edits(diagram: Diagram, name: str, former: Block) -> tuple[Edit, ...]:
    node = next(each for each in diagram.nodes if each.name == name)
    assert isinstance(node, FuzzyNode)  # noqa: S101  `_former` yields no others
    return edits(former.function_block, node.block.function_block)


def _changed(old: Sequence[str], new: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Yield lines that changed, each beside the one that begins with the same two words."""
    gone, come = ([each for each in one if each not in other] for one, other in ((old, new), (new, old)))
    for line in gone:
        near = next((each for each in come if _subject(each) == _subject(line)), "")
        if near:
            come.remove(near)
        yield line, near
    for line in come:
        yield "", line


def _subject(line: str) -> list[str]:
    """Return what a line of a setting is about: `scan`, `parameter load_mass`, `block controller.rules`."""
    words = line.split()
    return words[:2] if words[0] in {"parameter", "start", "block", "cycle"} else words[:1]


def _touched(
    diagram: Diagram, former: Mapping[str, Block], found: Sequence[tuple[str, Edit]]
) -> set[tuple[str, str]]:
    """Return block and label of the rules that conclude otherwise: edited, or their term of an output is."""
    nodes = {node.name: node for node in diagram.nodes if isinstance(node, FuzzyNode)}
    touched = {(block, edit.name) for block, edit in found if edit.kind == RULE}
    terms = {(block, edit.owner, edit.name) for block, edit in found if edit.kind == TERM}
    for name, block in former.items():
        for version in (block, nodes[name].block):
            rules = (rule for each in version.function_block.rule_blocks for rule in each.rules)
            touched |= {
                (name, label)
                for label, rule in zip(unique_labels(version.function_block), rules, strict=True)
                if any((name, each.variable, each.term) in terms for each in rule.conclusions)
            }
    return touched


def first_divergence(
    former: Trace, trace: Trace, touched: Collection[tuple[str, str]] = ()
) -> Divergence | None:
    """Return where two runs of a loop part, None where they do not; fuzzy blocks go before other signals.

    `touched` has block and label of the rules that conclude otherwise though they fire as before.
    """
    shared = min(len(former.ticks), len(trace.ticks))
    names = [name for name in trace.names if name in former]
    rows = {name: _parts_at(former[name][:shared], trace[name][:shared]) for name in names}
    scan = min((row for row in rows.values() if row is not None), default=None)
    if scan is None:
        return None
    name = _first_signal(trace, [each for each in names if rows[each] == scan])
    block, rules = _rules_at(former, trace, name, scan, touched)
    return Divergence(
        time=float(trace.time[scan]),
        signal=name,
        unit=trace.units[name],
        old=float(former[name][scan]),
        new=float(trace[name][scan]),
        block=block,
        rules=rules,
    )


def _parts_at(old: Values, new: Values) -> int | None:
    """Return the first sample at which two signals differ by more than rounding."""
    size = float(np.max(np.abs(old), initial=0.0, where=np.isfinite(old)))
    differ = ~(np.abs(new - old) <= SAME * size) & ~(np.isnan(new) & np.isnan(old))
    return int(np.argmax(differ)) if differ.any() else None


def _first_signal(trace: Trace, names: Sequence[str]) -> str:
    outputs = [
        name
        for path, record in trace.fuzzy.items()
        for output in record.output_names
        for name in (path, f"{path}.{output}")
    ]
    return next((each for each in outputs if each in names), names[0])


def _rules_at(
    former: Trace, trace: Trace, name: str, scan: int, touched: Collection[tuple[str, str]]
) -> tuple[str, tuple[RuleChange, ...]]:
    for path, record in trace.fuzzy.items():
        if path in former.fuzzy and name in {path, *(f"{path}.{each}" for each in record.output_names)}:
            labels = {label for block, label in touched if block == path}
            return path, tuple(_rule_changes(former.fuzzy[path], record, scan, labels))
    return "", ()


def _rule_changes(
    former: FuzzyRecord, record: FuzzyRecord, scan: int, touched: set[str]
) -> Iterator[RuleChange]:
    """Yield the rules of a block that fire otherwise, or fire and are touched, the largest change first."""
    old = dict(zip(former.rule_labels, former.degrees[scan].tolist(), strict=True))
    new = dict(zip(record.rule_labels, record.degrees[scan].tolist(), strict=True))
    found = []
    for label in dict.fromkeys((*new, *old)):
        before, after = old.get(label), new.get(label)
        moved = abs((after or 0.0) - (before or 0.0))
        if moved > SAME or (label in touched and (before or after)):
            found.append((moved, RuleChange(label=label, old=before, new=after)))
    yield from (each for _, each in sorted(found, key=lambda pair: -pair[0]))
