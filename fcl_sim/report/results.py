"""The results as one document: what `--json` prints and what the PDF carries.

`schema` rises when a key changes its meaning or goes. The document depends on
the inputs alone: no times of day, no durations of a computation. Numbers that
JSON has no word for are null.
"""

import json
import math
import platform
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from typing import Any

from fcl_sim import __version__
from fcl_sim.envelope.envelope import Envelope
from fcl_sim.judge.envelope import EnvelopeVerdict
from fcl_sim.judge.verdict import Band, Corridor, Relative, Requirement, Verdict, worst
from fcl_sim.report.baseline_json import beside_baseline
from fcl_sim.report.constants import Constant, Settings, blocks_of, parameters_of, starts_of
from fcl_sim.report.provenance import InputFile, fuzzy_nodes, inputs_of
from fcl_sim.report.summary import overall
from fcl_sim.scenario.model import Scenario
from fcl_sim.testbench import Against, Outcome, Run, coverage
from fcl_sim.verify.coverage import Coverage
from fcl_sim.verify.coverage_json import as_json

SCHEMA = 1

Json = dict[str, Any]


def document(outcomes: Sequence[Outcome], covered: Sequence[Coverage] | None = None) -> Json:
    """Return the results of a run as JSON's types: scenarios, variants, verdicts, hashes, versions, coverage.

    `covered` is the coverage of the outcomes, where it is known.
    """
    return {
        "schema": SCHEMA,
        "tool": "fcl_sim",
        "versions": versions(),
        "verdict": str(overall(outcomes)),
        "scenarios": [_scenario(outcome) for outcome in outcomes],
        "coverage": [as_json(each) for each in (coverage(outcomes) if covered is None else covered)],
    }


def recorded(trace: str, scenario: Scenario, variant: str, verdicts: Sequence[Verdict]) -> str:
    """Return what came of a recorded trace, judged by a scenario, as text."""
    made = {
        "schema": SCHEMA,
        "tool": "fcl_sim",
        "versions": versions(),
        "verdict": str(worst([each.status for each in verdicts])),
        "trace": trace,
        "scenario": scenario.name,
        "variant": variant,
        "requirements": [_verdict(each) for each in verdicts],
    }
    return printed(made)


def text(outcomes: Sequence[Outcome], covered: Sequence[Coverage] | None = None) -> str:
    """Return the document as text, the same from the same inputs."""
    return printed(document(outcomes, covered))


