"""Mutants in closed loop: which of them requirements or baselines tell from the original."""

import shutil

import pytest

from fcl_sim import fcl, mutation, testbench
from fcl_sim.judge.verdict import Status
from fcl_sim.mutation import Group
from fcl_sim.plant.catalog import shipped_bench
from fcl_sim.scenario.reader import read
from fcl_sim.verify.mutants import mutants
from tests.mutation_bench import SETTLES, TANK, write_bench

CRANE = shipped_bench() / "scenarios" / "crane"

NOTHING_THERE = {
    *("rule 3: inlet IS shut → part", "rule 3: inlet IS shut WITH 1 → 0.5", "rule 3: left out"),
    *(f"term over of level: {way}" for way in ("5 → 4.75", "5 → 5.25", "6 → 5.75", "6 → 6.25")),
    *(f"term part of inlet: 1 → {place}" for place in ("0.75", "1.25")),
    *(f"rule block rules: ACCU MAX → {other}" for other in ("BSUM", "NSUM")),
    *(f"output inlet: DEFAULT 0 → {other}" for other in ("NC", "2")),
}
"""No run goes where a rule uses these: to a level above 5, to the term `part`, to where no rule is active."""


def surveyed(path, chosen=None):
    (base,) = mutation.rule_bases([read(path)])
    return mutation.survey(base, chosen, workers=2)


def named(survey, name):
    (found,) = [each for each in survey.fates if str(each.mutant) == name]
    return found


def told(survey, group):
    return {str(each.mutant) for each in survey.of(group)}


@pytest.fixture(scope="module")
def tank(tmp_path_factory):
    return surveyed(write_bench(tmp_path_factory.mktemp("tank")))


def test_every_mutant_meets_one_fate(tank):
    every = [str(each) for each in mutants(tank.rule_base.function_block)]
    assert [str(each.mutant) for each in tank.fates] == every
    assert sum(len(tank.of(group)) for group in Group) == len(every)
    assert tank.refused == ()


@pytest.mark.parametrize(
    "name",
    [
        "rule 1: left out",  # the tank stays empty
        "rule 2: left out",  # it fills to 2
        "rule 1: level IS low → level IS NOT low",
        "rule 1: inlet IS open WITH 1 → 0.5",  # it settles at (√17 - 3) / 2 = 0.56
    ],
)
def test_what_makes_the_level_settle_elsewhere_is_killed_by_the_requirement(tank, name):
    fate = named(tank, name)
    assert fate.group is Group.REQUIREMENTS
    assert (fate.killer.scenario, fate.killer.variant, fate.killer.by) == ("fill", "base", "T-1")
    assert fate.killer.status is Status.FAIL


def test_what_changes_nothing_where_the_run_goes_is_alive_with_the_same_law(tank):
    assert told(tank, Group.SAME) >= NOTHING_THERE
    assert all(each.difference.share == 0.0 for each in tank.of(Group.SAME))


def test_what_the_requirement_is_too_wide_for_is_alive_and_different(tank):
    fate = named(tank, "term open of inlet: 2 → 2.25")  # it settles at 2.25 / 3.25 = 0.69
    assert (fate.group, fate.killer) == (Group.DIFFERENT, None)
    found = fate.difference
    assert (found.output, found.inputs) == ("inlet", {"level": 0.0})
    assert (found.before, found.after, found.share) == (2.0, 2.25, 0.125)


def test_a_baseline_kills_what_the_requirement_leaves_alive(tank, tmp_path):
    path = write_bench(tmp_path)
    outcome = testbench.run(path)
    testbench.update_baseline(outcome, "base", reason="the first", date="2026-01-31")
    beside = surveyed(path)
    assert told(beside, Group.REQUIREMENTS) == told(tank, Group.REQUIREMENTS)
    assert told(beside, Group.SAME) == told(tank, Group.SAME)
    assert told(beside, Group.BASELINES) | told(beside, Group.DIFFERENT) == told(tank, Group.DIFFERENT)
    fate = named(beside, "term open of inlet: 2 → 2.25")
    assert (fate.group, fate.killer.by, fate.killer.status) == (Group.BASELINES, "baseline", Status.FAIL)
    assert (tank.rule_base.without_baseline, beside.rule_base.without_baseline) == (1, 0)


