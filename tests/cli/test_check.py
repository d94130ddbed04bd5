"""`fcl-sim check`: files, folders and patterns, and every form of what is found."""

import json

import pytest
from sarif_pydantic import Sarif

from fcl_sim.diagnostics.page import frame, framed

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
