"""`fcl-sim conformance` and `fcl-sim check --target`."""

import json

import pytest

from fcl_sim.fcl.conformance_tables import TABLES
from tests.fcl.texts import BATH, changed
from tests.house.places import ROOT

CRANE = ROOT / "scenarios" / "crane" / "crane_printed.fcl"


@pytest.fixture
def bath(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bath.fcl").write_text(BATH)
    return "bath.fcl"


def test_without_a_file_our_own_tables_are_printed(invoke):
    result = invoke("conformance")
    assert (result.exit_code, result.stderr) == (0, "")
    for words in ("Table 8", "Table 9", "Table 10", "Table 11", "S32"):
        assert words in result.stdout
    document = json.loads(invoke("conformance", "--json").stdout)
    assert document["schema"] == 1
    assert {key: len(rows) for key, rows in document["tables"].items()} == {
        **{str(number): len(rows) for number, rows in TABLES.items()},
        "11": 22,
    }


def test_a_file_gets_its_level_its_features_and_its_figures(invoke, bath):
    result = invoke("conformance", bath)
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout.startswith("""\
bath needs the Extension Level

  Table 9: language elements of the Extension Level
    conditional aggregation, OR
      OR by MAX: line 27

  Table 11: data check list, of this function block
    data types of function block inputs and outputs  REAL
    line comments                                    NO
    length of identifiers                            6 (closed)
""")


def test_the_same_as_json(invoke, bath):
    (told,) = json.loads(invoke("conformance", bath, "--json").stdout)["blocks"]
    assert (told["name"], told["level"]) == ("bath", "Extension")
    (feature,) = [each for each in told["features"] if each["level"] == "Extension"]
    assert feature == {
        "level": "Extension",
        "table": 9,
        "element": "conditional aggregation",
        "keyword": "OR",
        "feature": "OR by MAX",
        "lines": [27],
    }
    assert told["data"]["rules"] == 2
    assert told["data"]["data_types"] == ["REAL"]


def test_the_shipped_crane_needs_the_basic_level(invoke):
    assert invoke("conformance", CRANE).stdout.startswith(
        "container_crane needs the Basic Level\n\n  Table 11"
    )


def test_a_file_that_cannot_be_read_is_refused(invoke, bath, tmp_path):
    (tmp_path / bath).write_text(changed(("IS inlet", "IS inlat")))
    result = invoke("conformance", bath)
    assert (result.exit_code, result.stdout) == (3, "")
    assert "error[FCL310]" in result.stderr
    (tmp_path / bath).write_text("(* nothing *)")
    assert "error[FCL" in invoke("conformance", bath).stderr


def test_a_statement_is_printed_by_its_name(invoke, bath):
    result = invoke("conformance", "--target", "concept")
    assert result.exit_code == 0
    assert "AND: MIN, PROD" in result.stdout
    assert "terms per output variable: 9 at most" in result.stdout
    assert invoke("conformance", "--target", "concept", bath).exit_code == 2


def test_check_holds_a_file_against_a_statement(invoke, bath, tmp_path):
    (tmp_path / "plc.toml").write_text('name = "PLC 7"\n[elements]\nOR = []\n')
    result = invoke("check", "--target", "plc.toml", bath)
    assert result.exit_code == 3
    assert "bath.fcl:27:5: error[FCL510]: PLC 7 does not have OR by MAX\n" in result.stdout
    assert "plc.toml:3:1: the target's statement\n" in result.stdout
    assert invoke("check", bath).exit_code == 0
    assert invoke("check", "--target", "jfuzzylogic", bath).exit_code == 0


def test_check_refuses_a_target_that_is_none(invoke, bath):
    result = invoke("check", "--target", "consept", bath)
    assert (result.exit_code, result.stdout) == (3, "")
    assert result.stderr.startswith("error[FCL520]: there is no target `consept`\n")


def test_check_gives_excesses_as_json(invoke, bath, tmp_path):
    (tmp_path / "plc.toml").write_text('name = "PLC 7"\n[elements]\nOR = []\n')
    document = json.loads(invoke("check", "--json", "--target", "plc.toml", bath).stdout)
    assert [each["code"] for each in document["findings"]] == ["FCL510"]
