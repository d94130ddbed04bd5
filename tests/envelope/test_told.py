"""Whoever reads results hears of an envelope: the terminal, JSON, JUnit, findings, the exit code."""

import io
import json

import pytest
from jsonschema import Draft202012Validator
from junitparser import JUnitXml
from rich.console import Console

from fcl_sim import testbench
from fcl_sim.cli.doors import Exit
from fcl_sim.cli.regressions import exit_code
from fcl_sim.cli.table import print_envelopes
from fcl_sim.judge.verdict import Status
from fcl_sim.report import job_summary, junit, results, summary
from fcl_sim.report.content import facts_of, report_data
from fcl_sim.report.envelopes import envelope_rows
from fcl_sim.report.findings import findings
from fcl_sim.report.gather import gathered
from fcl_sim.report.requirement_matrix import matrix_rows
from fcl_sim.report.schema import json_schema

VARY = """
[vary]
"plant.parameters.load_mass" = ["10 t", "40 t"]
"plant.start.position"       = ["-60 m", "-20 m"]
"""
NEAR = """
[[require]]
id     = "E-1"
text   = "It has not far to go"
metric = { peak = { signal = "crane.distance" } }
max    = "40 m"
"""


@pytest.fixture
def outcome(written):
    """Return a run whose requirement holds nominally, and at two of four points."""
    return testbench.run(written(VARY, NEAR))


def test_a_row_says_how_many_points_pass_and_where_the_worst_is(outcome):
    (row,) = summary.envelope_rows([outcome])
    assert (row.points, row.passed, str(row.status)) == (4, "2 of 4", "FAIL")
    assert row.worst.endswith("at load_mass = 10 t, position = -60 m")
    assert "1 envelope of 4 points, 2 verdicts: 1 FAIL, 1 PASS" in summary.sentence([outcome])


def test_the_results_have_every_point_and_fit_their_schema(outcome):
    made = json.loads(results.text([outcome]))
    envelope = made["scenarios"][0]["variants"][0]["envelope"]
    schema = json_schema()
    Draft202012Validator({**schema["$defs"]["envelope"], "$defs": schema["$defs"]}).validate(envelope)
    (verdict,) = envelope["requirements"]
    assert verdict["verdicts"] == ["FAIL", "PASS", "FAIL", "PASS"]
    assert len(verdict["values"]) == envelope["points"] == 4
    assert verdict["worst"]["at"] == envelope_point(envelope, verdict["worst"]["point"])


def envelope_point(envelope, index):
    mass, start = envelope["axes"]
    return {mass["key"]: mass["values"][index // 2], start["key"]: start["values"][index % 2]}


def test_a_build_server_sees_an_envelope_that_is_missed(outcome):
    (suite,) = JUnitXml.fromstring(junit.text([outcome]).encode())
    passed = {case.name: case.is_passed for case in suite if case.name.startswith("E-1")}
    assert passed == {"E-1": True, "E-1[envelope]": False}
    finding = next(each for each in findings([outcome]) if "envelope" in each.message)
    assert finding.code == "JDG402"
    told = "E-1 is FAIL over the envelope of the run `base`: 2 of 4 points meet it"
    assert finding.message.startswith(told)
    assert exit_code([outcome]) is Exit.VERDICT


def test_the_report_has_a_table_and_a_picture_of_the_points(outcome):
    pictures = {}

    def register(folder, picture):
        pictures[picture.name] = picture
        return f"{folder}/{picture.name}.svg"

    sections = report_data(gathered([outcome]), register)["scenarios"][0]["sections"]
    section = next(each for each in sections if each["title"] == "Envelope of run base")
    text = section["text"].replace("\N{NO-BREAK SPACE}", " ")
    assert text.startswith("Run base at 4 points, every combination of load_mass = 10 t and 40 t;")
    assert [(row["id"], row["passed"], row["status"]) for row in section["rows"]] == [
        ("E-1", "2 of 4", "FAIL")
    ]
    assert "2 of 4, FAIL. Worst:" in pictures["base-envelope"].alt
    pictures["base-envelope"].draw()
    assert "base-envelope-worst-1" in pictures


def test_an_expected_miss_over_an_envelope_is_called_one_wherever_it_is_told(written):
    missed = NEAR.replace('"40 m"', '"1 m"') + 'expect = "fail"\nat_least = 2\n'
    made = testbench.run(written(VARY, missed))
    (asked,) = envelope_rows(made.base.envelope)
    assert asked["asked"].endswith(", to be missed at 2 of 4 or more")
    (row,) = summary.envelope_rows([made])
    assert (row.status, row.shown) == (Status.PASS, "EXPECTED MISS")
    printed = io.StringIO()
    print_envelopes([row], Console(file=printed, width=200))
    assert " EXPECTED MISS " in printed.getvalue()
    assert "| EXPECTED MISS |" in job_summary.text([made])
    assert junit.text([made]).count("<system-out>EXPECTED MISS: ") == 2


def test_a_threshold_stands_with_the_words_that_give_its_reason(written):
    lowered = NEAR.replace("far to go", "far to go, but for long ways") + "at_least = 2\n"
    (row,) = envelope_rows(testbench.run(written(VARY, lowered)).base.envelope)
    assert row["asked"].endswith(", at 2 of 4 or more")
    assert row["reason"] == "It has not far to go, but for long ways"
    (plain,) = envelope_rows(testbench.run(written(VARY, NEAR)).base.envelope)
    assert plain["reason"] == ""


@pytest.mark.parametrize("over", ["points", "mean"])
def test_in_the_matrix_an_envelope_has_a_dash_before_its_sign_where_the_run_is_not_asked(over, written):
    for asked, dashes in ((NEAR + f'over = "{over}"\n', 1), (NEAR, 0)):
        (table,) = matrix_rows([testbench.run(written(VARY, asked))])
        ((cell,),) = (row["cells"] for row in table["rows"])
        assert len(cell["marks"]) == 2
        assert cell["marks"].count("–") == cell["marks"].startswith("–") == dashes


def test_the_facts_of_a_scenario_tell_at_how_many_points_its_runs_are_judged_or_that_at_none(written):
    for vary, told in ((VARY, "base at 4 points"), ("", "none: each run is judged as it stands")):
        *_, last = facts_of(testbench.run(written(vary, NEAR)))
        assert (last["label"], last["values"]) == ("Envelopes", [told])
