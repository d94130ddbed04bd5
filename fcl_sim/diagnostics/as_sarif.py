"""Findings as a SARIF 2.1.0 log, as code hosts and editors take them."""

import hashlib
import os
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Any
from urllib.parse import quote

from fcl_sim.diagnostics.codes import CODES
from fcl_sim.diagnostics.diagnostic import Diagnostic, Place, Severity
from fcl_sim.diagnostics.page import family, page
from fcl_sim.diagnostics.page_text import page_markdown, page_text
from fcl_sim.diagnostics.source import Span

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
VERSION = "2.1.0"
ROOT = "%SRCROOT%"
LEVELS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "note"}
BEGINNING = {"startLine": 1, "startColumn": 1, "endLine": 1, "endColumn": 1}

Seen = Counter[tuple[str, str]]
"""How often each line of each file has had a finding of one code."""


def as_sarif(findings: Iterable[Diagnostic], version: str, root: Path) -> dict[str, Any]:
    """Return a log for `json.dumps`, with one run of fcl-sim in its `version`.

    Files below `root` are named relative to it. Columns count UTF-16 code
    units, as SARIF's consumers do. A finding keeps its fingerprint when lines
    are added above it. A finding about a whole file stands at its beginning,
    for code hosts want a line.
    """
    listed = list(findings)
    codes = sorted({each.code for each in listed})
    seen: Seen = Counter()
    driver = {
        "name": "fcl-sim",
        "version": version,
        "rules": [_rule(code) for code in codes],
    }
    return {
        "$schema": SCHEMA,
        "version": VERSION,
        "runs": [
            {
                "tool": {"driver": driver},
                "columnKind": "utf16CodeUnits",
                "results": [_result(each, codes.index(each.code), root, seen) for each in listed],
            }
        ],
    }


def _rule(code: str) -> dict[str, Any]:
    told = page(code)
    return {
        "id": code,
        "shortDescription": {"text": CODES[code]},
        "fullDescription": {"text": f"{told.means} {told.why}"},
        "help": {"text": page_text(told), "markdown": page_markdown(told)},
        "defaultConfiguration": {"level": LEVELS[told.severity]},
        "properties": {"tags": [family(code)]},
    }


def _result(diagnostic: Diagnostic, index: int, root: Path, seen: Seen) -> dict[str, Any]:
    hint = f"\nHint: {diagnostic.hint}" if diagnostic.hint else ""
    first, *others = diagnostic.places or (Place(),)
    result: dict[str, Any] = {
        "ruleId": diagnostic.code,
        "ruleIndex": index,
        "level": LEVELS[diagnostic.severity],
        "message": {"text": diagnostic.message + hint},
        "partialFingerprints": {"primaryLocationLineHash": _fingerprint(diagnostic, first, seen)},
    }
    if first.name:
        result["locations"] = [_location(first, root)]
    if others:
        result["relatedLocations"] = [
            _location(each, root) | {"id": number, "message": {"text": each.label or "also here"}}
            for number, each in enumerate(others, start=1)
        ]
    return result


def _location(place: Place, root: Path) -> dict[str, Any]:
    region = BEGINNING if place.span is None else _region(place.span)
    return {"physicalLocation": {"artifactLocation": _artifact(place.name, root), "region": dict(region)}}


def _artifact(name: str, root: Path) -> dict[str, str]:
    whole = Path(os.path.abspath(name))  # noqa: PTH100  a link is not followed: the checkout has it where it is
    if not whole.is_relative_to(root):
        return {"uri": whole.as_uri()}
    relative = whole.relative_to(root).as_posix()
    return {"uri": quote(os.fsencode(relative)), "uriBaseId": ROOT}


def _region(span: Span) -> dict[str, int]:
    end = span.behind
    return {
        "startLine": span.line,
        "startColumn": _column(span),
        "endLine": end.line,
        "endColumn": _column(end),
    }


def _column(span: Span) -> int:
    """Return the column of the first character, from 1, in UTF-16 code units."""
    start = span.source.line_starts[span.line - 1]
    before = span.source.text[start : span.start]
    return len(before) + sum(each > "\uffff" for each in before) + 1


def _fingerprint(diagnostic: Diagnostic, place: Place, seen: Seen) -> str:
    """Return what a finding is known by within its file, wherever its line moves, and a running number."""
    line = place.span.source.line_text(place.span.line).strip() if place.span else ""
    told = f"{diagnostic.code} {line}".encode("utf-8", "surrogatepass")
    digest = hashlib.sha256(told).hexdigest()[:16]
    seen[place.name, digest] += 1
    return f"{digest}:{seen[place.name, digest]}"
