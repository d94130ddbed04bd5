"""The examples of the standard and its draft as printed: they read, or have the one known fault (S17).

A fragment stands in the smallest function block that holds it.
"""

from collections import Counter
from pathlib import Path

import pytest

from fcl_sim import fcl
from fcl_sim.diagnostics.render import render
from fcl_sim.model import And, DataType, Degree, Is, Member, Method, Not, Points
from tests.fcl.annotations import found

FOLDER = Path(__file__).parent / "printed"

FINDINGS = {  # line and code of whatever is not as 5.4.1 wants it
    "clause_5_2_3_range": [],
    "clause_5_2_4_rule_blocks": [],
    "clause_5_2_4_rules": [],
    "draft_clause_5_2_3": [],
    "draft_figure_5_2_2": [],
    "draft_figure_5_3_1": [(1, "FCL221"), (29, "FCL206")],
    "draft_figure_c15": [(35, "FCL206"), (36, "FCL206"), (42, "FCL310")],
    "draft_figure_d3": [(24, "FCL206"), (33, "FCL206"), (39, "FCL214")],
    "draft_figure_d4": [(9, "FCL206"), (29, "FCL206"), (38, "FCL206"), (44, "FCL214")],
    "figure3": [(1, "FCL221"), (7, "FCL355")],
    "figure4": [],
    "figure5": [],
    "figure6": [(3, "FCL355"), (5, "FCL334"), (5, "FCL335")],
    "figure7": [],
    "figure_c16": [(42, "FCL310")],
    "figure_d3": [(46, "FCL214")],
    "figure_d4": [(46, "FCL214")],
    "figure_d4_french": [(47, "FCL214")],
}
REFUSED = {"draft_figure_c15", "figure_c16"}


def block(name):
    (found,) = fcl.read_file(FOLDER / f"{name}.fcl").blocks
    return found


def test_every_printed_example_is_listed():
    assert {file.stem for file in FOLDER.glob("*.fcl")} == set(FINDINGS)


@pytest.mark.parametrize("name", FINDINGS)
def test_a_printed_example_has_its_known_findings_and_no_others(name):
    reading = fcl.read_file(FOLDER / f"{name}.fcl")
    assert found(reading) == Counter(FINDINGS[name])
    assert bool(reading.errors) is (name in REFUSED)


def test_the_slip_of_annex_c_is_named_with_what_was_meant():  # S17
    (error,) = fcl.read_file(FOLDER / "figure_c16.fcl").errors
    assert render(error).splitlines()[-1] == (
        "  hint: did you mean `pos_high`? Valid here: neg_high, neg_medium, zero, pos_medium or pos_high"
    )


@pytest.mark.parametrize("name", ["figure_d4", "figure_d4_french", "figure_d3", "draft_figure_d4"])
def test_annex_d_takes_members_of_a_structure_as_degrees_however_it_is_spelled(name):  # S7
    oven = block(name)
    assert [(each.name, each.structure) for each in oven.inputs] == [
        ("humidity", None),
        ("color.brown", "color_type"),
        ("color.light", "color_type"),
        ("color.dark", "color_type"),
    ]
    (color_type,) = oven.structures
    assert color_type.members == tuple(Member(each, DataType.REAL) for each in ("brown", "light", "dark"))
    first = oven.rule_blocks[0].rules[0]
    assert first.condition == And((Is("humidity", "middle"), Degree("color.brown")))
    assert [(each.variable, each.term) for each in first.conclusions] == [("dT1", "zero"), ("dT2", "zero")]


def test_the_accumulation_of_the_draft_is_that_of_the_rule_block():  # S8
    example = block("draft_clause_5_2_3")
    assert example.rule_blocks[0].accumulation == "BSUM"
    assert example.defuzzifications[0].accumulation is None
    assert block("draft_figure_d4").rule_blocks == block("figure_d4").rule_blocks


def test_the_draft_and_the_standard_say_the_same_in_figure_7():
    printed, draft = block("figure7"), block("draft_figure_5_3_1")
    assert printed.name == "Fuzzy_FB"
    assert draft.name == "Fuzzy FB"
    assert printed.fuzzifications == draft.fuzzifications
    assert printed.defuzzifications == draft.defuzzifications
    assert printed.rule_blocks == draft.rule_blocks


def test_both_spellings_of_a_range_are_read():  # S3
    valve, drain = block("clause_5_2_3_range").defuzzifications
    assert (valve.range, drain.range) == ((0.0, 100.0), (0.0, 100.0))
    assert (valve.method, drain.method) == (Method.COG, Method.COA)


def test_a_negation_stands_before_the_condition_or_the_term():
    rules = block("clause_5_2_4_rules").rule_blocks[0].rules
    assert {rules[4].condition, rules[5].condition, rules[6].condition} == {Not(Is("temp", "hot"))}


def test_every_printed_term_is_read_as_points():
    shapes = [each.shape for name in ("figure4", "figure5") for each in block(name).fuzzifications[0].terms]
    assert [type(each) for each in shapes] == [Points] * 4
    assert [each.x for each in shapes[-1].points] == ["bp_warm1", 21.0, "bp_warm2"]
