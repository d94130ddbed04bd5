"""What the Basic Level can say, and what it cannot (Table 8)."""

import pytest

from fcl_sim import fcl
from fcl_sim.diagnostics import InputFault, Source
from fcl_sim.diagnostics.page import framed, page
from fcl_sim.diagnostics.render import render
from tests.fcl.texts import BATH, changed, with_rule

SECOND = """
RULEBLOCK No2
    AND: MIN; ACCU: MAX;
    RULE 1: IF level IS low AND (temp IS cold AND level IS high) THEN valve IS inlet;
END_RULEBLOCK
"""
EXTENDED = changed(
    ("(3, 0) (27, 1)", "(0, 0) (3, 0) (27, 1) (30, 1)"),
    ("    METHOD", "    RANGE := (0 .. 100);\n    METHOD"),
    ("AND: MIN;", "AND: MIN; OR: MAX; ACT: PROD;"),
    ("    RULE 1: IF temp IS cold", "    (* fill *)\n    RULE 1: IF (temp IS cold OR level IS low)"),
    (
        "AND level IS low THEN valve IS inlet;",
        "AND temp IS hot THEN valve IS inlet, valve IS closed; // soon",
    ),
    ("END_RULEBLOCK", f"END_RULEBLOCK{SECOND}"),
)


def basic(text):
    return fcl.rewrite(Source("t", text), basic=True)


def refused(text):
    with pytest.raises(InputFault) as caught:
        basic(text)
    assert {each.code for each in caught.value.diagnostics} == {"FCL501"}
    return caught.value.diagnostics


def test_rules_are_split_and_what_has_no_effect_is_left_out():
    text = basic(EXTENDED)
    assert "    TERM hot  := (3, 0) (27, 1);\n" in text
    assert "RANGE" not in text
    assert text.endswith("""\
RULEBLOCK No1
    AND: MIN;
    ACCU: MAX;
    (* fill *)
    // soon
    RULE 1a: IF temp IS cold AND temp IS hot THEN valve IS inlet;
    RULE 1b: IF temp IS cold AND temp IS hot THEN valve IS closed;
    RULE 1c: IF level IS low AND temp IS hot THEN valve IS inlet;
    RULE 1d: IF level IS low AND temp IS hot THEN valve IS closed;
    RULE 2a: IF temp IS hot THEN valve IS closed;
    RULE 2b: IF level IS high THEN valve IS closed;
    RULE 1: IF level IS low AND temp IS cold AND level IS high THEN valve IS inlet;
END_RULEBLOCK

END_FUNCTION_BLOCK
""")
    assert basic(text) == text


def labels(text):
    (rule_block,) = fcl.read(basic(text)).blocks[0].rule_blocks
    return [each.label for each in rule_block.rules]


def test_letters_that_are_taken_are_left_out():
    rule = "RULE 2: IF temp IS hot OR level IS high"
    text = changed(("RULE 1:", "RULE 2b:"), (rule, f"{rule} OR level IS low"))
    assert labels(text) == ["2b", "2a", "2c", "2d"]


def test_labels_that_meet_get_the_name_of_their_block():
    text = EXTENDED.replace("RULE 1: IF level", "RULE 1a: IF level").replace("No2", "my-two")
    assert labels(text)[-3:] == ["2a", "2b", "my_two_1a"]


def test_more_alternatives_than_letters_have_two():
    alternatives = " OR ".join(["temp IS cold"] * 28)
    found = labels(with_rule(f"RULE 1: IF {alternatives} THEN valve IS inlet;"))
    assert found[24:30] == ["1y", "1z", "1aa", "1ab", "2a", "2b"]


def test_operators_and_accu_that_have_nothing_to_do_become_those_of_the_basic_level():
    text = BATH.replace("AND: MIN;", "AND: PROD; OR: MAX;").replace("ACCU: MAX", "ACCU: NSUM")
    text = text.replace(" AND level IS low", "")
    assert "RULEBLOCK No1\n    AND: MIN;\n    ACCU: MAX;\n    RULE 1: IF" in basic(text)


