"""What `fcl-sim run` leaves for build servers."""

import json
import re

import pytest
from jsonschema import Draft202012Validator
from junitparser import JUnitXml
from sarif_pydantic import Sarif

from fcl_sim.cli.program import COMMANDS
from tests.cli.test_documentation import options_of
from tests.house.places import ROOT


@pytest.fixture
def missing(bench):
    """The bench, whose one requirement is missed; it has a baseline of that."""
    short = bench / "scenarios" / "crane" / "short.toml"
    short.write_text(short.read_text().replace('max = "9 deg"', 'max = "0.001 deg"'))
    return bench


def test_every_file_that_is_named_is_written_into_folders_that_are_made(invoke, missing):
    result = invoke(
        "run",
        "--no-report",
        "--junit",
        "out/junit.xml",
        "--sarif",
        "out/x.sarif",
        "--summary",
        "out/summary.md",
    )
    assert result.exit_code == 1
    assert [line for line in result.stdout.splitlines() if line.startswith("written: ")] == [
        "written: out/junit.xml",
        "written: out/x.sarif",
        "written: out/summary.md",
    ]
    assert JUnitXml.fromfile("out/junit.xml").failures >= 1
    log = json.loads((missing / "out/x.sarif").read_text("utf-8"))
    Sarif.model_validate(log)
    first = log["runs"][0]["results"][0]
    assert first["ruleId"] == "JDG402"
    location = first["locations"][0]["physicalLocation"]
    assert location["artifactLocation"]["uri"] == "scenarios/crane/short.toml"
    assert location["region"]["startLine"] == 14
    assert (missing / "out/summary.md").read_text("utf-8").startswith("## fcl-sim: FAIL\n")


ANNOTATION = (
    "::error file=scenarios/crane/short.toml,line=14,endLine=14,col=6,endColumn=10,"
    "title=JDG402 a requirement is not met::S-1 is FAIL in the run `base`: "
)


def test_annotations_are_printed_where_they_are_asked_for(invoke, missing):
    assert "::error" not in invoke("run", "--no-report").stderr
    assert ANNOTATION in invoke("run", "--no-report", "--format", "github").stderr


def test_on_github_they_come_by_themselves_and_so_does_the_page_of_the_job(invoke, missing, monkeypatch):
    page = missing / "summary.md"
    page.write_text("# before\n")
    monkeypatch.setenv("GITHUB_ACTIONS", "true")
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(page))
    monkeypatch.setenv("GITHUB_WORKSPACE", str(missing.parent))
    result = invoke("run", "--no-report")
    assert ANNOTATION.replace("file=", f"file={missing.name}/") in result.stderr
    assert page.read_text("utf-8").startswith("# before\n## fcl-sim: FAIL\n")
    assert "::error" not in invoke("run", "--no-report", "--format", "text").stderr


def test_a_scenario_that_cannot_be_read_is_told_everywhere(invoke, bench):
    (bench / "scenarios" / "typo.toml").write_text("durasion = 1\n")
    result = invoke("run", "--format", "github", "--junit", "j.xml", "--sarif", "s.json", "--summary", "s.md")
    assert result.exit_code == 3
    assert "::error file=scenarios/typo.toml,line=1," in result.stderr
    assert JUnitXml.fromfile("j.xml").errors >= 1
    codes = {
        each["ruleId"] for each in json.loads((bench / "s.json").read_text("utf-8"))["runs"][0]["results"]
    }
    assert "SCN201" in codes
    assert "input fault" in (bench / "s.md").read_text("utf-8")


def test_a_file_that_cannot_be_written_is_an_input_fault(invoke, bench):
    (bench / "file").touch()
    result = invoke("run", "--no-report", "--junit", "file/junit.xml")
    assert result.exit_code == 3
    assert "error[RUN101]" in result.stderr


