"""The one scan of a run that shows most of a rule base, step by step."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from fcl_sim.engine.explain import Explanation, explain
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.loop.trace import FuzzyRecord, Values
from fcl_sim.report.inference import pictures
from fcl_sim.report.pictures import Picture
from fcl_sim.report.words import counted, one_line, with_unit


def telling_scan(record: FuzzyRecord) -> int | None:
    """Return the first sample at which the most rules fire; None where none does at any."""
    fires = (record.degrees > 0.0).sum(axis=1) * np.isfinite(record.inputs).all(axis=1)
    return int(fires.argmax()) if fires.size and fires.max() > 0 else None


@dataclass(frozen=True, slots=True, kw_only=True)
class Miss:
    """Where a run first violates a requirement that it is to meet: its label, the time in s, the sample.

    `node` is the block in that run, which may be one of another arithmetic.
    """

    id: str
    label: str
    time: float
    sample: int
    node: FuzzyNode


def step_by_step(
    node: FuzzyNode, records: Mapping[str, FuzzyRecord], time: Values, missed: Miss | None = None
) -> list[Picture]:
    """Return the inference where a requirement is `missed`, else at the telling scan of the first run.

    `time` (n,) are the seconds of the first run. Nothing in INT, whose steps are
    others, or where no rule fires and nothing is missed.
    """
    chosen = _miss(records, missed) or _telling(node, records, time)
    if chosen is None:
        return []
    block, record, sample, where = chosen
    explanation = _explained(block, record, sample)
    count = int((record.degrees[sample] > 0.0).sum())
    fired = counted(count, "rule fires", "rules fire") if count else "no rule fires"
    stem = f"{node.block.name}-steps"
    shown = pictures(node.block.function_block, explanation, node.units, stem=stem)
    return [replace(each, caption=f"{where}: {fired}. {each.caption}") for each in shown]


Chosen = tuple[FuzzyNode, FuzzyRecord, int, str]
"""A block in a run, what it did there, one of the samples, and in words which that is."""


def _miss(records: Mapping[str, FuzzyRecord], missed: Miss | None) -> Chosen | None:
    if missed is None or missed.node.in_int:
        return None
    if not np.isfinite(records[missed.label].inputs[missed.sample]).all():
        return None
    at = with_unit(missed.time, "s", 9)
    where = f"Run {one_line(missed.label)} at {at}, where {one_line(missed.id)} is first violated"
    return missed.node, records[missed.label], missed.sample, where


def _explained(node: FuzzyNode, record: FuzzyRecord, sample: int) -> Explanation:
    """Return the steps of a scan, with what outputs were before it: NC keeps that."""
    program = node.program
    memory = program.initial.copy()
    outputs = slice(program.outputs_at, program.outputs_at + len(program.output_names))
    memory[outputs] = record.previous(memory[outputs].astype(np.float64))[sample]
    memory[: len(program.input_names)] = record.inputs[sample]
    return explain(node.block.function_block, program, memory)


def _telling(node: FuzzyNode, records: Mapping[str, FuzzyRecord], time: Values) -> Chosen | None:
    label, record = next(iter(records.items()), ("", None))
    sample = None if record is None or node.in_int else telling_scan(record)
    if record is None or sample is None:
        return None
    at = with_unit(float(time[sample]), "s", 9)
    where = f"Run {one_line(label)} at {at}, the first scan at which the most rules fire at a time"
    return node, record, sample, where
