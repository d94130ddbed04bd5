import json

import pytest

from tests.mutation_bench import SETTLES, write_bench

ALIVE = "scenarios/tank.fcl:10: term open of inlet: 2 → 2.25; inlet 2 → 2.25 (12 % of its range) at level=0.0"


@pytest.fixture
def tank(tmp_path, monkeypatch):
    """Stand in a bench with a tank whose requirement is too wide for some changes of its three rules."""
    write_bench(tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def lines(text):
    return [line.strip() for line in text.splitlines()]


def test_what_is_alive_and_different_is_listed_with_its_place_and_where_it_shows(invoke, tank):
    result = invoke("mutate")
    assert result.exit_code == 1
    assert lines(result.stdout)[0] == "scenarios/tank.fcl, tank: 40 mutants, 1 run"
    assert ALIVE in lines(result.stdout)
    assert lines(result.stdout)[-1] == (
        "40 mutants of 1 rule base: 18 killed by requirements, 0 by baselines, "
        "14 alive with the same law where the runs go, 8 alive and different."
    )
    told = "no baseline can kill in 1 run of 1, which has none or leaves it anyway"
    assert result.stderr == f"warning: scenarios/tank.fcl: {told}\n"


def test_the_line_of_a_mutant_can_be_evaluated(invoke, tank):
    result = invoke("eval", "scenarios/tank.fcl", "level=0.0")
    assert result.stdout == "inlet = 2\n"


def test_one_rule_can_be_asked_for_and_every_group_listed(invoke, tank):
    result = invoke("mutate", "--rule", "3", "--list", "same", "--list", "requirements")
    assert result.exit_code == 0
    told = lines(result.stdout)
    assert "scenarios/tank.fcl:18: rule 3: left out" in told
    assert not any("rule 1" in each or "rule 2" in each for each in told)
    first = invoke("mutate", "--rule", "1", "--list", "all")
    assert "scenarios/tank.fcl:16: rule 1: left out; fill base: T-1 FAIL" in lines(first.stdout)


def test_a_baseline_can_make_it_green(invoke, tank):
    assert invoke("baseline", "update", "--reason", "the first").exit_code == 0
    result = invoke("mutate", "--rule", "1")
    assert (result.exit_code, result.stderr) == (0, "")
    assert "alive and different:" not in result.stdout


def test_json_tells_of_every_mutant(invoke, tank):
    result = invoke("mutate", "--json")
    document = json.loads(result.stdout)
    (base,) = document["rule_bases"]
    assert (document["schema"], base["file"], base["function_block"]) == (1, "scenarios/tank.fcl", "tank")
    assert base["runs"] == [{"scenario": "fill", "variant": "base"}]
    groups = [each["group"] for each in base["mutants"]]
    tally = {group: groups.count(group) for group in ("requirements", "baselines", "same", "different")}
    assert {"kind": "all", "mutants": len(groups), **tally} == base["kinds"][-1]
    (found,) = [each for each in base["mutants"] if each["what"] == "2 → 2.25"]
    assert found == {
        "kind": "singleton shifted",
        "rule": None,
        "where": "term open of inlet",
        "what": "2 → 2.25",
        "line": 10,
        "column": found["column"],
        "group": "different",
        "killed_by": None,
        "largest_difference": {
            "inputs": {"level": 0.0},
            "output": "inlet",
            "before": 2.0,
            "after": 2.25,
            "share_of_range": 0.125,
        },
    }
    (killed,) = [each for each in base["mutants"] if (each["rule"], each["what"]) == ("1", "left out")]
    assert killed["killed_by"] == {"scenario": "fill", "variant": "base", "by": "T-1", "verdict": "FAIL"}


def test_a_rule_that_is_not_there_is_wrong_usage(invoke, tank):
    result = invoke("mutate", "--rule", "4")
    assert result.exit_code == 2
    assert "there is no rule '4'; there are 1, 2 or 3" in result.stderr


def test_a_bench_without_a_rule_base_is_wrong_usage(invoke, tank):
    path = tank / "scenarios" / "fill.toml"
    text = path.read_text("utf-8").replace('"rules.inlet"', '"rules"')
    start, end = text.index("[blocks.rules]"), text.index("[[require]]")
    path.write_text(
        text[:start] + '[blocks]\nrules = { type = "constant", value = 1 }\n\n' + text[end:], "utf-8"
    )
    result = invoke("mutate")
    assert result.exit_code == 2, result.stderr
    assert "no run of these scenarios has a rule base" in result.stderr


def test_the_faults_of_all_scenarios_are_told(invoke, tank):
    (tank / "scenarios" / "bad.toml").write_text("duration = 3\n", "utf-8")
    (tank / "scenarios" / "worse.toml").write_text("duration = [\n", "utf-8")
    result = invoke("mutate")
    assert result.exit_code == 3
    assert "bad.toml" in result.stderr
    assert "worse.toml" in result.stderr


def test_verdicts_that_are_red_anyway_are_warned_of(invoke, tank):
    path = tank / "scenarios" / "fill.toml"
    path.write_text(path.read_text("utf-8").replace("0.6667", "0.2"), "utf-8")
    assert SETTLES.replace("0.6667", "0.2") in path.read_text("utf-8")
    result = invoke("mutate", "--rule", "3")
    assert "1 verdict of its runs is not PASS with the rule base as it is, and kills nothing" in result.stderr
