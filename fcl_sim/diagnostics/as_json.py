"""Findings as a JSON document, for other programs."""

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Any

from fcl_sim.diagnostics.codes import CODES
from fcl_sim.diagnostics.diagnostic import Diagnostic, Place, Severity

SCHEMA = 1


def as_json(findings: Iterable[Diagnostic], files: Sequence[str] = ()) -> dict[str, Any]:
    """Return a document for `json.dumps`: the files that were looked at, counts, and every finding.

    Lines and columns count from 1, columns in characters; the end lies behind
    the last character. A place in a file that was not read has its file alone.
    """
    listed = list(findings)
    counts = Counter(each.severity for each in listed)
    return {
        "schema": SCHEMA,
        "files": list(files),
        "counts": {f"{severity}s": counts[severity] for severity in Severity},
        "findings": [_finding(each) for each in listed],
    }


def _finding(diagnostic: Diagnostic) -> dict[str, Any]:
    return {
        "code": diagnostic.code,
        "title": CODES[diagnostic.code],
        "severity": str(diagnostic.severity),
        "message": diagnostic.message,
        "hint": diagnostic.hint,
        "places": [_place(each) for each in diagnostic.places],
    }


def _place(place: Place) -> dict[str, Any]:
    told: dict[str, Any] = {"file": place.name}
    if place.span is not None:
        end = place.span.behind
        told |= {
            "line": place.span.line,
            "column": place.span.column,
            "end_line": end.line,
            "end_column": end.column,
        }
    return told | ({"label": place.label} if place.label else {})
