"""`fcl-sim check`: files, folders and patterns, and every form of what is found."""

import json

import pytest
from jsonschema import validate
from sarif_pydantic import Sarif

from fcl_sim.diagnostics.page import frame, framed
from fcl_sim.report.schema import json_schema

BAD = framed("RULE 1: IF temp IS cool THEN valve IS inlet;", "RULE", complete=True)
WARNED = framed("TERM drain := -100;\nTERM inlet := 100;\nMETHOD: CoGS;", "DEFUZZIFY valve", complete=True)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Stand in a folder with a sound, a bad and a warned rule base."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rules" / "old").mkdir(parents=True)
    (tmp_path / "rules" / ".trash").mkdir()
    (tmp_path / "rules" / "sound.fcl").write_text(frame(complete=True), "utf-8")
    (tmp_path / "rules" / "old" / "bad.FCL").write_text(BAD, "utf-8")
    (tmp_path / "rules" / "warned.fcl").write_text(WARNED, "utf-8")
    (tmp_path / "rules" / "notes.txt").write_text("no FCL", "utf-8")
    (tmp_path / "rules" / ".trash" / "hidden.fcl").write_text("no FCL", "utf-8")
    return tmp_path


def test_a_clean_file_is_one_line(invoke, folder):
    result = invoke("check", "rules/sound.fcl")
    assert (result.exit_code, result.stdout, result.stderr) == (0, "rules/sound.fcl: no findings\n", "")


def test_clean_files_are_one_line_together(invoke, folder):
    (folder / "rules" / "second.fcl").write_text(frame(complete=True), "utf-8")
    result = invoke("check", "rules/sound.fcl", "rules/second.fcl", "rules/sound.fcl")
    assert (result.exit_code, result.stdout) == (0, "2 files: no findings\n")


def test_a_folder_is_searched_and_its_findings_counted(invoke, folder):
    result = invoke("check", "rules")
    assert result.exit_code == 3
    assert result.stdout == (
        "rules/old/bad.FCL:32:24: error[FCL310]: `cool` is not a term of `temp`\n"
        "  32 |     RULE 1: IF temp IS cool THEN valve IS inlet;\n"
        "     |                        ^^^^\n"
        "  hint: did you mean `cold`? Valid here: cold or hot\n"
        "rules/warned.fcl:22:11: warning[FCL335]: DEFUZZIFY valve has no DEFAULT: "
        "the output keeps its value while no rule is active (NC)\n"
        "  22 | DEFUZZIFY valve\n"
        "     |           ^^^^^\n"
        "  hint: write `DEFAULT := NC;` or a number\n"
        "3 files: 1 error, 1 warning (fcl-sim explain FCL310 tells more)\n"
    )


def test_warnings_alone_are_green(invoke, folder):
    result = invoke("check", "rules/warned.fcl")
    assert result.exit_code == 0
    assert result.stdout.endswith("rules/warned.fcl: 1 warning (fcl-sim explain FCL335 tells more)\n")


def test_a_pattern_that_the_shell_left_alone_is_filled_in(invoke, folder):
    assert invoke("check", "rules/*.fcl").stdout.endswith(
        "2 files: 1 warning (fcl-sim explain FCL335 tells more)\n"
    )
    assert "bad.FCL" in invoke("check", "**/*.FCL").stdout


def test_a_file_whose_name_looks_like_a_pattern_is_a_file(invoke, folder):
    (folder / "bath[1].fcl").write_text(frame(complete=True), "utf-8")
    assert invoke("check", "bath[1].fcl").stdout == "bath[1].fcl: no findings\n"


def test_a_check_of_nothing_is_not_green(invoke, folder):
    (folder / "empty").mkdir()
    result = invoke("check", "empty", "*.fcl", "rules/sound.fcl", "gone.fcl")
    assert result.exit_code == 3
    assert result.stdout == (
        "empty: error[RUN107]: there is no rule base below this folder\n"
        "  hint: a rule base is a .fcl file\n"
        "*.fcl: error[RUN107]: no file fits this pattern\n"
        "gone.fcl: error[FCL101]: there is no such file\n"
        "2 files: 3 errors (fcl-sim explain RUN107 tells more)\n"
    )


@pytest.mark.parametrize("form", [("--json",), ("--format", "json")])
def test_json_is_one_document(invoke, folder, form):
    result = invoke("check", "rules", *form)
    document = json.loads(result.stdout)
    assert result.exit_code == 3
    assert document["files"] == ["rules/old/bad.FCL", "rules/sound.fcl", "rules/warned.fcl"]
    assert document["counts"] == {"errors": 1, "warnings": 1, "notes": 0}
    assert [each["code"] for each in document["findings"]] == ["FCL310", "FCL335"]