DEVIATING = "time [s],distance [m],angle [deg],power [kW]\n0,12,4,1\n1,12,4,23.9\n"
RULES = "scenarios/crane/crane_completed.fcl"
PRINTING = {
    "check": [("scenarios",), ("nothing.fcl",), ("mistaken.fcl",)],
    "conformance": [(), (RULES,)],
    "diff": [(RULES, RULES), (RULES, "scenarios/crane/crane_printed.fcl")],
    "eval": [
        (RULES, "distance=12", "angle=4"),
        (RULES, "distance=12", "angle=4", "--explain"),
        (RULES, "distance=12", "angle=4", "--arithmetic", "REAL"),
    ],
    "explain": [(), ("FCL310",)],
    "judge": [("x.csv", "--with", "scenarios/crane/short.toml")],
    "mutate": [("--rule", "1")],
    "replay": [(RULES, "x.csv", "--absolute", "0.1"), (RULES, "deviating.csv")],
    "run": [("--no-report",)],
}
"""The commands that print JSON, each with calls that make it print what it can."""


def test_every_command_that_prints_json_is_tried():
    found = {name for name in COMMANDS if "--json" in options_of(name)}
    assert found == set(PRINTING)


@pytest.mark.parametrize("name", PRINTING)
def test_every_document_follows_the_schema(invoke, bench, name):
    rules = (bench / RULES).read_text("utf-8")
    (bench / "mistaken.fcl").write_text(rules.replace("IS zero", "IS zeero"))
    if name in {"judge", "replay"}:
        invoke("run", "--no-report", "--trace", "x.csv")
        (bench / "deviating.csv").write_text(DEVIATING)
    check = Draft202012Validator(json.loads(invoke("schema", "results").stdout)).validate
    for arguments in PRINTING[name]:
        check(json.loads(invoke(name, *arguments, "--json").stdout))


def test_so_does_a_run_over_an_envelope_and_it_is_told_everywhere(invoke, bench):
    short = bench / "scenarios" / "crane" / "short.toml"
    vary = '\n[vary]\n"plant.start.position" = ["-25 m", "-1 m"]\n'
    short.write_text(short.read_text().replace('max = "9 deg"', 'max = "0.9 deg"\nover = "points"') + vary)
    result = invoke(
        "run", "--no-report", "--json", "--junit", "j.xml", "--sarif", "s.json", "--summary", "s.md"
    )
    document = json.loads(result.stdout)
    Draft202012Validator(json.loads(invoke("schema", "results").stdout)).validate(document)
    (asked,) = document["scenarios"][0]["variants"][0]["envelope"]["requirements"]
    assert (asked["verdict"], asked["passed"], asked["needed"]) == ("FAIL", 1, 2)
    cases = {case.name: case for suite in JUnitXml.fromfile("j.xml") for case in suite}
    assert not cases["S-1[envelope]"].is_passed
    told = json.loads((bench / "s.json").read_text("utf-8"))["runs"][0]["results"][0]["message"]["text"]
    assert told.startswith(
        "S-1 is FAIL over the envelope of the run `base`: 1 of 2 points meet it; worst at "
    )
    assert "1 verdict over envelopes" in (bench / "s.md").read_text("utf-8")


def test_so_does_a_run_that_left_its_baseline_beside_an_older_rule_base(invoke, bench):
    rules = bench / "scenarios" / "crane" / "crane_completed.fcl"
    (bench / "old.fcl").write_bytes(rules.read_bytes())
    assert invoke("baseline", "update", "--reason", "the first").exit_code == 0
    text = rules.read_text("utf-8")
    rules.write_text(re.sub(r"(TERM pos_high\s*:=\s*)[\d.]+", r"\g<1>20", text))
    assert rules.read_text("utf-8") != text
    check = Draft202012Validator(json.loads(invoke("schema", "results").stdout)).validate
    document = json.loads(invoke("run", "--no-report", "--json", "--against", "old.fcl").stdout)
    check(document)
    (run,) = document["scenarios"][0]["variants"]
    assert run["baseline"]["cause"]["edits"]
    assert document["scenarios"][0]["against"]["variants"]


def test_the_shipped_bench_follows_it_as_well(invoke, monkeypatch):
    monkeypatch.chdir(ROOT)
    check = Draft202012Validator(json.loads(invoke("schema", "results").stdout)).validate
    check(json.loads(invoke("run", "--no-report", "--json").stdout))
