"""`fcl-sim check --scenario`: inputs go as far as a scenario declares, or as its blocks let them."""

import shutil

import pytest

from tests.house.places import ROOT

CONTROLLER = "scenarios/crane/printed.controller.toml"
UNITS = 'units  = { distance = "m", angle = "deg", power = "kW" }'
RANGES = 'ranges = { distance = ["-10 m", "30 m"], ANGLE = ["-90 deg", "90 deg"] }'
FILE = "scenarios/crane/crane_printed.fcl"
SCENARIO = "scenarios/crane/printed.toml"


@pytest.fixture
def crane(tmp_path, monkeypatch):
    """Stand in a bench with the printed crane."""
    shutil.copytree(ROOT / "scenarios" / "crane", tmp_path / "scenarios" / "crane")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def declare(crane, ranges):
    file = crane / CONTROLLER
    text = file.read_text("utf-8")
    assert UNITS in text
    file.write_text(text.replace(UNITS, f"{UNITS}\n{ranges}"), "utf-8")


def test_declared_ranges_are_the_universe_with_their_units(invoke, crane):
    declare(crane, RANGES)
    result = invoke("check", FILE, "--scenario", SCENARIO)
    assert (result.exit_code, result.stderr) == (0, "")
    assert "in 62.15 % of the universe: distance from 10 to 30 m and angle from 5 to 90 deg" in result.stdout


def test_an_option_goes_before_the_scenario(invoke, crane):
    declare(crane, RANGES)
    result = invoke("check", FILE, "--scenario", SCENARIO, "--universe", "angle=0..1")
    assert "62.15 %" not in result.stdout
    assert "of the universe" in result.stdout


def test_what_blocks_bound_needs_no_declaration(invoke):
    file = ROOT / "scenarios" / "exchanger" / "precontrol.fcl"
    result = invoke("check", file, "--scenario", ROOT / "scenarios/exchanger/plane.toml", "--law")
    assert "least at setpoint=41 flow=0.62; most at setpoint=59 flow=1.38" in result.stdout
    assert result.stderr == ""


def test_inputs_that_nothing_bounds_are_named(invoke, crane):
    result = invoke("check", FILE, "--scenario", SCENARIO)
    assert result.stderr == (
        "`distance` and `angle` of container_crane go anywhere in its scenarios: "
        "bound them there by `ranges`, or here by --universe\n"
    )


def test_a_scenario_of_other_rule_bases_is_wrong_usage(invoke, crane):
    (crane / "other.fcl").write_text((crane / FILE).read_text("utf-8"), "utf-8")
    result = invoke("check", "other.fcl", "--scenario", SCENARIO)
    assert result.exit_code == 2
    assert "the scenarios use none of these rule bases: they use crane_printed.fcl" in result.stderr


@pytest.mark.parametrize(
    ("ranges", "told"),
    [
        (
            'ranges = { distanse = ["0 m", "1 m"] }',
            "error[SCN201]: `controller.rules` has no input `distanse`",
        ),
        (
            'ranges = { distance = ["0 m", "1 s"] }',
            "error[SCN404]: an end of the range of `distance` is in m, and this is in s",
        ),
        (
            'ranges = { distance = ["1 m", "0 m"] }',
            "error[SCN203]: the range of `distance` does not go from below to above",
        ),
        (
            'ranges = { distance = ["1 m"] }',
            "error[SCN203]: `distance` is from where to where a variable goes",
        ),
    ],
)
def test_a_range_at_fault_is_told_with_its_place(invoke, crane, ranges, told):
    declare(crane, ranges)
    for command in (("check", FILE, "--scenario", SCENARIO), ("run", SCENARIO)):
        result = invoke(*command)
        assert result.exit_code == 3
        assert told in result.stderr