def printed(made: Json) -> str:
    """Return a document as text."""
    return json.dumps(made, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def versions() -> dict[str, str]:
    """Return the versions of what computed the results."""
    return {
        "fcl_sim": __version__,
        "python": platform.python_version(),
        "numpy": version("numpy"),
        "numba": version("numba"),
    }


def _scenario(outcome: Outcome) -> Json:
    scenario = outcome.scenario
    return {
        "name": scenario.name,
        "title": scenario.title,
        "verdict": str(outcome.verdict),
        "overrides": {key: str(value) for key, value in scenario.overrides.items()},
        "inputs": [_input(each) for each in inputs_of(outcome)],
        "variants": [_run(run) for run in outcome.variants.values()],
        "against": None if outcome.against is None else _older(outcome.against),
    }


def _input(file: InputFile) -> Json:
    return {"role": file.role, "name": file.name, "sha256": file.digest}


def _run(run: Run) -> Json:
    diagram, fault = run.diagram, run.trace.fault
    timing = diagram.timing
    return {
        "name": run.variant,
        "title": run.title,
        "verdict": str(run.verdict),
        "scan_ns": timing.scan,
        "duration_ns": timing.duration,
        "latency_ns": timing.latency,
        "jitter_ns": timing.jitter,
        "seed": timing.seed,
        "integration": "exact" if diagram.exact else diagram.integration.scheme,
        "rtol": diagram.integration.rtol,
        "plant": {
            "model": diagram.plant.model.declaration.name,
            "parameters": _finite(diagram.plant.parameters),
            "start": _finite(diagram.plant.start),
            "constants": [_constant(each) for each in parameters_of(diagram.plant)],
            "states": [_constant(each) for each in starts_of(diagram.plant)],
        },
        "blocks": [_block(each) for each in blocks_of(diagram)],
        "rule_bases": [
            {
                "block": node.name,
                "function_block": node.block.function_block.name,
                "arithmetic": node.arithmetic,
            }
            for node in fuzzy_nodes(run)
        ],
        "samples": len(run.trace.ticks),
        "fault": None
        if fault is None
        else {"time_ns": fault.tick, "signal": fault.signal, "reason": fault.reason},
        "events": [
            {
                "block": each[0].block,
                "event": str(each[0].name),
                "warning": each[0].warning,
                "times": len(each),
                "first_ns": each[0].tick,
            }
            for each in run.trace.events_by_kind
        ],
        "requirements": [_verdict(each) for each in run.verdicts],
        "baseline": beside_baseline(run),
        "envelope": None if run.envelope is None else _envelope(run.envelope),
    }


def _constant(constant: Constant) -> Json:
    return {
        "name": constant.name,
        "value": _number(constant.value),
        "unit": constant.unit,
        "meaning": constant.meaning,
        "source": constant.source,
        "declared": _number(constant.declared),
        "assumed": constant.is_assumed,
        "minimum": _number(constant.minimum),
        "maximum": _number(constant.maximum),
    }


def _block(block: Settings) -> Json:
    return {
        "name": block.name,
        "type": block.type,
        "given": {name: _plain(each) for name, each in block.given.items()},
        "left": {name: _plain(each) for name, each in block.left.items()},
        "wired": {**block.wired},
    }


def _plain(value: Any) -> Any:
    """Return a parameter as JSON has it; a quantity is a text, as it is written."""
    if isinstance(value, Mapping):
        return {str(name): _plain(each) for name, each in value.items()}
    if isinstance(value, tuple | list):
        return [_plain(each) for each in value]
    if isinstance(value, bool | int):
        return value
    return _number(value) if isinstance(value, float) else str(value)


def _envelope(envelope: Envelope) -> Json:
    """Return the axes and what came of each requirement, point by point: the last axis varies fastest."""
    return {
        "verdict": str(envelope.verdict),
        "axes": [
            {"key": axis.key, "values": [each.plain() for each in axis.values]} for axis in envelope.grid.axes
        ],
        "points": len(envelope),
        "requirements": [_over_envelope(envelope, each) for each in envelope.verdicts],
    }


def _over_envelope(envelope: Envelope, verdict: EnvelopeVerdict) -> Json:
    worst = verdict.worst
    return {
        **_asked(verdict.requirement),
        "over": str(verdict.requirement.over),
        "verdict": str(verdict.status),
        "measured": str(verdict.measured),
        "passed": verdict.passed,
        "needed": verdict.needed,
        "value": _number(verdict.value),
        "worst": None if worst is None else {"point": worst, "at": envelope.grid.values(worst)},
        "definition": verdict.definition,
        "reason": verdict.reason,
        "values": [_number(each) for each in verdict.values.tolist()],
        "verdicts": [str(each) for each in verdict.statuses],
    }


def _older(against: Against) -> Json:
    return {"label": against.label, "variants": [_run(run) for run in against.runs.values()]}


def _verdict(verdict: Verdict) -> Json:
    return {
        **_asked(verdict.requirement),
        "verdict": str(verdict.status),
        "measured": str(verdict.measured),
        "value": _number(verdict.value),
        "definition": verdict.definition,
        "reason": verdict.reason,
        "band": _band(verdict.band),
        "violation_s": None if verdict.violation is None else [_number(each) for each in verdict.violation],
    }


def _asked(asked: Requirement) -> Json:
    return {
        "id": asked.id,
        "text": asked.text,
        "metric": asked.metric or None,
        "signal": asked.signals[0] if len(asked.signals) == 1 else None,
        "signals": list(asked.signals),
        "formula": None if asked.formula is None else str(asked.formula),
        "corridor": _corridor(asked.corridor),
        "arguments": _finite(asked.arguments),
        "restart_at": [_number(each) for each in asked.restart_at],
        "relative_to": _relative(asked.relative_to),
        "minimum": _number(asked.minimum),
        "maximum": _number(asked.maximum),
        "unit": asked.unit,
        "expect_fail": asked.expect_fail,
    }


def _relative(relative: Relative | None) -> Json | None:
    return None if relative is None else {"variant": relative.variant, "as": str(relative.form)}


def _corridor(corridor: Corridor | None) -> Json | None:
    if corridor is None:
        return None
    return {
        "table": corridor.name,
        "time_s": [each / 1e9 for each in corridor.ticks],
        "low": [_number(each) for each in corridor.low],
        "high": [_number(each) for each in corridor.high],
    }


def _band(band: Band | None) -> Json | None:
    if band is None:
        return None
    return {
        "signal": band.signal,
        "low": _number(band.low),
        "high": _number(band.high),
        "start_s": _number(band.start),
        "end_s": _number(band.end),
    }


def _finite(values: Mapping[str, float]) -> Json:
    return {name: _number(value) for name, value in values.items()}


def _number(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None