def test_sarif_names_files_relative_to_the_current_folder(invoke, folder):
    result = invoke("check", folder / "rules", "--format", "sarif")
    assert result.exit_code == 3
    log = json.loads(result.stdout)
    Sarif.model_validate(log)
    uris = [
        each["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
        for each in log["runs"][0]["results"]
    ]
    assert uris == ["rules/old/bad.FCL", "rules/warned.fcl"]


def test_annotations_are_one_line_each(invoke, folder):
    result = invoke("check", "rules", "--format", "github")
    first, second, last = result.stdout.splitlines()
    assert first == (
        "::error file=rules/old/bad.FCL,line=32,endLine=32,col=24,endColumn=27,"
        "title=FCL310 a name is not a term of the variable::`cool` is not a term of `temp`"
        "%0Ahint: did you mean `cold`? Valid here: cold or hot"
    )
    assert second.startswith("::warning file=rules/warned.fcl,line=22,")
    assert last == "3 files: 1 error, 1 warning (fcl-sim explain FCL310 tells more)"


def test_clean_files_are_clean_in_every_form(invoke, folder):
    assert invoke("check", "rules/sound.fcl", "--format", "github").stdout == "rules/sound.fcl: no findings\n"
    assert json.loads(invoke("check", "rules/sound.fcl", "--json").stdout)["findings"] == []
    log = json.loads(invoke("check", "rules/sound.fcl", "--format", "sarif").stdout)
    assert log["runs"][0]["results"] == []


def test_an_unknown_form_is_wrong_usage(invoke, folder):
    assert invoke("check", "rules", "--format", "xml").exit_code == 2


GAPS = framed(
    "RULE 1: IF temp IS cold AND level IS low THEN valve IS inlet;\n"
    "RULE 2: IF temp IS cold AND level IS high THEN valve IS drain;\n"
    "RULE 3: IF temp IS hot AND level IS high THEN valve IS drain;",
    "RULE",
    complete=True,
)
"""Undefined where it is hot and the level is low."""


@pytest.fixture
def gaps(tmp_path, monkeypatch):
    """Stand in a folder with a rule base that has a gap."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "gaps.fcl").write_text(GAPS, "utf-8")
    return tmp_path


def test_a_gap_is_told_with_its_share_its_place_and_what_to_do(invoke, gaps):
    result = invoke("check", "gaps.fcl", "--universe", "temp=0..30 degC", "--universe", "level=0..1")
    assert result.exit_code == 0
    assert result.stdout == (
        "gaps.fcl:22:11: warning[FCL601]: `valve` is undefined (DEFAULT 0 is given out) "
        "on edges without area: temp from 27 to 30 degC and level = 0\n"
        "  22 | DEFUZZIFY valve\n"
        "     |           ^^^^^\n"
        "  hint: a rule for `temp IS hot AND level IS low` would help; nearest to firing: rule 3 lacks "
        "`level IS high`, rule 1 lacks `temp IS cold`; see `fcl-sim eval gaps.fcl --exact temp=28 level=0`\n"
        "gaps.fcl: 1 warning (fcl-sim explain FCL601 tells more)\n"
    )


def test_what_a_finding_says_to_evaluate_shows_it(invoke, gaps):
    assert (
        invoke("eval", "gaps.fcl", "temp=28", "level=0").stdout == "valve = 0  (no rule is active: DEFAULT)\n"
    )


def test_the_proof_stands_in_the_json_document_and_keeps_its_schema(invoke, gaps):
    result = invoke(
        "check", "gaps.fcl", "--universe", "temp=0..30", "--universe", "level=-1..1", "--json", "--law"
    )
    document = json.loads(result.stdout)
    validate(document, json_schema())
    (only,) = document["findings"]
    assert only["proof"]["share_exact"] == "1/20"
    assert only["proof"]["boxes"] == [
        {
            "temp": {"low": 27.0, "high": 30.0, "low_closed": True, "high_closed": True},
            "level": {"low": -1.0, "high": 0.0, "low_closed": True, "high_closed": True},
        }
    ]
    assert [each["output"] for each in document["laws"][0]["outputs"]] == ["valve"]


def test_a_coupling_takes_a_gap_away(invoke, gaps):
    assert "FCL601" in invoke("check", "gaps.fcl").stdout
    result = invoke("check", "gaps.fcl", "--assume", "temp <= 20")
    assert result.stdout == "gaps.fcl: no findings\n"


@pytest.mark.parametrize(
    ("option", "text", "told"),
    [
        ("--universe", "tmp=0..1", "bath has no input 'tmp': did you mean temp?"),
        (
            "--universe",
            "temp=0",
            "'temp=0' is not NAME=LOW..HIGH, such as distance=-10..30 or 'distance=-10..30 m'",
        ),
        ("--universe", "temp=3..1", "'temp=3..1' goes from 3 to 1: the first is to be the lower one"),
        (
            "--universe",
            "temp=0,5..1",
            "'0,5' in 'temp=0,5..1' is not a number: the decimal separator is a point",
        ),
        (
            "--assume",
            "temp + level",
            "'temp + level' has none of =, <= and >=, as in 'brown + light + dark = 1'",
        ),
        (
            "--assume",
            "temp * level = 1",
            "'temp * level = 1' is no sum of inputs, such as 'brown + 2*light + dark = 1'",
        ),
        ("--epsilon", "0.9", "Invalid value for '--epsilon': 0.9 is not in the range 0.0<=x<=0.5."),
    ],
)
def test_what_says_no_universe_is_wrong_usage(invoke, gaps, option, text, told):
    result = invoke("check", "gaps.fcl", option, text)
    assert result.exit_code == 2
    assert result.stderr.endswith(f"Error: {told}\n")


def test_an_input_that_some_file_has_may_be_bounded_for_all(invoke, gaps):
    other = GAPS.replace("temp", "heat").replace("bath", "tub")
    (gaps / "other.fcl").write_text(other, "utf-8")
    result = invoke("check", "gaps.fcl", "other.fcl", "--universe", "heat=0..30")
    assert result.exit_code == 0
    assert "heat from 27 to 30 and level up to 0" in result.stdout
    assert "temp from 27 on and level up to 0" in result.stdout
