"""The page on a plant of one's own: its files, as they stand there, make a bench that does what it says."""

import re

import pytest

from tests.house.places import ROOT

PAGE = (ROOT / "docs" / "own-plant.md").read_text("utf-8")
FILES = dict(re.findall(r"^`([\w/.]+)`\n\n```\w+\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL))


@pytest.fixture
def bench(tmp_path, monkeypatch):
    for name, text in FILES.items():
        file = tmp_path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, "utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_page_has_a_plant_a_rule_base_and_a_scenario():
    assert [*FILES] == ["plants/tank.py", "scenarios/tank/tank.fcl", "scenarios/tank/level.toml"]


def test_its_files_make_a_bench_whose_requirements_are_met_once_it_is_accepted(invoke, bench):
    assert invoke("check", "scenarios/tank").exit_code == 0
    first = invoke("run", "scenarios/tank", "--no-report")
    verdicts = [line.rstrip().split("  ")[-1] for line in first.stdout.splitlines() if "TA-" in line]
    assert verdicts == ["PASS", "PASS", "EXPECTED MISS", "PASS"]
    assert first.exit_code == 4
    assert invoke("baseline", "update", "scenarios/tank", "--reason", "first version").exit_code == 0
    assert invoke("run", "scenarios/tank", "--no-report").exit_code == 0
