"""The whole sequence: a scenario file comes out judged, every variant, with its numbers."""

import math
import os
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fcl_sim import testbench
from fcl_sim.diagnostics import InputFault
from fcl_sim.judge.verdict import Status
from fcl_sim.loop.run import Halted
from fcl_sim.plant.catalog import shipped_bench
from fcl_sim.testbench import BASE, Outcome, run_together

CRANE = shipped_bench() / "scenarios" / "crane"


@pytest.fixture(scope="module")
def transfer() -> Outcome:
    return testbench.run(CRANE / "transfer.toml")


@pytest.fixture(scope="module")
def printed() -> Outcome:
    return testbench.run(CRANE / "printed.toml")


def stall(outcome: Outcome, variant: str) -> float:
    """Return how far from the target friction can hold the head: cr (M + m) g / 5400 N/m."""
    plant = outcome.variants[variant].diagram.plant
    defaults = {each.name: each.default for each in plant.model.declaration.parameters}
    values = {**defaults, **plant.parameters}
    mass = values["trolley_mass"] + values["load_mass"]
    return values["rolling_resistance"] * mass * values["gravity"] / 5400


@pytest.mark.parametrize("scenario", ["transfer", "printed"])
def test_the_shipped_crane_is_green(request, scenario):
    outcome = request.getfixturevalue(scenario)
    assert outcome.verdict is Status.PASS
    for run in outcome.variants.values():
        assert run.trace.fault is None
        assert run.verdict is Status.PASS
        assert [each.status for each in run.verdicts] == [Status.PASS] * len(run.verdicts)


def test_the_completed_base_has_the_figures_of_its_readme(transfer):
    assert transfer.metrics["CR-1"] == pytest.approx(25.4, abs=0.1)
    assert transfer.metrics["CR-2"] == pytest.approx(19.0, abs=0.1)
    assert transfer.metrics["CR-3"] == 0.0
    assert transfer.metrics["CR-4"] == pytest.approx(3.86, abs=0.01)
    assert transfer.metrics["CR-5"] == pytest.approx(0.3180, abs=0.0005)
    assert transfer.variants["heavy_and_far"].metrics["CR-2"] == pytest.approx(31.1, abs=0.1)
    assert transfer.variants["heavy_and_far"].metrics["CR-5"] == pytest.approx(0.027, abs=0.002)
    assert transfer.variants["frictionless"].metrics["CR-5"] < 0.001
    assert transfer.variants["raw_distance"].metrics["CR-3"] == pytest.approx(7.9, abs=0.1)


def test_the_head_parks_where_the_stall_law_says(transfer):
    for variant in ("base", "light_load", "double_scan"):
        parked = transfer.variants[variant].metrics["CR-5"]
        assert parked == pytest.approx(stall(transfer, variant), abs=0.001)
    assert transfer.variants["heavy_and_far"].metrics["CR-5"] <= stall(transfer, "heavy_and_far")


def test_the_printed_base_has_the_figures_of_its_readme(printed):
    final = {name: run.trace["crane.distance"][-1] for name, run in printed.variants.items()}
    assert final["base"] == pytest.approx(-34.8, abs=0.5)
    assert final["from_20_m"] == pytest.approx(-20.8, abs=0.5)
    assert final["from_40_m"] == pytest.approx(-46.2, abs=0.5)
    assert printed.variants["from_10_m"].metrics["PR-1"] == 0.0
    assert np.all(printed.variants["from_10_m"].trace["crane.distance"] == 10.0)
    assert np.all(printed.variants["from_10_m"].trace["controller.power"] == 0.0)


def test_every_miss_of_the_printed_base_is_told_requirement_by_requirement(printed):
    missed = {
        name: [each.requirement.id for each in run.verdicts if each.measured is Status.FAIL]
        for name, run in printed.variants.items()
    }
    assert missed == {
        BASE: ["PR-2", "PR-3", "PR-4", "PR-6", "PR-7"],
        "from_10_m": ["PR-1", "PR-2", "PR-6", "PR-7", "PR-8"],
        "from_20_m": ["PR-2", "PR-3", "PR-4", "PR-6", "PR-7"],
        "from_40_m": ["PR-2", "PR-4", "PR-6", "PR-7"],
        "predicted_distance": ["PR-2", "PR-3", "PR-4", "PR-6", "PR-7", "PR-8"],
    }