def test_an_expected_miss_that_is_met_kills(tmp_path):
    more = """
[[require]]
id = "T-2"
text = "The level comes above 1. It does not: the inlet is shut there."
metric = { maximum = { signal = "tank.level" } }
min = 1
expect = "fail"
"""
    survey = surveyed(write_bench(tmp_path, more))
    fate = named(survey, "rule 2: left out")
    assert (fate.group, fate.killer.by, fate.killer.status) == (Group.REQUIREMENTS, "T-2", Status.FAIL)
    assert named(survey, "rule 1: left out").group is Group.DIFFERENT


def test_a_requirement_that_is_missed_anyway_kills_nothing(tmp_path):
    survey = surveyed(write_bench(tmp_path, SETTLES.replace("0.6667", "0.2")))
    assert survey.rule_base.not_passing == 1
    assert survey.of(Group.REQUIREMENTS) == ()


def test_what_a_run_is_held_against_is_run_with_the_mutant_as_well(tmp_path):
    more = """
[variants.again]
title = "The same once more"

[[require]]
id = "T-3"
text = "Both fill alike"
metric = { maximum = { signal = "tank.level" } }
relative_to = { variant = "base", as = "ratio" }
min = 0.999
max = 1.001
"""
    path = write_bench(tmp_path, more)
    assert testbench.run(path).variants["again"].verdicts[0].status is Status.PASS
    assert named(surveyed(path), "rule 2: left out").group is Group.DIFFERENT


def test_a_rule_base_in_int_is_compared_in_its_counts(tmp_path):
    path = write_bench(tmp_path, SETTLES, TANK.replace("LREAL", "INT"))
    scale = "scale  = { level = 0.001, inlet = 0.001 }\n"
    path.write_text(path.read_text("utf-8").replace("[[require]]", scale + "\n[[require]]", 1), "utf-8")
    survey = surveyed(path, lambda each: each.rule in {"2", "3"})
    assert named(survey, "rule 3: left out").group is Group.SAME
    assert named(survey, "rule 2: left out").group is Group.REQUIREMENTS
    assert all(each.group is not Group.SAME for each in survey.fates if each.mutant.rule == "2")


def test_the_order_of_runs_and_the_number_of_threads_change_no_fate(monkeypatch):
    (base,) = mutation.rule_bases([read(CRANE / "printed.toml")])
    monkeypatch.setattr(mutation, "PILOTS", 2)
    few = mutation.survey(base, lambda each: each.rule == "5", workers=1)
    many = mutation.survey(base, lambda each: each.rule == "5", workers=4)
    assert few.fates == many.fates
    monkeypatch.setattr(mutation, "PILOTS", 1000)
    plain = mutation.survey(base, lambda each: each.rule == "5")
    assert [each.group for each in plain.fates] == [each.group for each in few.fates]


def test_a_fate_is_what_comes_of_the_mutant_written_as_a_file(tmp_path):
    """The same by the long way: each mutant as FCL text in a copy of the bench, run by the test bench."""
    folder = tmp_path / "scenarios" / "crane"
    shutil.copytree(CRANE, folder)
    (base,) = mutation.rule_bases([read(folder / "transfer.toml")])
    survey = mutation.survey(base, lambda each: each.rule == "3" or each.kind.value == "DEFAULT changed")
    assert {each.group for each in survey.fates} >= {Group.BASELINES, Group.SAME, Group.DIFFERENT}
    for fate in survey.fates:
        (folder / "crane_completed.fcl").write_text(fcl.write(fate.mutant.function_block), "utf-8")
        runs = testbench.run(folder / "transfer.toml").variants.values()
        met = all(verdict.status is Status.PASS for run in runs for verdict in run.verdicts)
        kept = all(run.compared.status is Status.PASS for run in runs)
        assert met is (fate.group is not Group.REQUIREMENTS), str(fate.mutant)
        if met:
            assert kept is (fate.group is not Group.BASELINES), str(fate.mutant)
