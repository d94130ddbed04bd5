"""What is not green, as findings: complete, each at its place, and fit for the code hosts that take them."""

import gzip
import json
from dataclasses import replace
from pathlib import Path

import pytest
from sarif_pydantic import Sarif

from fcl_sim.diagnostics import Diagnostic, Place, Source, Span
from fcl_sim.diagnostics.as_sarif import as_sarif
from fcl_sim.diagnostics.render import render
from fcl_sim.judge.baseline import NO_BASELINE
from fcl_sim.judge.verdict import Status
from fcl_sim.report.findings import findings, of_verdict
from tests.report.synthetic import outcome, run, verdict

TEXT = '[[require]]\nid  = "CR-1"\nmax = "35 s"\n'


def placed(judged):
    """Return a verdict whose requirement stands in a text."""
    source = Source("scenarios/crane/transfer.toml", TEXT)
    spans = [Span(source, TEXT.index(each), TEXT.index(each) + len(each)) for each in ('"CR-1"', '"35 s"')]
    return replace(judged, requirement=replace(judged.requirement, span=spans[0], asked=(spans[1],)))


def judged(folder, *verdicts):
    return outcome(folder, run(folder, verdicts=verdicts))


def test_a_verdict_is_told_where_its_requirement_stands_and_where_its_bound_is(tmp_path):
    made = judged(tmp_path, placed(verdict(Status.FAIL, 41.2)))
    (finding,) = findings([made])
    assert render(finding).replace("\N{NO-BREAK SPACE}", " ") == (
        "scenarios/crane/transfer.toml:2:7: error[JDG402]: CR-1 is FAIL in the run `base`: "
        "crane.distance does not settle.\n"
        '  2 | id  = "CR-1"\n'
        "    |       ^^^^^^\n"
        "  scenarios/crane/transfer.toml:3:7: measured 41.2 s\n"
        '  3 | max = "35 s"\n'
        "    |       ^^^^^^"
    )


def test_what_is_green_is_not_told(tmp_path):
    assert list(findings([judged(tmp_path, verdict(), verdict(Status.FAIL, 41.2, expect_fail=True))])) == []


@pytest.mark.parametrize("status", [each for each in Status if each not in {Status.PASS, Status.NO_BASELINE}])
def test_every_other_verdict_has_a_code_of_its_own(tmp_path, status):
    (finding,) = findings([judged(tmp_path, verdict(status, None))])
    assert f" is {status} in the run " in finding.message
    codes = {of_verdict(verdict(each, None), "base", judged(tmp_path).scenario).code for each in (status,)}
    assert codes == {finding.code}


def test_a_run_without_a_baseline_is_told_at_the_scenario_with_what_accepts_it(tmp_path):
    made = outcome(tmp_path, replace(run(tmp_path), compared=NO_BASELINE))
    (finding,) = findings([made])
    assert (finding.code, finding.message) == ("JDG406", "the run `base` has NO BASELINE")
    assert finding.places == (Place(file="transfer.toml"),)
    assert finding.hint.startswith("if that is meant: fcl-sim baseline update ")


def test_a_verdict_without_a_place_is_told_at_its_scenario(tmp_path):
    (finding,) = findings([judged(tmp_path, verdict(Status.FAULT, None))])
    assert finding.places == (Place(file="transfer.toml"),)


LIMITS = {"runs": 20, "rules": 25_000, "results": 25_000, "locations": 1_000, "tags": 20}
PACKED = 10 * 2**20
LONGEST = 1024


def refusals(log):
    """Yield what GitHub's code scanning would refuse of a log; one such result loses the whole upload."""
    if log["version"] != "2.1.0":
        yield "version"
    if len(gzip.compress(json.dumps(log).encode())) > PACKED:
        yield "size"
    if len(log["runs"]) > LIMITS["runs"]:
        yield "runs"
    for each in log["runs"]:
        rules = each["tool"]["driver"]["rules"]
        if len(rules) > LIMITS["rules"] or len(each["results"]) > LIMITS["results"]:
            yield "too much"
        for rule in rules:
            yield from _of_rule(rule)
        for result in each["results"]:
            yield from _of_result(result, rules)


def _of_rule(rule):
    texts = (rule["shortDescription"]["text"], rule["fullDescription"]["text"], rule["help"]["text"])
    if not all(texts) or max(map(len, texts[:2])) > LONGEST or len(rule["id"]) > 255:
        yield f"{rule['id']}: texts"
    if len(rule["properties"]["tags"]) > LIMITS["tags"]:
        yield f"{rule['id']}: tags"


def _of_result(result, rules):
    if not result["message"]["text"]:
        yield "a result without a message"
    if rules[result["ruleIndex"]]["id"] != result["ruleId"]:
        yield "a rule that is another"
    if not result.get("partialFingerprints", {}).get("primaryLocationLineHash"):
        yield "no fingerprint"
    locations = result.get("locations", ())
    if not 1 <= len(locations) <= LIMITS["locations"]:
        yield "no location"
    for location in locations:
        physical = location.get("physicalLocation", {})
        uri = physical.get("artifactLocation", {}).get("uri", "")
        if not uri or ("://" in uri and not uri.startswith("file:")):
            yield f"uri `{uri}`"
        region = physical.get("region", {})
        if min(region.get(key, 0) for key in ("startLine", "startColumn", "endLine", "endColumn")) < 1:
            yield "no region"


def test_code_scanning_takes_everything_that_a_run_can_leave(tmp_path):
    every = [verdict(each, None) for each in Status if each is not Status.PASS]
    every[-1] = placed(verdict(Status.FAIL, 41.2))
    made = outcome(
        tmp_path,
        replace(run(tmp_path, verdicts=tuple(every)), compared=NO_BASELINE),
        run(tmp_path, "fault", "fault"),
    )
    nowhere = Diagnostic(code="PLT301", message="it fails").within("scenarios/crane/transfer.toml")
    log = as_sarif([nowhere, *findings([made])], "1.0", tmp_path)
    Sarif.model_validate(log)
    assert list(refusals(log)) == []
    assert len(log["runs"][0]["results"]) == 8


def test_the_checks_of_code_scanning_can_fail():
    log = as_sarif([Diagnostic(code="RUN101", message="nowhere")], "1.0", Path())
    assert list(refusals(log)) == ["no location"]