def test_an_outcome_gives_the_base_run_first_hand(transfer):
    assert transfer.base is transfer.variants[BASE]
    assert transfer.trace is transfer.base.trace
    assert transfer.trace.time[-1] == 60.0
    assert transfer.trace["crane.angle"].shape == transfer.trace.time.shape
    assert transfer.variants["double_scan"].trace.time[1] == 0.1


def test_overrides_change_every_run_that_does_not_say_otherwise():
    outcome = testbench.run(
        CRANE / "transfer.toml", overrides={"plant.parameters.load_mass": "10 t", "duration": "5 s"}
    )
    assert {name: run.diagram.plant.parameters["load_mass"] for name, run in outcome.variants.items()} == {
        **dict.fromkeys(outcome.variants, 10_000.0),
        "heavy_and_far": 40_000.0,
    }


def test_a_trace_that_is_too_short_is_inconclusive_expected_or_not():
    outcome = testbench.run(CRANE / "transfer.toml", overrides={"duration": "5 s"})
    statuses = {each.requirement.id: each.status for each in outcome.variants["raw_distance"].verdicts}
    assert statuses["CR-1"] is statuses["CR-2"] is Status.INCONCLUSIVE
    assert outcome.verdict in {Status.FAIL, Status.INCONCLUSIVE}


def test_a_requirement_that_is_no_longer_missed_turns_red():
    overrides = {"plant.parameters.rolling_resistance": 0}
    outcome = testbench.run(CRANE / "transfer.toml", overrides)
    assert outcome.verdict is outcome.base.verdict is Status.FAIL
    wrong = [each for each in outcome.base.verdicts if each.status is Status.FAIL]
    assert [each.requirement.id for each in wrong] == ["CR-5", "CR-10"]
    told = "A miss was expected: the expectation no longer holds."
    assert all(each.reason.endswith(told) for each in wrong)


def test_one_variant_that_turns_red_turns_the_outcome_red():
    overrides = {"variants.light_load.plant.parameters.rolling_resistance": 0}
    outcome = testbench.run(CRANE / "transfer.toml", overrides)
    assert outcome.base.verdict is Status.PASS
    assert outcome.variants["light_load"].verdict is Status.FAIL
    assert outcome.verdict is Status.FAIL


def test_faults_of_all_variants_come_before_anything_runs(monkeypatch):
    def never(diagram, _halt):
        raise AssertionError(diagram)

    monkeypatch.setattr("fcl_sim.testbench.running.simulate", never)
    with pytest.raises(InputFault) as caught:
        testbench.run(
            CRANE / "transfer.toml", {"plant.start.psition": "-25 m", "plant.inputs.power": "crane.powr"}
        )
    assert [each.code for each in caught.value.diagnostics] == ["SCN309"]


def test_a_run_that_blows_up_is_a_fault_in_every_verdict(transfer):
    prepared = testbench.prepare(transfer.scenario)[0]
    plant = replace(prepared.diagram.plant, start={"speed": 1e200})
    run = testbench.run_prepared(replace(prepared, diagram=replace(prepared.diagram, plant=plant)))
    assert run.trace.fault is not None
    assert {each.status for each in run.verdicts} == {Status.FAULT}
    assert run.verdict is Status.FAULT
    assert all(each.value is None for each in run.verdicts)
    assert not math.isnan(run.seconds)


def test_the_bench_of_a_scenario_is_the_folder_above_scenarios():
    assert testbench.bench_of(CRANE / "transfer.toml") == shipped_bench()
    assert testbench.bench_of(Path("scenarios/x.toml")) == Path.cwd()


