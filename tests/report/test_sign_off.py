"""What is signed: git, assumptions with what else was run, waivers, every requirement in every run."""

import subprocess
from dataclasses import replace
from datetime import date

import pytest

from fcl_sim.diagnostics import Source, Span
from fcl_sim.judge.verdict import Status
from fcl_sim.report.archive import Stored
from fcl_sim.report.proved import Proved, proved
from fcl_sim.report.provenance import EPOCH, InputFile, Origin
from fcl_sim.report.requirement_matrix import legend, matrix_rows, untested
from fcl_sim.report.sign_off import assumptions, revisions, sign_off
from fcl_sim.scenario.revision import Revision, revision_of
from fcl_sim.verify.waivers import Waiver
from tests.report.synthetic import crane, outcome, run, verdict


def git(folder, *arguments):
    subprocess.run(["git", "-C", str(folder), *arguments], check=True, capture_output=True)  # noqa: S607


@pytest.fixture
def repository(tmp_path):
    git(tmp_path, "init")
    git(tmp_path, "config", "user.email", "a@example.org")
    git(tmp_path, "config", "user.name", "a")
    (tmp_path / "a.fcl").write_text("one")
    git(tmp_path, "add", "a.fcl")
    git(tmp_path, "commit", "-m", "first")
    return tmp_path


def told(revision: Revision) -> str:
    ((first,),) = ([*revisions(Origin(date=EPOCH, revisions=(revision,)))],)
    return " ".join(first["values"])


def test_a_clean_tree_is_told_with_its_revision(repository):
    found = revision_of(repository)
    assert found.is_clean
    assert len(found.commit) == 40
    assert told(found) == (
        f"{found.commit} The working tree was clean: every file is as it is in that revision."
    )


def test_changed_and_unknown_files_are_named(repository):
    (repository / "a.fcl").write_text("two")
    (repository / "b µ.fcl").write_text("new")
    found = revision_of(repository)
    assert found.changed == ("a.fcl", "b µ.fcl")
    assert "not clean: 2 files are not as in that revision: a.fcl and b µ.fcl." in told(found)


def test_a_bench_outside_of_git_says_so(tmp_path, monkeypatch):
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    assert told(revision_of(tmp_path)) == "none: the bench is not under version control"


def test_assumptions_are_told_with_what_else_was_run(tmp_path):
    base = run(tmp_path)
    light = replace(base.diagram.plant, parameters={"load_mass": 10.0})
    other = replace(run(tmp_path, "light"), diagram=replace(base.diagram, plant=light))
    (found,) = assumptions([base, other])
    assert (found["plant"], found["name"], found["value"]) == ("crane", "load_mass", "20\N{NO-BREAK SPACE}t")
    assert found["others"] == "10\N{NO-BREAK SPACE}t"


def test_waivers_of_coverage_and_of_findings_are_told(tmp_path):
    span = Span(Source("waivers", "x"), 0, 1)
    waiver = Waiver(
        rule_base=tmp_path, what="FCL608", rule="too_far", reason="later", date=date(2026, 3, 1), span=span
    )
    proof = Proved(name="crane", file="crane.fcl", findings=(), waivers=(waiver,))
    stored = Stored(outcomes=(), covered=(), proofs=(proof,), stories=(), origin=Origin(date=EPOCH))
    found = sign_off(stored)["waivers"]
    assert found == [
        {
            "rule_base": "crane in crane.fcl",
            "what": "FCL608 of too_far",
            "reason": "later",
            "date": "2026-03-01",
        }
    ]


def test_what_is_found_and_what_is_waived_is_told_of_a_rule_base(tmp_path):
    path = tmp_path / "crane.fcl"
    file = InputFile(role="rule base", name="crane.fcl", path=path, digest="")
    found = proved(crane(), file)
    assert [each.code for each in found.findings] == ["FCL601", "FCL608", "FCL608", "FCL609"]
    stored = Stored(outcomes=(), covered=(), proofs=(found,), stories=(), origin=Origin(date=EPOCH))
    told = [(each["rule_base"], each["code"], each["what"]) for each in sign_off(stored)["open"]]
    of = f"{found.name} in crane.fcl"
    assert told == [
        (of, "FCL601", "An output is undefined where no rule fires"),
        (of, "FCL608", "No rule asks for a term, 2 times"),
        (of, "FCL609", "No rule concludes a term"),
    ]
    (tmp_path / "crane.waivers.toml").write_text(
        '[[waive]]\nwhat = "FCL609"\nrule = "neg_high"\nreason = "not needed"\ndate = 2026-03-01\n'
    )
    found = proved(crane(), file)
    assert "FCL609" not in [each.code for each in found.findings]
    assert [each.reason for each in found.waivers] == ["not needed"]


def test_the_matrix_has_a_sign_for_every_requirement_in_every_run(tmp_path):
    second = run(tmp_path, "raw", "swings")
    (table,) = matrix_rows([outcome(tmp_path, run(tmp_path), second)])
    assert table["runs"] == ["base", "raw"]
    signs = {row["id"]: [cell["marks"] for cell in row["cells"]] for row in table["rows"]}
    assert signs == {"CR-1": ["●", "○"], "CR-2": ["●", ""]}
    assert {sign for row in signs.values() for sign in row if sign} <= {each["sign"] for each in legend()}


def test_what_no_run_has_tested_is_named(tmp_path):
    never = run(tmp_path, verdicts=(verdict(Status.UNTESTED, None), verdict(id="CR-2")))
    assert untested([outcome(tmp_path, never, title="Crane")]) == ["Crane: CR-1"]
    tested = run(tmp_path, "more")
    assert untested([outcome(tmp_path, never, tested, title="Crane")]) == []
