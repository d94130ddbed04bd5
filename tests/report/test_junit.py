"""The verdicts as JUnit XML, read back as build servers do."""

import re
from dataclasses import replace

import pytest
from junitparser import Error, Failure, JUnitXml, Properties

from fcl_sim.diagnostics import Diagnostic, Place, Severity, Source, Span
from fcl_sim.judge.baseline import NO_BASELINE
from fcl_sim.judge.verdict import Status
from fcl_sim.report.junit import text
from tests.report.synthetic import EVIL, outcome, run, verdict


def read(*outcomes, faults=()):
    return JUnitXml.fromstring(text(outcomes, faults).encode())


def cases(document):
    return [(case.classname, case.name, case) for suite in document for case in suite]


def properties(owner):
    return {each.name: each.value for each in owner.child(Properties)}


def test_a_run_is_a_suite_and_a_requirement_a_case(tmp_path):
    made = outcome(tmp_path, run(tmp_path), run(tmp_path, "raw_distance", "swings"))
    document = read(made)
    assert [suite.name for suite in document] == ["crane/transfer.base", "crane/transfer.raw_distance"]
    assert [(classname, name) for classname, name, _ in cases(document)] == [
        ("crane/transfer.base", "CR-1"),
        ("crane/transfer.base", "CR-2"),
        ("crane/transfer.raw_distance", "CR-1"),
    ]
    assert all(case.is_passed for *_, case in cases(document))


@pytest.mark.parametrize("status", [each for each in Status if each is not Status.PASS])
def test_what_is_not_green_is_red_on_every_server(tmp_path, status):
    document = (
        read(outcome(tmp_path, run(tmp_path, verdicts=(verdict(status, None),))))
        if status is not (Status.NO_BASELINE)
        else read(outcome(tmp_path, replace(run(tmp_path), compared=NO_BASELINE)))
    )
    ((result,),) = [case.result for *_, case in cases(document) if not case.is_passed]
    assert isinstance(result, Error if status is Status.FAULT else Failure)
    assert result.type == status
    assert str(status) in result.message


def test_the_counts_are_those_of_the_cases(tmp_path):
    made = outcome(
        tmp_path,
        run(tmp_path, verdicts=(verdict(), verdict(Status.FAIL, 41.2), verdict(Status.UNTESTED, None))),
        run(tmp_path, "fault", "fault"),
    )
    document = read(made)
    counted = [(suite.tests, suite.failures, suite.errors, suite.skipped) for suite in document]
    assert counted == [(3, 2, 0, 0), (1, 0, 1, 0)]
    assert (document.tests, document.failures, document.errors, document.skipped) == (4, 2, 1, 0)
    assert [suite.time for suite in document] == [0.1, 0.1]


def test_the_figure_and_what_is_asked_are_properties(tmp_path):
    judged = verdict(Status.FAIL, 41.25, minimum=1.0)
    ((*_, case),) = cases(read(outcome(tmp_path, run(tmp_path, verdicts=(judged,)))))
    told = properties(case)
    assert {name: float(told[name]) for name in ("value", "min", "max", "violated_from", "violated_to")} == {
        "value": 41.25,
        "min": 1.0,
        "max": 35.0,
        "violated_from": 35.0,
        "violated_to": 60.0,
    }
    assert (told["metric"], told["signal"], told["unit"]) == ("settling_time", "crane.distance", "s")


def test_an_expected_miss_passes_and_says_so(tmp_path):
    judged = verdict(Status.FAIL, 41.2, expect_fail=True)
    ((*_, case),) = cases(read(outcome(tmp_path, run(tmp_path, verdicts=(judged,)))))
    assert case.is_passed
    assert properties(case)["expect"] == "fail"
    assert case.system_out.startswith("EXPECTED MISS: ")


def test_what_could_not_be_run_is_an_error_at_its_place(tmp_path):
    source = Source("scenarios/typo.toml", "durasion = 1\n")
    fault = Diagnostic(code="SCN201", message="no key `durasion`", places=(Place(Span(source, 0, 8)),))
    warning = Diagnostic(code="FCL304", message="two spellings", severity=Severity.WARNING)
    ((classname, name, case),) = cases(read(faults=[fault, warning]))
    assert (classname, name) == ("scenarios/typo.toml", "no key `durasion`")
    assert case.result[0].type == "SCN201"
    assert "durasion = 1" in case.result[0].text
    assert 'file="scenarios/typo.toml" line="1"' in text([], [fault])


def test_no_name_breaks_the_document(tmp_path):
    evil = f"{EVIL}\x00\x1b]]>\ud800"
    judged = verdict(Status.FAIL, 41.2, id=evil, text=evil)
    made = outcome(tmp_path, run(tmp_path, verdicts=(judged,), title=evil), name=evil, title=evil)
    ((_, name, _),) = cases(read(made))
    assert name.startswith("#panic(1) $x$ <script>")


def test_the_same_outcomes_give_the_same_text(tmp_path):
    made = outcome(tmp_path, run(tmp_path))
    assert text([made]) == text([made])
    assert not re.search(r"\d{4}-\d\d-\d\d", text([made]))
