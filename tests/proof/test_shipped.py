"""What a proof says of every rule base that is shipped."""

from fractions import Fraction

import pytest

from fcl_sim import fcl
from fcl_sim.proof.prove import prove
from fcl_sim.proof.universe import universe_of
from tests.house.places import ROOT

EXPECTED = {
    "bath/valve_and.fcl": ["FCL601 valve"],
    "bath/valve_or.fcl": [],
    "cone/schedule.fcl": [],
    "crane/crane_completed.fcl": [],
    "crane/crane_precise.fcl": [],
    "crane/crane_printed.fcl": ["FCL601 power", "FCL608 distance", "FCL608 angle", "FCL609 power"],
    "exchanger/bilinear.fcl": [],
    "exchanger/precontrol.fcl": [],
    "oven/oven_completed.fcl": ["FCL601 dT1", "FCL601 dT2"],
    "oven/oven_printed.fcl": ["FCL601 dT1", "FCL601 dT2"],
    "pi/draft8.fcl": [],
    "pi/linear4.fcl": [],
    "pi/linear4_min.fcl": [],
    "pi/linear9.fcl": [],
    "pi/linear9_max.fcl": [],
    "pi/positional8.fcl": [],
    "vessel/adapted.fcl": ["FCL615 valve"],
    "vessel/figure7.fcl": [],
}


def block_of(name):
    (block,) = fcl.read_file(ROOT / "scenarios" / name).blocks
    return block


def findings_of(name, stretches=(), couplings=()):
    block = block_of(name)
    return prove(block, universe_of(block, stretches, couplings))


def sides(box):
    return {name: (side.low, side.high) for name, side in box.sides.items()}


def test_every_shipped_rule_base_is_listed():
    folder = ROOT / "scenarios"
    shipped = {str(each.relative_to(folder)) for each in folder.rglob("*.fcl")}
    assert shipped == set(EXPECTED)


@pytest.mark.parametrize("name", EXPECTED)
def test_a_shipped_rule_base_has_the_findings_that_are_expected_and_no_other(name):
    assert [f"{each.diagnostic.code} {each.variable}" for each in findings_of(name)] == EXPECTED[name]


def test_the_printed_crane_is_undefined_on_179_parts_of_288():
    gap, *_ = findings_of("crane/crane_printed.fcl", ["distance=-10..30 m", "angle=-90..90 deg"])
    assert gap.share == Fraction(179, 288)
    assert (
        "in 62.15 % of the universe: distance from 10 to 30 m and angle from 5 to 90 deg"
        in gap.diagnostic.message
    )


def test_the_printed_crane_has_ridges_without_width_where_it_is_undefined_too():
    gap, *_ = findings_of("crane/crane_printed.fcl", ["distance=-10..30", "angle=-90..90"])
    thin = [sides(each) for each in gap.boxes if each.is_thin]
    assert {"distance": (5, 5), "angle": (-90, 0)} in thin
    assert {"distance": (5, 10), "angle": (0, 0)} in thin


def test_terms_of_the_printed_crane_are_not_used():
    told = {each.diagnostic.message for each in findings_of("crane/crane_printed.fcl")[1:]}
    assert told == {
        "no rule asks for `too_far` of `distance`",
        "no rule asks for `pos_big` of `angle`",
        "no rule concludes `neg_high` of `power`",
    }


def test_the_printed_oven_is_undefined_where_the_standard_says_so_and_where_brown_is_0():
    first, second = findings_of("oven/oven_printed.fcl")
    assert [sides(each) for each in first.boxes] == [{"humidity": (50, 70), "color.brown": (0, 0)}]
    assert [sides(each) for each in second.boxes][:2] == [{"humidity": (None, 30)}, {"humidity": (80, None)}]


def test_the_completed_oven_is_left_undefined_in_one_output_where_the_colours_add_up_to_1():
    first, second = findings_of("oven/oven_completed.fcl")
    assert sides(second.boxes[0]) == {"color.brown": (0, 0), "color.light": (0, 0), "color.dark": (0, 0)}
    (left,) = findings_of("oven/oven_completed.fcl", couplings=["brown + light + dark = 1"])
    assert left.variable == first.variable == "dT1"
    assert sum(value for name, value in left.witness.items() if name.startswith("color.")) == 1