@pytest.mark.parametrize(
    ("edits", "messages"),
    [
        ([("END_VAR\nFUZZ", "END_VAR VAR x: REAL; END_VAR\nFUZZ")],
         ["the Basic Level has no local variables: VAR belongs to Table 9"]),
        ([("RULEBLOCK No1", "OPTIONS a END_OPTIONS RULEBLOCK No1")],
         ["the Basic Level has no OPTIONS: what they say belongs to the Open Level (5.2.5)"]),
        ([("BLOCK bath", "BLOCK my-bath")],
         ["the Basic Level has no such name: `my-bath` is not an identifier"]),
        ([("level: REAL;", "level: REAL; l: STRUCT a: REAL; END_STRUCT;")],
         ["the Basic Level has no structure types (Annex D)"]),
        ([("FUZZIFY temp", "FUZZIFY temp ENABLED: FALSE;")], ["the Basic Level has no LOCK and no ENABLED"]),
        ([("(3, 1) (27, 0)", "GAUSS 1 2")], ["a term of the Basic Level is written as points (Table 8)"]),
        ([("(3, 1)", "(level, 1)")],
         ["a point of the Basic Level is constant: variable ones belong to Table 9"]),
        ([("(3, 1)", "(3, 0.5)")], ["a point of the Basic Level has the degree 0 or 1 (Table 8)"]),
        ([("(3, 1) (27, 0)", "(3, 0) (4, 1) (5, 1) (6, 0)")],
         ["a term of the Basic Level has three points at most (Table 8)"]),
        ([(":= 0;\n    TERM inlet := 100;", ":= (0, 0) (1, 1);\n    RANGE := (0 .. 1);"), ("CoGS", "CoG"),
          ("IS inlet", "IS closed")],
         ["the Basic Level defuzzifies by CoGS, not by CoG (Table 8)",
          "a term of an output is a singleton in the Basic Level (Table 8)"]),
        ([(":= 100", ":= level")], ["a singleton of the Basic Level is constant (Table 8)"]),
        ([("CoGS", "LM")], ["the Basic Level defuzzifies by CoGS, not by LM (Table 8)"]),
        ([(":= 0;\nEND", ":= nan;\nEND")],
         ["a default value of the Basic Level is a number or NC (Table 8)"]),
        ([(":= 0;\nEND", ":= 5 | NC;\nEND")], ["the Basic Level has no LOCK and no ENABLED"]),
        ([("AND: MIN", "AND: PROD")],
         ["AND is MIN in the Basic Level, not PROD (Table 8)",
          "OR by ASUM cannot be written as two rules: ACCU: MAX joins rules (5.2.4)"]),
        ([("AND: MIN", "AND: MIN; OR: BSUM")],
         ["OR by BSUM cannot be written as two rules: ACCU: MAX joins rules (5.2.4)"]),
        ([("ACCU: MAX", "ACCU: BSUM"), ("IS closed;\nEND", "IS inlet;\nEND")],
         ["the Basic Level accumulates by MAX: BSUM of several rules is another sum"]),
        ([("level IS low", "level IS NOT low")], ["the Basic Level has no NOT: it belongs to Table 9"]),
        ([("level IS low", "NOT (level IS low AND temp IS hot)")],
         ["the Basic Level has no NOT: it belongs to Table 9"]),
        ([("level IS low", "level IS very low")], ["the Basic Level has no hedges"]),
        ([("valve IS inlet", "valve IS very inlet")], ["the Basic Level has no hedges"]),
        ([("level IS low", "level")],
         ["the Basic Level has no degrees brought in from outside: they belong to Table 9"]),
        ([("temp IS hot OR", "valve IS inlet OR")], ["a condition of the Basic Level is about inputs alone"]),
        ([("IS inlet;\n    RULE", "IS inlet WITH 0.5;\n    RULE")],
         ["the Basic Level has no weights: WITH belongs to Table 9"]),
        ([("RULEBLOCK No1", "RULEBLOCK No1\nENABLED: FALSE;")],
         ["the Basic Level has no LOCK and no ENABLED"]),
        ([("level IS low", " AND ".join(["(temp IS cold OR temp IS hot)"] * 9))],
         ["this rule would become more than 500 rules"]),
    ],
)  # fmt: skip
def test_what_the_basic_level_cannot_say_is_refused(edits, messages):
    text = BATH
    for old, new in edits:
        assert old in text
        text = text.replace(old, new, 1)
    assert [each.message for each in refused(text)] == messages


def test_a_variable_without_terms_has_no_place_in_the_basic_level():
    text = changed(
        ("valve: REAL;", "valve: REAL; warm: REAL;"), ("IS inlet;\n    RULE", "IS inlet, warm;\n    RULE")
    )
    assert [each.message for each in refused(text)] == [
        "a conclusion of the Basic Level has a term: variable IS term"
    ]


def test_a_refusal_shows_every_place():
    (finding,) = refused(BATH.replace("level IS", "level IS NOT"))
    assert (
        render(finding)
        == """\
t:26:33: error[FCL501]: the Basic Level has no NOT: it belongs to Table 9
  26 |     RULE 1: IF temp IS cold AND level IS NOT low THEN valve IS inlet;
     |                                 ^^^^^^^^^^^^^^^^
  also at t:27:31"""
    )


def test_the_page_of_the_code_says_the_truth():
    told = page("FCL501")
    refused(framed(told.bad, told.within))
    assert basic(framed(told.mended, told.within))
