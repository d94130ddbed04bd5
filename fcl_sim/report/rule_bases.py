"""The rule bases of a run, each once, and what the report says of them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.loop.trace import FuzzyRecord, Values
from fcl_sim.model import Defuzzification, RuleBlock
from fcl_sim.report import characteristics
from fcl_sim.report.coverage_matrix import matrix
from fcl_sim.report.placed import Register, placed
from fcl_sim.report.proved import Proved
from fcl_sim.report.provenance import InputFile, fuzzy_nodes, rule_base
from fcl_sim.report.rule_matrix import rule_tables
from fcl_sim.report.rule_words import conformance, finding_rows
from fcl_sim.report.rules_there import first_miss, sample_at
from fcl_sim.report.sign_off import fact
from fcl_sim.report.telling import Miss, step_by_step
from fcl_sim.report.terms import moves
from fcl_sim.report.words import exactly, joined, one_line, plain
from fcl_sim.testbench import Outcome, Run
from fcl_sim.verify.coverage import Coverage

Data = dict[str, Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class Base:
    """A rule base: its file, a block that holds it, the runs that use it by label.

    `time` are the seconds (n,) of the first of these; `missed` is where the first
    of them violates a requirement, of those that do and should not.
    """

    file: InputFile
    node: FuzzyNode
    records: Mapping[str, FuzzyRecord]
    time: Values = field(default_factory=lambda: np.zeros(0))
    missed: Miss | None = None


def rule_bases(outcomes: Sequence[Outcome]) -> list[Base]:
    """Return each rule base once, in the order of its first use."""
    found: dict[tuple[str, str], Base] = {}
    records: dict[tuple[str, str], dict[str, FuzzyRecord]] = {}
    for outcome in outcomes:
        for run in outcome.variants.values():
            name = f"{outcome.scenario.name} {run.variant}" if len(outcomes) > 1 else run.variant
            nodes = fuzzy_nodes(run)
            blocks = [each.block.function_block for each in nodes]
            for node in nodes:
                file = rule_base(outcome, run, node)
                key = (node.block.function_block.name, file.digest)
                is_one_of_several = blocks.count(node.block.function_block) > 1
                label = f"{name} {node.name}" if is_one_of_several else name
                own = records.setdefault(key, {})
                base = found.setdefault(key, Base(file=file, node=node, records=own, time=run.trace.time))
                own[label] = run.trace.fuzzy[node.name]
                if base.missed is None:
                    found[key] = replace(base, missed=_missed(run, node, label))
    return list(found.values())


def _missed(run: Run, node: FuzzyNode, label: str) -> Miss | None:
    verdict = first_miss(run)
    if verdict is None or verdict.violation is None or not len(run.trace.ticks):
        return None
    sample = sample_at(run, verdict.violation[0])
    time = float(run.trace.time[sample])
    return Miss(id=verdict.requirement.id, label=label, time=time, sample=sample, node=node)


def rule_base_data(
    bases: Sequence[Base], register: Register, covered: Sequence[Coverage], proofs: Sequence[Proved]
) -> list[Data]:
    """Return what the report says of each rule base."""
    names = [base.node.block.name for base in bases]
    by_file = {(each.name, each.file): each for each in covered}
    proved = {(each.name, each.file): each for each in proofs}
    parts = []
    for index, base in enumerate(bases):
        part = _rule_base(base, f"r{index}", register, namesakes=names.count(base.node.block.name) > 1)
        own = by_file.get((base.node.block.name, base.file.name))
        parts.append(
            part
            | {
                "coverage": None if own is None else matrix(own),
                "findings": finding_rows(proved.get((base.node.block.name, base.file.name))),
            }
        )
    return parts


def _rule_base(base: Base, anchor: str, register: Register, *, namesakes: bool) -> Data:
    block = base.node.block.function_block
    shown = characteristics.memberships(base.node.block, base.node.units, f"{block.name}-terms", base.records)
    held = next(iter(base.records.values()), None) if moves(block) else None
    surfaces = characteristics.characteristic(
        base.node.block, base.node.units, f"{block.name}-surface", held=held
    )
    steps = step_by_step(base.node, base.records, base.time, base.missed)
    rules = sum(len(each.rules) for each in block.rule_blocks)
    operators = [_operators(each) for each in block.rule_blocks]
    where = f" in {one_line(base.file.name)}" if namesakes else ""
    outputs = [f"{each.variable}: {each.method}, {_undefined(each)}" for each in block.defuzzifications]
    return {
        "title": f"Rule base {one_line(block.name)}{where}",
        "anchor": anchor,
        "facts": [
            fact("File", base.file.name, mono=True),
            fact("SHA-256", base.file.digest, mono=True),
            fact("Rules", ", ".join([str(rules), *dict.fromkeys(operators)])),
            fact("Outputs", *outputs),
            fact("Conformance", *conformance(block)),
            *([fact("Used by", joined(list(base.records)))] if base.records else []),
        ],
        "pictures": [placed(each, "rule-bases", register) for each in shown],
        "tables": rule_tables(block),
        "steps": [placed(each, "rule-bases", register) for each in steps],
        "surfaces": [placed(each, "rule-bases", register) for each in surfaces],
        "source": plain(base.file.text).rstrip(),
    }


def _operators(block: RuleBlock) -> str:
    return f"AND {block.and_operator}, OR {block.or_operator}, ACCU {block.accumulation}"


def _undefined(output: Defuzzification) -> str:
    """Return what an output does where no rule is active (S30)."""
    return "NC, no change" if output.default is None else f"DEFAULT {exactly(output.default, '')}"
