"""What the dialects add to sections and rules, as the model has it (S7, S8, S15)."""

import math

import pytest

from fcl_sim import fcl
from fcl_sim.model import Degree, Hedge, Is, Level, Member, Method, Not, Or
from tests.fcl.texts import BATH, block, changed, codes, with_rule


def output(*edits):
    return block(changed(*edits)).defuzzifications[0]


def condition(written):
    return block(with_rule(f"RULE 1: IF {written} THEN valve IS inlet;")).rule_blocks[0].rules[0].condition


# -- defaults, locks, ranges


@pytest.mark.parametrize(
    ("written", "default", "held"),
    [("0", 0.0, False), ("NC", None, False), ("0.5 | NC", 0.5, True), ("-1E2", -100.0, False)],
)
def test_a_default_value_may_hold_the_previous_one(written, default, held):
    found = output(("DEFAULT := 0", f"DEFAULT := {written}"))
    assert (found.default, found.held) == (default, held)


def test_not_a_number_is_a_default_value_and_equals_itself():
    found = output(("DEFAULT := 0", "DEFAULT := NaN"))
    assert math.isnan(found.default)
    assert not found.held
    assert found == output(("DEFAULT := 0", "DEFAULT := nan"))
    assert hash(found) == hash(output(("DEFAULT := 0", "DEFAULT := nan")))
    assert output(("DEFAULT := 0", "DEFAULT := nan | NC")).held


@pytest.mark.parametrize(
    ("written", "held", "clamped"),
    [("PREVIOUS", True, False), ("RANGE", False, True), ("PREVIOUS | RANGE", True, True)],
)
def test_a_lock_holds_or_clamps(written, held, clamped):
    found = output(("DEFAULT := 0;", f"DEFAULT := 0; LOCK : {written};"))
    assert (found.held, found.clamped) == (held, clamped)


def test_parts_can_be_switched_off():
    found = block(
        changed(
            ("FUZZIFY temp\n", "FUZZIFY temp\n ENABLED : FALSE;\n"),
            ("DEFUZZIFY valve\n", "DEFUZZIFY valve\n ENABLED : FALSE;\n"),
            ("RULEBLOCK No1\n", "RULEBLOCK No1\n ENABLED : FALSE;\n"),
        )
    )
    assert not found.fuzzifications[0].enabled
    assert found.fuzzifications[1].enabled
    assert not found.defuzzifications[0].enabled
    assert not found.rule_blocks[0].enabled


@pytest.mark.parametrize(
    "edit",
    [
        ("temp: REAL;", "temp: REAL; RANGE := (0 .. 50);"),
        ("temp: REAL;", "temp: REAL RANGE (0 .. 50);"),
        ("temp: REAL;", "temp: REAL (0 .. 50);"),
        ("FUZZIFY temp\n", "FUZZIFY temp\n RANGE := (0 .. 50);\n"),
    ],
)
def test_a_range_of_an_input_is_the_variables_wherever_it_stands(edit):
    assert [each.range for each in block(changed(edit)).inputs] == [(0.0, 50.0), None]


def test_a_range_behind_a_declaration_is_for_all_its_names():
    text = changed(("temp: REAL;\n    level: REAL;", "temp, level: REAL; RANGE := (0 .. 1);"))
    assert [each.range for each in block(text).inputs] == [(0.0, 1.0), (0.0, 1.0)]


def test_a_range_of_a_declared_output_is_its_range():
    text = changed(("valve: REAL;", "valve: REAL; RANGE := (0 .. 100);"))
    assert block(text).defuzzifications[0].range == (0.0, 100.0)
    assert block(text).outputs[0].range is None


# -- algorithms


@pytest.mark.parametrize(
    ("written", "method"),
    [
        ("COGF", Method.COGS),
        ("WeightedAverage", Method.COGS),
        ("Centroid", Method.COGS),
        ("SmallestOfMaximum", Method.LM),
        ("LargestOfMaximum", Method.RM),
        ("MeanOfMaximum", Method.MM),
        ("MM", Method.MM),
        ("COGSS", Method.SUM),
        ("WeightedSum", Method.SUM),
    ],
)
def test_methods_of_other_readers_are_those_of_the_standard_where_they_mean_the_same(written, method):
    assert output(("CoGS", written)).method is method


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("AND : HAMACHER;", ("HPROD", "HSUM")),
        ("OR : EINSTEIN;", ("EPROD", "ESUM")),
        ("AND : DMIN;", ("DPROD", "DSUM")),
        ("OR : NIPMAX;", ("NMIN", "NMAX")),
        ("AND : EPROD; OR : ESUM;", ("EPROD", "ESUM")),
        ("AND : NONE;", ("MIN", "MAX")),
    ],
)
def test_norms_of_other_readers_come_in_pairs(written, expected):
    text = changed(("AND: MIN;", written))
    found = block(text).rule_blocks[0]
    assert (found.and_operator, found.or_operator) == expected
    assert codes(text) == []


def test_probor_is_the_algebraic_sum():
    assert block(changed(("ACCU: MAX", "ACCU: PROBOR"))).rule_blocks[0].accumulation == "ASUM"


# -- accumulation of an output


def test_an_accumulation_of_its_own_goes_before_that_of_the_rule_block():  # S8
    text = changed(("METHOD: CoGS;", "ACCU: BSUM; METHOD: CoGS;"))
    assert codes(text) == ["FCL356"]
    found = block(text)
    assert found.defuzzifications[0].accumulation == "BSUM"
    assert found.rule_blocks[0].accumulation == "MAX"


