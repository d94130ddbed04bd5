"""Every requirement against every run: what was asked of which, and what came of it, at a glance."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from fcl_sim.judge.envelope import EnvelopeVerdict
from fcl_sim.judge.verdict import Requirement, Status, Verdict
from fcl_sim.report import lettering
from fcl_sim.report.summary import expected_miss
from fcl_sim.report.words import counted, joined, one_line
from fcl_sim.testbench import Outcome, Run

Data = dict[str, Any]

MOST_RUNS = 12
"""Runs that stand beside one another; more take a further table."""

SIZE = 6.6
HIGHEST, EDGE = 26.0, 4.0
"""Height in mm of the names of runs, which read upwards, and what is kept free of it."""

TESTED = {Status.PASS, Status.FAIL}
"""Verdicts of what was put to the test."""

MARKS: Mapping[Status, str] = {
    Status.PASS: "●",
    Status.FAIL: "✕",
    Status.FAULT: "F",
    Status.INCONCLUSIVE: "?",
    Status.UNTESTED: "U",
    Status.NO_BASELINE: "B",
}
"""Verdicts as signs that differ in grey as well."""

MISS = "○"
"""A miss that is expected."""

NOT_ASKED = "–"
"""What stands before the sign of an envelope where the run itself is not asked."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Asked:
    """A requirement of a scenario: what came of it in each run, and over the envelope of each, by variant."""

    requirement: Requirement
    runs: Mapping[str, Verdict]
    envelopes: Mapping[str, EnvelopeVerdict]

    @property
    def is_tested(self) -> bool:
        """Whether any run put it to the test."""
        measured = [each.measured for each in self.runs.values()]
        measured += [each.measured for each in self.envelopes.values()]
        return not TESTED.isdisjoint(measured)


def asked_of(outcome: Outcome) -> list[Asked]:
    """Return every requirement of a scenario once, by its id, in the order of the text."""
    asked: dict[str, Requirement] = {}
    runs: dict[str, dict[str, Verdict]] = {}
    envelopes: dict[str, dict[str, EnvelopeVerdict]] = {}
    for run in outcome.variants.values():
        for verdict in run.verdicts:
            name = verdict.requirement.id
            asked.setdefault(name, verdict.requirement)
            runs.setdefault(name, {})[run.variant] = verdict
        for over in run.envelope.verdicts if run.envelope is not None else ():
            name = over.requirement.id
            asked.setdefault(name, over.requirement)
            envelopes.setdefault(name, {})[run.variant] = over
    order = [each.id for each in outcome.scenario.requirements]
    names = sorted(asked, key=lambda name: order.index(name) if name in order else len(order))
    return [
        Asked(requirement=asked[name], runs=runs.get(name, {}), envelopes=envelopes.get(name, {}))
        for name in names
    ]


def matrix_rows(outcomes: Sequence[Outcome]) -> list[Data]:
    """Return a table for each scenario, two for one of many runs."""
    return [
        _table(outcome, f"s{index}", runs)
        for index, outcome in enumerate(outcomes)
        for runs in _parted(list(outcome.variants.values()))
    ]


def _parted(runs: Sequence[Run]) -> list[Sequence[Run]]:
    return [runs[start : start + MOST_RUNS] for start in range(0, len(runs), MOST_RUNS)]


def _table(outcome: Outcome, anchor: str, runs: Sequence[Run]) -> Data:
    return {
        "title": one_line(outcome.scenario.title),
        "anchor": anchor,
        "runs": [one_line(run.variant) for run in runs],
        "head": min(HIGHEST, EDGE + max(lettering.text_width(one_line(run.variant), SIZE) for run in runs)),
        "rows": [
            {
                "id": one_line(each.requirement.id),
                "text": one_line(each.requirement.text),
                "cells": [_cell(each, run.variant) for run in runs],
            }
            for each in asked_of(outcome)
        ],
    }


def _cell(asked: Asked, variant: str) -> Data:
    """Return the signs of a requirement in a run: that of the run, that of its envelope."""
    found = [each[variant] for each in (asked.runs, asked.envelopes) if variant in each]
    marks = [MISS if expected_miss(each) else MARKS[each.status] for each in found]
    words = [_words(each) for each in found]
    if found and variant not in asked.runs:
        marks = [NOT_ASKED, *marks]
    return {
        "marks": "".join(marks),
        "words": "; ".join(words) or "not asked",
        "good": all(each.status is Status.PASS for each in found),
    }


def _words(verdict: Verdict | EnvelopeVerdict) -> str:
    word = f"{verdict.status}{', an expected miss' if expected_miss(verdict) else ''}"
    if isinstance(verdict, EnvelopeVerdict):
        return f"at {counted(verdict.points, 'point')} {word}"
    return word


def legend() -> list[Data]:
    """Return the signs with their meaning."""
    words = [(sign, str(status)) for status, sign in MARKS.items()]
    return [{"sign": sign, "words": each} for sign, each in [*words[:1], (MISS, "expected miss"), *words[1:]]]


def untested(outcomes: Sequence[Outcome]) -> list[str]:
    """Return by scenario the requirements that no run put to the test; and the scenarios without any."""
    found = []
    for outcome in outcomes:
        asked = asked_of(outcome)
        title = one_line(outcome.scenario.title)
        open_ones = [one_line(each.requirement.id) for each in asked if not each.is_tested]
        if not asked:
            found.append(f"{title}: nothing is required of it")
        elif open_ones:
            found.append(f"{title}: {joined(open_ones)}")
    return found
