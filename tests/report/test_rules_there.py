"""Where a requirement is missed, it is told which rules fire there, what they give, and it is drawn."""

from dataclasses import replace

import numpy as np
import pytest

from fcl_sim.block import loads
from fcl_sim.judge.verdict import Status
from fcl_sim.loop.diagram import Node, Wire
from fcl_sim.report import activation
from fcl_sim.report.activation import telling_runs
from fcl_sim.report.canvas import Shape, Text
from fcl_sim.report.rule_bases import rule_bases
from fcl_sim.report.rules_there import driving, first_miss, missed_when, misses, rules_there
from fcl_sim.report.telling import Miss, step_by_step
from fcl_sim.report.words import NO_BREAK
from tests.report.synthetic import ONE_INPUT, crane, of_all_rules, outcome, run, trace, verdict

SCAN = 0.5


def at(seconds):
    return round(seconds / SCAN)


@pytest.fixture
def missing(tmp_path):
    """Return a run that misses a requirement from 35 s on, with the degrees that its six rules have there."""

    def made(degrees, variant="base", **given):
        found = of_all_rules(trace("swings"), crane())
        record = found.fuzzy["controller.rules"]
        record.degrees[:] = 0.0
        record.degrees[at(35.0)] = degrees
        record.outputs[at(35.0)] = 12.5
        judged = given.pop("verdicts", (verdict(Status.FAIL, None),))
        return replace(run(tmp_path, variant, "swings", verdicts=judged, **given), trace=found)

    return made


def told(made):
    return rules_there(made, made.verdicts[0]).replace(NO_BREAK, " ")


def test_the_rules_that_fire_there_stand_in_the_order_of_their_degrees(missing):
    assert told(missing([0.2, 0.0, 0.7, 0, 0, 0])) == (
        "At 35 s rules 3 → pos_medium (0.7) and 1 → pos_medium (0.2) fire, power = 12.5 kW."
    )


def test_a_lone_rule_is_one(missing):
    assert told(missing([0, 0, 0, 0, 0, 1.0])) == "At 35 s rule 6 → zero (1) fires, power = 12.5 kW."


def test_that_none_fires_is_told(missing):
    assert told(missing([0.0] * 6)) == "At 35 s no rule fires, power = 12.5 kW."


def test_of_many_the_strongest_are_named_and_the_others_counted(missing):
    named = "6 → zero (0.6), 5 → pos_medium (0.5), 4 → neg_medium (0.4), 3 → pos_medium (0.3)"
    assert f"rules {named} and 2 more fire" in told(missing([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]))


def test_what_hardly_fires_beside_the_strongest_is_counted_and_not_named(missing):
    assert "rules 2 → pos_high (0.9) and 2 more fire" in told(missing([0.001, 0.9, 0.002, 0, 0, 0]))


def test_a_lone_further_rule_is_named_for_it_takes_no_more_room_than_to_count_it(missing):
    assert "rules 2 → pos_high (0.9) and 1 → pos_medium (0.001) fire" in told(
        missing([0.001, 0.9, 0, 0, 0, 0])
    )


def test_nothing_is_said_of_rules_that_the_plant_does_not_hear_of(missing):
    made = missing([1.0] * 6)
    cut_off = replace(made.diagram.plant, inputs={"power": Wire("crane.distance")})
    assert told(replace(made, diagram=replace(made.diagram, plant=cut_off))) == ""


def test_rules_drive_the_plant_through_aliases_and_other_blocks(missing):
    diagram = missing([1.0] * 6).diagram
    gain = Node(name="gain", type="gain", inputs={"input": Wire("power")}, parameters={})
    plant = replace(diagram.plant, inputs={"power": Wire("out")})
    aliases = {"out": Wire("gain"), "power": Wire("controller.rules.power")}
    nodes = (*diagram.nodes, gain, replace(gain, name="beside"))
    assert driving(replace(diagram, nodes=nodes, plant=plant, aliases=aliases)) == {
        "controller.rules",
        "gain",
    }


def test_what_is_met_or_has_no_time_says_nothing(missing):
    met = missing([1.0] * 6, verdicts=(verdict(),))
    timeless = missing([1.0] * 6, verdicts=(replace(verdict(Status.FAIL, None), violation=None),))
    assert (told(met), told(timeless)) == ("", "")


