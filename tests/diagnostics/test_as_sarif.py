"""Findings as code hosts and editors read them: SARIF 2.1.0, and what GitHub asks for beyond it."""

import json
from pathlib import Path, PurePosixPath
from urllib.parse import unquote

import pytest
from sarif_pydantic import Sarif

from fcl_sim.diagnostics import Diagnostic, Place, Source, Span
from fcl_sim.diagnostics.as_sarif import as_sarif
from fcl_sim.diagnostics.codes import CODES
from tests.diagnostics.findings import ALL, BEHIND_WIDE, OF_FILE, ONE, TWICE

ROOT = Path.cwd()


def run_of(*findings, root=ROOT):
    """Return the one run of a log, once the log has been held against the standard's schema."""
    log = json.loads(json.dumps(as_sarif(findings, "1.2.3", root)))
    Sarif.model_validate(log)
    assert log["version"] == "2.1.0"
    assert log["$schema"].endswith("sarif-2.1.0.json")
    (run,) = log["runs"]
    return run


def location(result):
    return result["locations"][0]["physicalLocation"]


def test_the_tool_says_its_name_version_and_rules():
    driver = run_of(*ALL)["tool"]["driver"]
    assert (driver["name"], driver["version"]) == ("fcl-sim", "1.2.3")
    assert [rule["id"] for rule in driver["rules"]] == sorted({each.code for each in ALL})


@pytest.mark.parametrize("code", CODES)
def test_every_code_makes_a_rule_with_all_that_a_code_host_shows(code):
    (rule,) = run_of(Diagnostic(code=code, message="x"))["tool"]["driver"]["rules"]
    assert rule["shortDescription"]["text"] == CODES[code]
    assert len(rule["fullDescription"]["text"]) <= 1024
    assert "Mended:" in rule["help"]["text"]
    assert "```" in rule["help"]["markdown"]
    assert rule["defaultConfiguration"]["level"] in {"error", "warning", "note"}


def test_a_result_points_at_its_rule_and_has_the_level_of_the_finding():
    run = run_of(*ALL)
    rules = run["tool"]["driver"]["rules"]
    for result, finding in zip(run["results"], ALL, strict=True):
        assert result["ruleId"] == finding.code == rules[result["ruleIndex"]]["id"]
        assert result["level"] == str(finding.severity)
        assert finding.message in result["message"]["text"]


def test_the_hint_stands_in_the_message():
    (result,) = run_of(TWICE)["results"]
    assert result["message"]["text"] == "`wrong` is declared twice\nHint: give it another name"


def test_files_below_the_root_are_relative_and_encoded():
    (result,) = run_of(OF_FILE)["results"]
    assert location(result)["artifactLocation"] == {"uri": "rules/bath%202.fcl", "uriBaseId": "%SRCROOT%"}


def test_a_finding_about_a_whole_file_stands_at_its_beginning():
    (result,) = run_of(OF_FILE)["results"]
    assert location(result)["region"] == {"startLine": 1, "startColumn": 1, "endLine": 1, "endColumn": 1}


def test_relative_names_are_of_the_current_folder_and_uris_of_the_root(tmp_path, monkeypatch):
    folder = tmp_path / "checkout" / "bench"
    folder.mkdir(parents=True)
    monkeypatch.chdir(folder)
    (result,) = run_of(OF_FILE, root=tmp_path / "checkout")["results"]
    assert location(result)["artifactLocation"]["uri"] == "bench/rules/bath%202.fcl"


@pytest.mark.parametrize("name", ["bath.fcl", "./a/../bath.fcl", "größe #1?.fcl", "100%.fcl", "\udcff.fcl"])
def test_a_relative_uri_leads_back_to_the_file(name):
    (result,) = run_of(Diagnostic(code="FCL101", message="x", places=(Place(file=name),)))["results"]
    uri = location(result)["artifactLocation"]["uri"]
    assert not PurePosixPath(uri).is_absolute()
    assert ":" not in uri
    assert ROOT / unquote(uri, errors="surrogateescape") == Path(ROOT / name).resolve()


def test_an_absolute_name_below_the_root_is_relative_and_one_elsewhere_is_not(tmp_path):
    inside, outside = tmp_path / "root" / "bath.fcl", tmp_path / "bath.fcl"
    findings = [
        Diagnostic(code="FCL101", message="x", places=(Place(file=str(each)),)) for each in (inside, outside)
    ]
    results = run_of(*findings, root=tmp_path / "root")["results"]
    assert [location(each)["artifactLocation"]["uri"] for each in results] == ["bath.fcl", outside.as_uri()]


def test_regions_count_from_one_and_end_behind_the_last_character():
    (result,) = run_of(ONE)["results"]
    assert location(result)["region"] == {"startLine": 1, "startColumn": 5, "endLine": 1, "endColumn": 10}


def test_columns_count_utf16_code_units():
    run = run_of(BEHIND_WIDE)
    assert run["columnKind"] == "utf16CodeUnits"
    before = "(* 温\U0001f6bf *) "
    region = location(run["results"][0])["region"]
    assert region["startColumn"] == len(before.encode("utf-16-le")) // 2 + 1 == 11
    assert region["endColumn"] == region["startColumn"] + len("three")


def test_an_empty_text_has_a_region():
    empty = Diagnostic(code="FCL205", message="x", places=(Place(Span(Source("a.fcl", ""), 0, 0)),))
    (result,) = run_of(empty)["results"]
    assert location(result)["region"] == {"startLine": 1, "startColumn": 1, "endLine": 1, "endColumn": 1}


def test_further_places_are_related_with_their_remark():
    (result,) = run_of(TWICE)["results"]
    told = [
        (each["id"], each["message"]["text"], each["physicalLocation"]["region"]["startLine"])
        for each in result["relatedLocations"]
    ]
    assert told == [(1, "first here", 1), (2, "also here", 4)]


def fingerprints(text, name="a.fcl"):
    source = Source(name, text)
    starts = [at for at in range(len(text)) if text.startswith("wrong", at)]
    findings = [
        Diagnostic(code="FCL302", message="x", places=(Place(Span(source, at, at + 5)),)) for at in starts
    ]
    return [each["partialFingerprints"]["primaryLocationLineHash"] for each in run_of(*findings)["results"]]


def test_a_finding_keeps_its_fingerprint_when_lines_move():
    before = fingerprints("IF wrong\nIF also wrong\n")
    assert fingerprints("\n\nIF other\n  IF wrong\nIF also wrong\n") == before
    assert fingerprints("IF also wrong\n") == before[1:]


def test_findings_in_equal_lines_have_fingerprints_of_their_own():
    prints = fingerprints("IF wrong\nIF wrong\n")
    assert len(set(prints)) == 2
    assert prints[0].endswith(":1")
    assert prints[1].endswith(":2")


def test_without_findings_there_is_a_run_without_results():
    run = run_of()
    assert run["results"] == run["tool"]["driver"]["rules"] == []
