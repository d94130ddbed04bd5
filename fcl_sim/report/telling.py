"""The one scan of a run that shows most of a rule base, step by step."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.loop.trace import FuzzyRecord, Values
from fcl_sim.report.inference import pictures
from fcl_sim.report.pictures import Picture
from fcl_sim.report.words import counted, one_line, with_unit


def telling_scan(record: FuzzyRecord) -> int | None:
    """Return the first sample at which the most rules fire; None where none does at any."""
    fires = (record.degrees > 0.0).sum(axis=1) * np.isfinite(record.inputs).all(axis=1)
    return int(fires.argmax()) if fires.size and fires.max() > 0 else None


def step_by_step(node: FuzzyNode, records: Mapping[str, FuzzyRecord], time: Values) -> list[Picture]:
    """Return the inference at the telling scan of the first run; `time` (n,) are the seconds of that run.

    Nothing where no rule fires, or in INT, whose steps are others.
    """
    label, record = next(iter(records.items()), ("", None))
    sample = None if record is None or node.in_int else telling_scan(record)
    if record is None or sample is None:
        return []
    point = dict(zip(record.input_names, record.inputs[sample].tolist(), strict=True))
    explanation = node.block.explain(**point)
    fired = counted(int((record.degrees[sample] > 0.0).sum()), "rule fires", "rules fire")
    at = with_unit(float(time[sample]), "s", 9)
    where = f"Run {one_line(label)} at {at}, the first scan at which the most rules fire at a time: {fired}. "
    stem = f"{node.block.name}-steps"
    shown = pictures(node.block.function_block, explanation, node.units, stem=stem)
    return [replace(each, caption=where + each.caption) for each in shown]