def test_a_run_without_a_scan_says_nothing(missing):
    made = missing([1.0] * 6)
    empty = replace(made.trace, ticks=made.trace.ticks[:0], values=made.trace.values[:0])
    assert told(replace(made, trace=empty)) == ""


def test_an_expected_miss_is_none_to_be_told_of_first(missing, tmp_path):
    meant = missing([1.0] * 6, verdicts=(verdict(Status.FAIL, None, expect_fail=True),))
    assert first_miss(meant) is None
    assert list(misses([outcome(tmp_path, meant)])) == []


def test_a_miss_names_scenario_run_and_requirement_how_it_is_missed_and_what_the_rules_do(missing, tmp_path):
    (line,) = misses([outcome(tmp_path, missing([1.0, 0, 0, 0, 0, 0]))])
    assert line.replace(NO_BREAK, " ") == (
        "crane/transfer base, CR-1: crane.distance does not settle. "
        "At 35 s rule 1 → pos_medium (1) fires, power = 12.5 kW."
    )


def test_a_requirement_that_several_runs_miss_is_told_once_with_their_names(missing, tmp_path):
    runs = [missing([1.0] * 6, name) for name in ("base", "light", "heavy")]
    (line,) = misses([outcome(tmp_path, *runs)])
    assert line.startswith("crane/transfer base, CR-1: ")
    assert line.endswith(" light and heavy miss it, too.")


def test_a_miss_that_has_no_time_is_told_with_the_chart(missing):
    timeless = replace(verdict(Status.FAIL, 3.0, id="IAE-1"), violation=None)
    made = missing([1.0] * 6, verdicts=(timeless,))
    assert "Missed as a whole, at no time of its own: IAE-1." in activation.over_time(made)[0].caption


def test_the_first_of_several_misses_is_the_first_in_time(missing):
    early = replace(verdict(Status.FAIL, None, id="CR-9"), violation=(7.0, 8.0))
    made = missing([1.0] * 6, verdicts=(verdict(Status.FAIL, None), early))
    assert first_miss(made).requirement.id == "CR-9"


def test_a_run_that_misses_has_its_rules_drawn_beside_the_first_user(missing, tmp_path):
    users = [run(tmp_path), run(tmp_path, "far"), missing([1.0] * 6, "light")]
    assert [each.variant for each in telling_runs(users)] == ["base", "light"]


def test_a_bar_stands_above_the_rules_over_each_stretch_that_is_violated(missing):
    wide = verdict(Status.FAIL, None)
    wide = replace(wide, band=replace(wide.band, low=-10.0, high=10.0), violation=(36.0, 36.5))
    made = missing([1.0] * 6, verdicts=(wide,))
    (node,) = made.diagram.nodes
    firing = activation.firing_of(node, made.trace.fuzzy["controller.rules"], made.trace.time)
    (violated,) = missed_when(made)
    (axes, _) = activation.draw(firing, firing.idle, [violated]).axes
    bars = axes.of(Shape, "violation")
    assert len(bars) == len(violated.stretches) > 1
    assert all(max(each.y) < axes.y[1] for each in bars)  # rows are counted downwards
    distance = made.trace["crane.distance"]
    for time, value in zip(made.trace.time, distance, strict=True):
        is_under_a_bar = any(start <= time <= end for start, end in violated.stretches)
        assert is_under_a_bar == (time >= 35.0 and abs(value) > 10.0)
    assert "CR-1 is violated from 35.5 s to 40 s, from 42 s" in activation.alt(firing, [violated])
    assert "Bars above: when a requirement is violated" in activation.over_time(made)[0].caption
    assert "CR-1" in [each.text for each in axes.of(Text)]


def test_each_requirement_has_a_row_those_to_be_met_first_and_of_many_the_last_share_one(missing):
    found = [
        replace(verdict(Status.FAIL, None, id=f"R-{each}", expect_fail=each % 2 == 0), band=None)
        for each in range(18)
    ]
    rows = missed_when(missing([1.0] * 6, verdicts=tuple(found)))
    told = [(each.label, each.is_meant) for each in rows]
    assert told == [
        *[(name, False) for name in ("R-1", "R-3", "R-5", "R-7", "R-9", "4 more")],
        *[(name, True) for name in ("R-0", "R-2", "R-4", "R-6", "R-8", "4 more")],
    ]


