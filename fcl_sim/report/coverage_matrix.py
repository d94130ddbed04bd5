"""Coverage as the matrix of the report: a row for each rule, a column for each item."""

from typing import Any

from fcl_sim.report import coverage_words
from fcl_sim.report.words import counted, one_line
from fcl_sim.verify.coverage import Coverage, Item

Data = dict[str, Any]


def matrix(coverage: Coverage) -> Data:
    """Return rows, notes and the meaning of the columns; `part` is the share of scans, as a bar shows it."""
    return {
        "summary": f"{counted(len(coverage.runs), 'run')}, {counted(coverage.scans, 'scan')}: "
        + coverage_words.sentence([coverage]),
        "items": [each.capitalize() for each in Item],
        "rows": [
            {
                "label": one_line(rule.label),
                "text": one_line(rule.text),
                "cells": [
                    {
                        "share": coverage_words.share(rule.seen(item), coverage.scans),
                        "part": rule.seen(item).scans / max(1, coverage.scans),
                        "open": not rule.seen(item).scans and coverage.waiver(rule, item) is None,
                    }
                    for item in Item
                ],
                "first": coverage_words.first(rule.fired),
                "remark": one_line(coverage_words.remark(coverage, rule)),
            }
            for rule in coverage.rules
        ],
        "notes": [one_line(each) for each in coverage_words.notes(coverage)],
        "meaning": coverage_words.explained(coverage),
    }
