"""A run beside its baseline as JSON's types, within the document of results."""

import math
from dataclasses import asdict
from typing import Any

from fcl_sim.judge.baseline import Figure, MetricChange, SignalChange
from fcl_sim.testbench import Run
from fcl_sim.verify.cause import Cause

Json = dict[str, Any]


def beside_baseline(run: Run) -> Json | None:
    """Return how a run came out beside its baseline; null where it was not compared."""
    compared = run.compared
    if compared is None:
        return None
    baseline = compared.baseline
    return {
        "verdict": str(compared.status),
        "file": None if baseline is None else baseline.file,
        "date": None if baseline is None else baseline.date,
        "reason": None if baseline is None else baseline.reason,
        "metrics": [_metric(each) for each in compared.metrics],
        "signals": [_signal(each) for each in compared.signals],
        "cause": None if run.cause is None else _cause(run.cause),
    }


def _metric(change: MetricChange) -> Json:
    return {
        "id": change.id,
        "about": change.about,
        "unit": change.unit,
        "verdict": str(change.status),
        "old": _figure(change.old),
        "new": _figure(change.new),
        "change": finite(change.change),
        "allowed": finite(change.allowed),
    }


def _figure(figure: Figure | None) -> float | str | None:
    if figure is None:
        return None
    return figure.word if figure.value is None else finite(figure.value)


def _signal(change: SignalChange) -> Json:
    return {
        "name": change.name,
        "unit": change.unit,
        "verdict": str(change.status),
        "first_s": finite(change.time),
        "until_s": finite(change.until),
        "value": finite(change.value),
        "low": finite(change.low),
        "high": finite(change.high),
        "farthest_beyond": finite(change.farthest),
        "reason": change.reason or None,
    }


def _cause(cause: Cause) -> Json:
    found = cause.divergence
    return {
        "setting": [{"old": old or None, "new": new or None} for old, new in cause.setting],
        "edits": [{"block": block, **asdict(edit)} for block, edit in cause.edits],
        "first_divergence": None
        if found is None
        else {
            "time_s": finite(found.time),
            "signal": found.signal,
            "unit": found.unit,
            "old": finite(found.old),
            "new": finite(found.new),
            "block": found.block or None,
            "rules": [asdict(each) for each in found.rules],
        },
        "rule_base_is_the_whole_reason": cause.is_whole,
    }


def finite(value: float | None) -> float | None:
    """Return a number that JSON has a word for; null for the others."""
    return value if value is not None and math.isfinite(value) else None
