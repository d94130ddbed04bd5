"""Rule bases in words: what is found in them, and which level of the standard they need."""

from itertools import groupby
from typing import Any

from fcl_sim.diagnostics import Diagnostic
from fcl_sim.fcl.conformance_features import features, level
from fcl_sim.fcl.conformance_text import lines_of
from fcl_sim.model import FunctionBlock
from fcl_sim.report.proved import Proved
from fcl_sim.report.words import counted, joined, one_line

Data = dict[str, Any]

MOST_LINES = 6
"""Lines of a text that are listed; of more, their number is told."""


def finding_rows(proved: Proved | None) -> list[Data] | None:
    """Return what is found in a rule base, a row each; None where nobody looked."""
    return None if proved is None else [_finding(each) for each in proved.findings]


def _finding(found: Diagnostic) -> Data:
    spans = [each.span for each in found.places if each.span is not None]
    return {
        "severity": str(found.severity),
        "code": found.code,
        "line": str(spans[0].line) if spans else "",
        "message": one_line(found.message),
        "hint": one_line(found.hint),
    }


def conformance(block: FunctionBlock) -> list[str]:
    """Return the level of IEC 61131-7 that a rule base needs, and what it has beyond the Basic Level."""
    told = [f"{level(block)} Level of IEC 61131-7"]
    beyond = [each for each in features(block) if str(each.row.level) != "Basic"]
    for words, group in groupby(beyond, key=lambda each: f"{each.words}, {each.row.level} Level"):
        lines = [number for each in group for number in lines_of(each.places)]
        where = joined([str(each) for each in lines[:MOST_LINES]])
        more = f" and {counted(len(lines) - MOST_LINES, 'more line')}" if len(lines) > MOST_LINES else ""
        told.append(f"{words}: line{'s' if len(lines) > 1 else ''} {where}{more}" if lines else words)
    return told