def test_the_scan_step_by_step_is_that_of_the_miss(missing, tmp_path):
    made = missing([0.0, 0, 0, 0, 0, 1.0], "light")
    (base,) = rule_bases([outcome(tmp_path, run(tmp_path), made)])
    first, *_ = step_by_step(base.node, base.records, base.time, base.missed)
    assert first.caption.replace(NO_BREAK, " ").startswith(
        "Run light at 35 s, where CR-1 is first violated: 1 rule fires. Inference of crane"
    )


def test_a_run_that_misses_something_that_has_no_time_is_drawn_as_well(missing, tmp_path):
    timeless = replace(verdict(Status.FAIL, 3.0), violation=None)
    users = [run(tmp_path), missing([1.0] * 6, "slow", verdicts=(timeless,))]
    assert [each.variant for each in telling_runs(users)] == ["base", "slow"]


def test_the_steps_of_a_scan_go_on_from_what_outputs_were_before(tmp_path):
    block = loads(ONE_INPUT, "valve.fcl")
    made = run(tmp_path, block=block)
    node, (record,) = made.diagram.nodes[0], made.trace.fuzzy.values()
    levels, given = np.array([[10.0], [3.0]]), np.array([[100.0], [100.0]])  # at 3 no rule is active: NC
    seen = replace(
        record,
        input_names=("level",),
        output_names=("opening",),
        rule_labels=("1", "2"),
        inputs=levels,
        outputs=given,
        degrees=np.array([[0.0, 1.0], [0.0, 0.0]]),
        flags=np.array([[1.0], [0.0]]),
    )
    missed = Miss(id="V-1", label="base", time=0.5, sample=1, node=node)
    first, *_ = step_by_step(node, {"base": seen}, np.array([0.0, 0.5]), missed)
    assert "opening = 100: no rule is active, NC keeps the previous value" in first.alt


def test_a_miss_in_int_is_not_explained_in_another_arithmetic(missing, tmp_path):
    made = missing([1.0] * 6)
    (base,) = rule_bases([outcome(tmp_path, made)])
    missed = replace(base.missed, node=replace(base.node, arithmetic="INT"))
    first, *_ = step_by_step(base.node, base.records, base.time, missed)
    assert "first violated" not in first.caption


def test_of_two_blocks_with_one_rule_base_each_has_its_own_record(tmp_path):
    made = run(tmp_path)
    (node,) = made.diagram.nodes
    twin = replace(node, name="controller.twin")
    diagram = replace(made.diagram, nodes=(node, twin))
    fuzzy = {**made.trace.fuzzy, twin.name: replace(made.trace.fuzzy[node.name])}
    both = replace(made, diagram=diagram, trace=replace(made.trace, fuzzy=fuzzy))
    whole = outcome(tmp_path, both)
    setup = whole.scenario.variants["base"]
    rule_files = {**setup.rule_bases, twin.name: setup.rule_bases[node.name]}
    scenario = replace(whole.scenario, variants={"base": replace(setup, rule_bases=rule_files)})
    (base,) = rule_bases([replace(whole, scenario=scenario)])
    assert list(base.records) == ["base controller.rules", "base controller.twin"]


def test_that_no_rule_fires_where_it_is_missed_can_be_drawn(missing, tmp_path):
    made = missing([0.0] * 6)
    made.trace.fuzzy["controller.rules"].inputs[at(35.0)] = (-4.0, -50.0)
    (base,) = rule_bases([outcome(tmp_path, made)])
    pictures = step_by_step(base.node, base.records, base.time, base.missed)
    assert "first violated: no rule fires." in pictures[0].caption
    assert all(each.draw().axes for each in pictures)


def test_where_an_input_is_not_a_number_another_scan_is_shown(missing, tmp_path):
    made = missing([1.0] * 6)
    record = made.trace.fuzzy["controller.rules"]
    record.inputs[at(35.0)] = np.nan
    record.degrees[3, 0] = 1.0
    (base,) = rule_bases([outcome(tmp_path, made)])
    first, *_ = step_by_step(base.node, base.records, base.time, base.missed)
    assert "the first scan at which the most rules fire" in first.caption
