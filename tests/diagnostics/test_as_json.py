"""Findings for other programs."""

import json

from fcl_sim.diagnostics.as_json import as_json
from tests.diagnostics.findings import ALL, BEHIND_WIDE, OF_FILE, TWICE


def test_the_document_counts_and_lists_all_findings():
    document = as_json(ALL, ["rules/bath.fcl", "rules/bath 2.fcl"])
    assert json.loads(json.dumps(document)) == document
    assert list(document) == ["schema", "files", "counts", "findings"]
    assert document["schema"] == 1
    assert document["counts"] == {"errors": 3, "warnings": 1, "notes": 1}
    assert [each["code"] for each in document["findings"]] == [each.code for each in ALL]


def test_a_finding_says_all_that_is_known():
    (finding,) = as_json([TWICE])["findings"]
    assert finding == {
        "code": "FCL301",
        "title": "a name is declared twice",
        "severity": "warning",
        "message": "`wrong` is declared twice",
        "hint": "give it another name",
        "places": [
            {"file": "rules/bath.fcl", "line": 2, "column": 5, "end_line": 2, "end_column": 10},
            {
                "file": "rules/bath.fcl",
                "line": 1,
                "column": 1,
                "end_line": 1,
                "end_column": 4,
                "label": "first here",
            },
            {"file": "rules/bath.fcl", "line": 4, "column": 1, "end_line": 4, "end_column": 5},
        ],
    }


def test_a_place_without_a_text_has_its_file_alone():
    assert as_json([OF_FILE])["findings"][0]["places"] == [{"file": "rules/bath 2.fcl"}]


def test_columns_count_characters():
    assert as_json([BEHIND_WIDE])["findings"][0]["places"][0]["column"] == len("(* 温S *) ") + 1


def test_without_findings_the_document_says_so():
    assert as_json([], ["bath.fcl"]) == {
        "schema": 1,
        "files": ["bath.fcl"],
        "counts": {"errors": 0, "warnings": 0, "notes": 0},
        "findings": [],
    }