def test_the_field_of_cranes_comes_out_as_measured(transfer, printed):
    base = {each.requirement.id: each for each in transfer.base.envelope.verdicts}
    passed = {name: each.passed for name, each in base.items()}
    assert passed.pop("CR-10") == 164
    assert set(passed.values()) == {175}
    assert base["CR-2"].value == pytest.approx(31.1, abs=0.1)
    assert base["CR-4"].value == pytest.approx(8.09, abs=0.01)
    assert base["CR-9"].value == pytest.approx(24.6, abs=0.1)
    raw = {each.requirement.id: each for each in transfer.variants["raw_distance"].envelope.verdicts}
    assert raw["CR-8"].passed >= 30
    assert raw["CR-8"].points == 36
    frictionless = {each.requirement.id: each for each in transfer.variants["frictionless"].envelope.verdicts}
    assert frictionless["CR-3"].value == pytest.approx(0.74, abs=0.01)
    landed = next(each for each in printed.base.envelope.verdicts if each.requirement.id == "PR-2")
    assert (landed.passed, landed.points) == (175, 175)


def test_every_crane_of_the_field_parks_within_the_stall_law(transfer):
    law = next(each for each in transfer.base.envelope.verdicts if each.requirement.id == "CR-6")
    assert len(law.values) == 175
    assert np.all((law.values >= 0.0) & (law.values <= 0.505))


@pytest.mark.parametrize("by", ["copies", "threads"])
def test_scenarios_side_by_side_come_to_the_same_as_one_after_the_other(monkeypatch, by):
    if by == "threads":
        monkeypatch.setattr("fcl_sim.testbench.side_by_side.able", lambda _: 1)
    files = [CRANE / "transfer.toml", CRANE / "printed.toml", CRANE / "gust.toml"]
    short = {"duration": "5 s"}
    for file, outcome in zip(files, testbench.run_files(files, short, workers=3), strict=True):
        alone = testbench.run(file, short)
        assert outcome.scenario.path == file
        assert outcome.verdict is alone.verdict
        assert {name: run.metrics for name, run in outcome.variants.items()} == {
            name: run.metrics for name, run in alone.variants.items()
        }


def test_a_scenario_that_cannot_be_read_stands_in_its_place_and_the_others_are_run(tmp_path):
    files = [tmp_path / "none.toml", CRANE / "gust.toml"]
    fault, outcome = testbench.run_files(files, {"duration": "5 s"})
    assert [each.code for each in fault.diagnostics] == ["SCN101"]
    assert outcome.scenario.name == "crane/gust"


def test_whoever_leaves_off_ends_the_runs_under_way(tmp_path, monkeypatch):
    """Six hours of the crane, at each point of its grid, would take minutes."""
    ended = []

    def watched(*arguments):
        try:
            return run_together(*arguments)
        except Halted:
            ended.append("halted")
            raise

    monkeypatch.setattr("fcl_sim.testbench.side_by_side.run_together", watched)
    monkeypatch.setattr("fcl_sim.testbench.side_by_side.able", lambda _: 1)
    found = testbench.run_files([tmp_path / "none.toml", CRANE / "gust.toml"], {"duration": "21600 s"})
    next(found)
    found.close()
    assert ended == ["halted"]


@pytest.mark.skipif(sys.platform != "linux", reason="run by threads")
def test_whoever_leaves_off_ends_the_copies_that_run(tmp_path, monkeypatch):
    copies, fork = [], os.fork

    def noted():
        copies.append(fork())
        return copies[-1]

    monkeypatch.setattr("fcl_sim.forked.os.fork", noted)
    files = [tmp_path / "none.toml", CRANE / "gust.toml", CRANE / "gust.toml"]
    found = testbench.run_files(files, {"duration": "21600 s"}, workers=2)
    next(found)
    found.close()
    assert len(copies) == 2
    for copy in copies:
        with pytest.raises(ChildProcessError):
            os.waitpid(copy, os.WNOHANG)


def test_a_fault_that_a_run_comes_upon_stands_in_its_place(monkeypatch):
    def refuse(*_):
        raise InputFault.at_file("RUN101", "here", "this cannot be run", "try another")

    monkeypatch.setattr("fcl_sim.testbench.side_by_side.run_together", refuse)
    found = [*testbench.run_files([CRANE / "gust.toml"] * 2, {"duration": "5 s"}, workers=2)]
    assert [[str(each) for each in fault.diagnostics] for fault in found] == 2 * [
        [
            str(each)
            for each in InputFault.at_file("RUN101", "here", "this cannot be run", "try another").diagnostics
        ]
    ]
