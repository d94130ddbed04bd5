"""Coverage as JSON's types."""

import math
from typing import Any

from fcl_sim.verify.coverage import Coverage, Item, RuleCoverage, Seen

Json = dict[str, Any]

MOST_MISSING = 1000
"""Combinations of terms that a document lists; `size` and `visited` tell how many there are."""


def as_json(coverage: Coverage) -> Json:
    """Return a coverage as a part of the results of a run; what has no end is null."""
    grid = coverage.grid
    return {
        "function_block": coverage.name,
        "file": coverage.file,
        "runs": list(coverage.runs),
        "scans": coverage.scans,
        "decisive_by": coverage.least,
        "rules": [_rule(coverage, each) for each in coverage.rules],
        "inputs": [
            {
                "variable": each.variable,
                "cells": [
                    {"low": _end(cell.low), "high": _end(cell.high), "scans": cell.scans}
                    for cell in each.cells
                ],
            }
            for each in coverage.inputs
        ],
        "combinations": {
            "inputs": list(grid.inputs),
            "size": grid.size,
            "visited": len(grid.visited),
            "missing": [list(names) for names, _ in zip(grid.missing(), range(MOST_MISSING), strict=False)],
        },
        "outputs": [
            {"variable": each.variable, "undefined": _seen(each.undefined)} for each in coverage.outputs
        ],
    }


def _rule(coverage: Coverage, rule: RuleCoverage) -> Json:
    found: Json = {"label": rule.label, "text": rule.text}
    for item in Item:
        found[str(item)] = _seen(rule.seen(item))
    found["largest_change"] = _end(rule.change)
    waivers = {str(item): coverage.waiver(rule, item) for item in Item if not rule.seen(item).scans}
    found["waived"] = {
        item: {"reason": each.reason, "date": each.date.isoformat()} for item, each in waivers.items() if each
    }
    return found


def _seen(seen: Seen) -> Json:
    first = None if seen.first is None else {"run": seen.first.run, "time_ns": seen.first.tick}
    return {"scans": seen.scans, "first": first}


def _end(value: float) -> float | None:
    return value if math.isfinite(value) else None