def test_a_rule_block_without_one_takes_that_of_its_outputs():  # S8
    text = changed(("METHOD: CoGS;", "ACCU: BSUM; METHOD: CoGS;"), ("    ACCU: MAX;\n", ""))
    assert codes(text) == []
    found = block(text)
    assert found.defuzzifications[0].accumulation is None
    assert found.rule_blocks[0].accumulation == "BSUM"


# -- hedges


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("temp IS very cold", Is("temp", "cold", hedges=(Hedge.VERY,))),
        ("temp IS NOT very cold", Not(Is("temp", "cold", hedges=(Hedge.VERY,)))),
        ("temp IS very not cold", Is("temp", "cold", hedges=(Hedge.VERY, Hedge.NOT))),
        ("temp IS extremely somewhat cold", Is("temp", "cold", hedges=(Hedge.EXTREMELY, Hedge.SOMEWHAT))),
        ("temp IS any", Is("temp", "", hedges=(Hedge.ANY,))),
        (
            "temp IS any OR level IS seldom low",
            Or((Is("temp", "", hedges=(Hedge.ANY,)), Is("level", "low", hedges=(Hedge.SELDOM,)))),
        ),
        ("temp IS any cold", Is("temp", "cold", hedges=(Hedge.ANY,))),
    ],
)
def test_hedges_stand_before_their_term_in_the_order_of_the_text(written, expected):
    assert condition(written) == expected


@pytest.mark.parametrize(
    ("written", "hedges"),
    [
        ("valve IS very inlet", (Hedge.VERY,)),
        ("valve IS seldom extremely inlet WITH 0.5", (Hedge.SELDOM, Hedge.EXTREMELY)),
        ("(valve IS SOMEWHAT inlet)", (Hedge.SOMEWHAT,)),
    ],
)
def test_hedges_of_a_conclusion_are_read_noted_and_written_back(written, hedges):
    text = with_rule(f"RULE 1: IF temp IS cold THEN {written};")
    found = block(text)
    (conclusion,) = found.rule_blocks[0].rules[0].conclusions
    assert (conclusion.term, conclusion.hedges) == ("inlet", hedges)
    assert "hedge" in {note.code for note in found.notes}
    again = block(fcl.write(found))
    assert again.rule_blocks == found.rule_blocks


def test_a_term_may_have_the_name_of_a_hedge():  # S1a
    text = BATH.replace("cold", "very")
    assert codes(text) == []
    assert block(text).rule_blocks[0].rules[0].condition.arguments[0] == Is("temp", "very")


# -- structures


STRUCTURE = "TYPE wish: STRUCT much: REAL := 0.25; none: BOOL; END_STRUCT; END_TYPE\n"


def test_members_are_variables_of_their_own_and_keep_the_type():  # S7
    text = STRUCTURE + changed(("level: REAL;", "level: REAL;\n    user: WISH;"))
    found = block(text.replace("IF temp IS cold", "IF user.much AND NOT USER = none AND temp IS cold"))
    assert [(each.name, each.type, each.initial, each.structure) for each in found.inputs[2:]] == [
        ("user.much", "REAL", 0.25, "wish"),
        ("user.none", "BOOL", None, "wish"),
    ]
    assert found.structures[0].members == (Member("much", initial=0.25), Member("none", found.inputs[3].type))
    assert found.rule_blocks[0].rules[0].condition.arguments[:2] == (
        Degree("user.much"),
        Not(Degree("user.none")),
    )


def test_types_outside_are_seen_by_all_blocks():
    used = changed(("level: REAL;", "level: REAL;\n    user: wish;"))
    first, second = fcl.read(STRUCTURE + used + BATH.replace("bath", "other")).blocks
    assert [each.name for each in first.structures] == ["wish"]
    assert second.structures == first.structures


def test_an_inline_structure_is_named_after_its_variable():
    found = block(changed(("level: REAL;", "level: REAL;\n    user: STRUCT much: REAL; END_STRUCT;")))
    assert [each.name for each in found.structures] == ["user_type"]


# -- notes


def test_notes_stand_in_the_order_of_the_text_with_their_places():
    text = changed(
        ("(3, 1) (27, 0)", "TRIAN 0 1 2"),
        ("temp IS hot", "temp IS very hot"),
        ("DEFAULT := 0", "DEFAULT := nan"),
    )
    notes = block(text).notes
    assert [(each.code, each.level, each.span.text) for each in notes] == [
        ("shape", Level.OPEN, "TRIAN 0 1 2"),
        ("default", Level.OPEN, "nan"),
        ("hedge", Level.OPEN, "temp IS very hot"),
    ]


def test_each_block_has_the_notes_of_its_own_text():
    second = changed(("bath", "other"), ("(3, 1) (27, 0)", "TRIAN 0 1 2"))
    first, other = fcl.read(BATH + second).blocks
    assert (len(first.notes), len(other.notes)) == (0, 1)


def test_two_models_that_differ_in_notes_alone_are_equal():
    assert block(changed(("(3, 1) (27, 0)", "TRIAN 0 1 2"))) == block(
        changed(("(3, 1) (27, 0)", "(0, 0) (1, 1) (2, 0)"))
    )
