from dataclasses import replace

import numpy as np
import pytest

from fcl_sim.block import loads
from fcl_sim.judge.baseline import Baseline
from fcl_sim.judge.compare import compare
from fcl_sim.judge.verdict import Status
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.loop.run import run as simulate
from fcl_sim.plant.catalog import shipped_bench
from fcl_sim.testbench import run
from fcl_sim.verify.cause import cause_of, first_divergence, with_rule_bases
from fcl_sim.verify.record import Acceptance, canonical, even, limit_cycle, record

CRANE = shipped_bench() / "scenarios" / "crane" / "transfer.toml"
ACCEPTED = Acceptance(scenario="crane/transfer", variant="base", date="2026-01-31", reason="as it is")


@pytest.fixture(scope="module")
def outcome():
    return run(CRANE)


def recorded(found, former: Baseline | None = None, **given):
    return record(ACCEPTED, found.diagram, found.trace, found.verdicts, former=former, **given)


def test_every_shipped_run_keeps_the_baseline_that_is_made_of_it(outcome):
    for found in outcome.variants.values():
        assert compare(found.trace, found.verdicts, recorded(found)).status is Status.PASS


def test_the_shipped_runs_keep_their_shipped_baselines(outcome):
    assert {name: str(found.compared.status) for name, found in outcome.variants.items()} == dict.fromkeys(
        outcome.variants, "PASS"
    )


def test_an_output_that_still_swings_makes_a_limit_cycle_and_a_load_that_calms_down_does_not(outcome):
    swinging = {name for name, each in outcome.variants.items() if limit_cycle(each.diagram, each.trace)}
    assert swinging == {"raw_distance"}
    kept = recorded(outcome.variants["raw_distance"])
    assert (kept.signals, len(kept.metrics)) == ((), len(outcome.base.verdicts))
    assert "still swings" in kept.left_out


def test_the_signals_that_are_asked_for_are_kept_swinging_or_not(outcome):
    kept = recorded(outcome.variants["raw_distance"], signals=["crane.sway"])
    assert ([each.name for each in kept.signals], kept.left_out) == (["crane.sway"], "")


def test_tolerances_are_those_of_the_former_baseline(outcome):
    first = recorded(outcome.base)
    metric = replace(first.metrics[0], absolute=0.7, relative=0.3)
    signal = replace(first.signals[0], absolute=7.0, relative=0.3, leading=1, lagging=2, thinned=1.0)
    edited = replace(first, metrics=(metric,), signals=(signal,))
    second = recorded(outcome.base, edited)
    mine = second.metrics[0]
    assert (mine.absolute, mine.relative) == (0.7, 0.3)
    kept = second.signals[0]
    assert (kept.absolute, kept.relative, kept.leading, kept.lagging, kept.thinned) == (7.0, 0.3, 1, 2, 1.0)
    assert kept.ticks.size < first.signals[0].ticks.size
    assert second.metrics[1] == first.metrics[1]


def test_a_figure_that_is_a_trifle_beside_its_bound_may_change_by_a_part_of_the_bound(outcome):
    run = outcome.base
    (verdict,) = (each for each in run.verdicts if each.requirement.metric == "peak")
    still = replace(run.trace, values=run.trace.values * 1e-18)
    loose = replace(verdict, requirement=replace(verdict.requirement, maximum=20.0))
    kept = record(ACCEPTED, run.diagram, still, [loose])
    assert kept.metrics[0].absolute == pytest.approx(2e-3)


def test_the_rule_base_reads_back_as_the_one_that_ran(outcome):
    (kept,) = recorded(outcome.base).rule_bases
    (node,) = (each for each in outcome.base.diagram.nodes if isinstance(each, FuzzyNode))
    assert loads(kept.text).function_block == node.block.function_block
    assert kept.arithmetic == node.arithmetic


@pytest.mark.parametrize(
    ("value", "found"), [(0.0, 0.0), (1.0, 1.0), (0.0101, 0.02), (2.1, 5.0), (6.0, 10.0)]
)
def test_tolerances_are_even_numbers_that_are_not_smaller(value, found):
    assert even(value) == found


def edited(diagram, old, new):
    (node,) = (each for each in diagram.nodes if isinstance(each, FuzzyNode))
    text = canonical(node)
    assert old in text
    return with_rule_bases(diagram, {node.name: loads(text.replace(old, new))})


def cause(found, diagram):
    trace = simulate(diagram)
    asked = [each.requirement for each in found.verdicts]
    return trace, cause_of(diagram, trace, recorded(found), asked, {})


def test_a_moved_point_is_the_cause_and_the_rule_that_it_moves_fires_otherwise(outcome):
    diagram = edited(outcome.base.diagram, "(0, 0) (5, 1) (10, 0)", "(0, 0) (6, 1) (10, 0)")
    trace, found = cause(outcome.base, diagram)
    ((block, edit),) = found.edits
    assert (block, edit.owner, edit.name) == ("controller.rules", "distance", "close")
    assert (found.setting, found.is_whole) == ((), True)
    at = int(np.searchsorted(trace.time, found.divergence.time))
    assert np.array_equal(trace.values[:at], outcome.base.trace.values[:at])
    assert not np.array_equal(trace.values[at], outcome.base.trace.values[at])
    assert found.divergence.signal == "controller.rules.power"
    labels = [each.label for each in found.divergence.rules]
    assert labels
    text = canonical(diagram.nodes[-1])
    for label in labels:
        assert f"RULE {label}: IF distance IS close" in text


def test_a_conclusion_that_was_moved_is_told_with_the_rule_that_fires_as_before(outcome):
    old, new = (f"angle IS pos_small THEN power IS {each}" for each in ("neg_high", "neg_medium"))
    _, found = cause(outcome.base, edited(outcome.base.diagram, f"too_far AND {old}", f"too_far AND {new}"))
    (rule,) = found.divergence.rules
    assert (rule.label, rule.old == rule.new, rule.old > 0) == ("10", True, True)


def test_a_rule_that_was_taken_out_is_told(outcome):
    rule = "    RULE 1: IF distance IS far AND angle IS zero THEN power IS pos_medium;\n"
    _, found = cause(outcome.base, edited(outcome.base.diagram, rule, ""))
    (gone,) = found.divergence.rules
    assert (gone.label, gone.new, found.divergence.time) == ("1", None, 0.0)


def test_what_changed_outside_of_the_rule_base_is_told_and_no_rule_is_blamed(outcome):
    lighter = replace(outcome.base.diagram.plant, parameters={"load_mass": 10_000.0, "cable_length": 10.0})
    _, found = cause(outcome.base, replace(outcome.base.diagram, plant=lighter))
    assert found.setting == (("parameter load_mass 20000 kg", "parameter load_mass 10000 kg"),)
    assert (found.edits, found.divergence, found.is_whole) == ((), None, False)


def test_with_two_causes_the_rule_base_is_not_the_whole_reason(outcome):
    lighter = replace(outcome.base.diagram.plant, parameters={"load_mass": 10_000.0, "cable_length": 10.0})
    diagram = edited(outcome.base.diagram, "(0, 0) (5, 1) (10, 0)", "(0, 0) (6, 1) (10, 0)")
    _, found = cause(outcome.base, replace(diagram, plant=lighter))
    assert (len(found.setting), len(found.edits), found.is_whole) == (1, 1, False)


def test_runs_that_are_the_same_part_nowhere(outcome):
    assert first_divergence(outcome.base.trace, outcome.base.trace) is None
