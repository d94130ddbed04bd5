"""`fcl-sim diff`: what it says of two rule bases, and how it leaves."""

import json

import pytest
from jsonschema import validate

from fcl_sim.diagnostics.page import frame
from fcl_sim.report.schema import json_schema

OLD = frame(complete=True)
NEW = OLD.replace(
    "RULE 3: IF temp IS hot AND level IS low THEN valve IS drain;",
    "RULE 3: IF temp IS hot AND level IS low THEN valve IS inlet;",
)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Stand in a folder with two rule bases."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "old.fcl").write_text(OLD, "utf-8")
    (tmp_path / "new.fcl").write_text(NEW, "utf-8")
    return tmp_path


def test_the_same_law_in_another_text_is_green(invoke, folder):
    (folder / "new.fcl").write_text(
        OLD.replace("RULE 2", "RULE two").replace("AND: MIN;", "(* as ever *) AND: MIN;")
    )
    result = invoke("diff", "old.fcl", "new.fcl")
    assert (result.exit_code, result.stdout) == (0, "valve: the same everywhere\n")


def test_a_difference_is_told_with_its_place_and_the_rules(invoke, folder):
    result = invoke("diff", "old.fcl", "new.fcl")
    assert result.exit_code == 1
    head, place, share, *rules = result.stdout.splitlines()
    assert head == "valve: differs by up to 200"
    assert place == "  there -100 became 100: temp=27 level=0"
    assert share.startswith("  by more than 2 on ")
    assert rules == [
        "  old rule 3, degree 1: IF temp IS hot AND level IS low THEN valve IS drain",
        "  new rule 3, degree 1: IF temp IS hot AND level IS low THEN valve IS inlet",
    ]


def test_what_is_edited_besides_rules_is_told_and_an_output_that_keeps_its_law_is_the_same(invoke, folder):
    more = OLD.replace("valve: REAL;", "valve: REAL; lamp: REAL;")
    more = more.replace(
        "RULEBLOCK No1",
        "DEFUZZIFY lamp TERM on := 1; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY\nRULEBLOCK No1",
    )
    more = more.replace("valve IS inlet;", "valve IS inlet, lamp IS on;")
    (folder / "old.fcl").write_text(more)
    (folder / "new.fcl").write_text(
        more.replace("inlet, lamp", "drain, lamp").replace("TERM inlet := 100", "TERM inlet := 90")
    )
    told = invoke("diff", "old.fcl", "new.fcl").stdout
    assert "lamp: the same everywhere" in told
    assert "edited: valve, TERM inlet := 100 → TERM inlet := 90" in told


def test_a_rule_that_is_the_same_counts_once_where_its_term_has_moved(invoke, folder):
    (folder / "new.fcl").write_text(OLD.replace("TERM inlet := 100", "TERM inlet := 90"))
    _, place, _, *rules = invoke("diff", "old.fcl", "new.fcl").stdout.splitlines()
    assert place == "  there 100 became 90: temp=3 level=0"
    assert rules == [
        "  rule 1, degree 1: IF temp IS cold AND level IS low THEN valve IS inlet",
        "edited: valve, TERM inlet := 100 → TERM inlet := 90",
    ]


def test_another_method_is_told_and_no_rule(invoke, folder):
    (folder / "new.fcl").write_text(OLD.replace("METHOD: CoGS;", "METHOD: LM;"))
    *_, share, edited = invoke("diff", "old.fcl", "new.fcl").stdout.splitlines()
    assert share.startswith("  by more than 2 on ")
    assert edited == "edited: valve, METHOD: CoGS → METHOD: LM"


def test_where_a_difference_is_only_neared_the_place_has_few_digits(invoke, folder):
    gap = OLD.replace("RULE 2: IF level IS high THEN valve IS drain;", "")
    (folder / "new.fcl").write_text(gap)
    _, place, *_ = invoke("diff", "old.fcl", "new.fcl").stdout.splitlines()
    assert place == "  there -98 became 100: temp=3 level=0.99"


def test_a_difference_that_is_allowed_is_green(invoke, folder):
    assert invoke("diff", "old.fcl", "new.fcl", "--delta", "201").exit_code == 0


def test_within_a_universe_the_rest_does_not_count(invoke, folder):
    result = invoke("diff", "old.fcl", "new.fcl", "--universe", "temp=-5..3")
    assert (result.exit_code, result.stdout) == (0, "valve: the same everywhere\n")


def test_json_keeps_its_schema(invoke, folder):
    document = json.loads(invoke("diff", "old.fcl", "new.fcl", "--json").stdout)
    validate(document, json_schema())
    assert document["outputs"][0]["largest"]["witness"] == {"temp": 27.0, "level": 0.0}


def test_other_inputs_are_wrong_usage(invoke, folder):
    (folder / "new.fcl").write_text(NEW.replace("temp", "heat"))
    result = invoke("diff", "old.fcl", "new.fcl")
    assert result.exit_code == 2
    assert (
        "the inputs are not the same: the old one alone has temp, the new one alone has heat" in result.stderr
    )
