"""What pytest makes of the files of a bench."""

import subprocess
import sys

import pytest

from tests.house.places import ROOT
from tests.house.test_imports import HEAVY

pytest_plugins = ("pytester",)

FILE = "scenarios/bath/heat.toml"
ALL = [f"{FILE}::{run}::{what}" for run in ("base", "slow") for what in ("B-1", "B-2", "baseline")]


def test_every_requirement_on_every_run_is_an_item_and_every_run_beside_its_baseline(bench):
    assert bench.collected() == ALL


def test_controllers_baselines_and_other_files_are_none(bench):
    bench.accept()
    bench.write("scenarios/bath/bath.controller.toml", "")
    bench.write("scenarios/bath/README.md", "")
    bench.write("settings.toml", "")
    assert (bench.folder / "scenarios/bath/baselines/heat.slow.toml").exists()
    assert bench.collected() == ALL


def test_a_scenario_that_is_named_is_taken_wherever_it_is(bench):
    for name in ("bath.fcl", "heat.toml"):
        bench.write(f"elsewhere/{name}", (bench.folder / "scenarios/bath" / name).read_text("utf-8"))
    assert bench.collected() == ALL
    assert bench.collected("elsewhere/heat.toml")[0] == "elsewhere/heat.toml::base::B-1"


def test_a_folder_scenarios_above_the_project_is_not_looked_at(bench):
    bench.write("scenarios/project/pytest.toml", "[pytest]\n")
    bench.write("scenarios/project/pyproject.toml", "[project]\nname = 'x'\n")
    assert bench.collected("scenarios/project") == []


def test_within_the_folder_of_scenarios_they_are_found(bench, monkeypatch):
    monkeypatch.chdir(bench.folder / "scenarios" / "bath")
    assert bench.collected()[0] == "heat.toml::base::B-1"


@pytest.mark.parametrize(
    ("arguments", "chosen"),
    [
        (["-k", "slow"], ALL[3:]),
        (["-k", "B-1"], [ALL[0], ALL[3]]),
        (["-k", "bath and baseline"], [ALL[2], ALL[5]]),
        (["-m", "not fcl_sim"], []),
        (["-m", "fcl_sim(requirement='B-2')"], [ALL[1], ALL[4]]),
        (["-m", "fcl_sim(variant='slow') and not fcl_sim(baseline=True)"], ALL[3:5]),
        (["-m", "fcl_sim(scenario='bath/heat', variant='base')"], ALL[:3]),
        ([ALL[4]], [ALL[4]]),
    ],
    ids=["run", "requirement", "baseline", "the others", "by id", "by run", "by scenario", "by node"],
)
def test_items_are_chosen_as_any_others(bench, arguments, chosen):
    assert bench.collected("--strict-markers", *arguments) == chosen


def test_a_requirement_beside_another_run_is_none_of_that_run(bench):
    bench.edit(
        FILE,
        'max    = "45 degC"\n',
        'max    = 1.1\nrelative_to = { variant = "base", as = "ratio" }\n',
    )
    assert bench.collected() == [each for each in ALL if each != ALL[0]]


def test_a_scenario_is_simulated_once_however_many_items_it_has(bench, simulations):
    result = bench.run("-k", "not baseline")
    result.assert_outcomes(passed=4, deselected=2)
    assert simulations == ["bath/heat"]


def test_it_is_not_simulated_where_no_item_is_chosen(bench, simulations):
    bench.run("-k", "nothing")
    bench.collected()
    assert simulations == []


def test_a_file_that_cannot_be_read_says_why_without_a_traceback(bench):
    bench.write("scenarios/bath/typo.toml", HEAT_WITH_A_TYPO)
    result = bench.run("-k", "not baseline", "--continue-on-collection-errors")
    result.assert_outcomes(passed=4, deselected=2, errors=1)
    result.stdout.fnmatch_lines(
        [
            "*ERROR collecting scenarios/bath/typo.toml*",
            "scenarios/bath/typo.toml:2:1: error[[]SCN201[]]: the scenario has no key `durasion`",
            "  hint: did you mean `duration`?",
        ]
    )
    result.stdout.no_fnmatch_line("*Traceback*")


HEAT_WITH_A_TYPO = 'title = "x"\ndurasion = "1 s"\n[plant]\nmodel = "crane"\n'


def test_what_is_wrong_with_the_loop_is_an_error_of_each_item(bench):
    bench.edit("scenarios/bath/bath.fcl", "heating IS off", "heating IS of")
    result = bench.run()
    result.assert_outcomes(errors=6)
    result.stdout.fnmatch_lines(
        ["*ERROR at setup of bath/heat base B-1*", "scenarios/bath/bath.fcl:17:*error[[]FCL310[]]*"]
    )
    result.stdout.no_fnmatch_line("*Traceback*")


def test_tests_in_python_stand_beside_them(bench):
    bench.write("test_own.py", "def test_own():\n    pass\n")
    bench.run("-k", "own or B-1").assert_outcomes(passed=3, deselected=4)


LIGHT = f"""
import sys

def test_own():
    assert "fcl_sim.pytest_plugin" in sys.modules
    assert {HEAVY} & set(sys.modules) == set()
"""


def test_a_session_without_scenarios_loads_nothing_heavy(tmp_path):
    (tmp_path / "test_own.py").write_text(LIGHT)
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "fcl_sim.pytest_plugin"],
        cwd=tmp_path,
        env={"PYTHONPATH": str(ROOT), "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert "1 passed" in done.stdout, done.stdout
